#include "support/picture.hpp"

namespace bench {

void save_chart(const std::filesystem::path& file, const cdfp::Chart& chart) {
  std::filesystem::create_directories(file.parent_path());
  cdfp::write_png(file, 1500, 900, [&](cdfp::Canvas& canvas) {
    cdfp::draw_chart(canvas, {0, 60, 1460, 800}, chart);
  });
}

}  // namespace bench
