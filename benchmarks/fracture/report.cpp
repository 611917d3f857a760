#include "fracture/report.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "support/picture.hpp"

namespace bench {

using namespace cdfp;

namespace {

std::string fell_short;

}  // namespace

void note(const std::string& what, double figure, const char* unit) {
  std::printf("  %-58s %12.5g   %24s %-5s\n", what.c_str(), figure, "", unit);
  std::fflush(stdout);
}

const std::string& shortfall() {
  return fell_short;
}

void report(const std::string& what, double figure, double low, double high, const char* unit) {
  const bool holds = figure >= low && figure <= high;
  std::printf("  %-58s %12.5g   %10.5g .. %-10.5g %-5s %s\n", what.c_str(), figure, low, high, unit,
              holds ? "pass" : "SHORT");
  std::fflush(stdout);
  if (!holds) fell_short += " " + what + ";";
}

void chart(const std::string& name, const Chart& c) {
  save_chart(kPictures / (name + ".png"), c);
}

std::vector<CrackLine> cracks_of(const Simulation& s) {
  const Frame frame = s.frame();
  std::vector<CrackLine> lines;
  for (const CrackFacet& f : frame.cracks) {
    std::array<Point, 4> p;
    for (int c = 0; c < f.corners; ++c) {
      const double* x = &frame.positions[3 * static_cast<std::size_t>(f.lower[c])];
      p[c] = {x[0], x[1]};
    }
    // Some corners lie over others.
    int far = 1;
    for (int c = 2; c < f.corners; ++c) {
      if (std::hypot(p[c].x - p[0].x, p[c].y - p[0].y) > std::hypot(p[far].x - p[0].x, p[far].y - p[0].y))
        far = c;
    }
    lines.push_back({p[0], p[far], f.damage, f.broken_time});
  }
  return lines;
}

void draw_cracks(const std::string& name, const std::vector<std::vector<CrackLine>>& panels, Point low,
                 Point high) {
  std::filesystem::create_directories(kPictures);
  const double scale = 900 / (high.x - low.x);
  const double height = scale * (high.y - low.y);
  const auto count = static_cast<int>(panels.size());
  write_png(kPictures / (name + ".png"), 60 + 960 * count, static_cast<int>(height) + 120,
            [&](Canvas& canvas) {
              for (int k = 0; k < count; ++k) {
                const Box box{60 + 960.0 * k, 60, 900, height};
                canvas.stroke(box, ink, 2);
                for (const CrackLine& line : panels[static_cast<std::size_t>(k)]) {
                  const auto at = [&](Point p) {
                    return Point{box.x + (p.x - low.x) * scale, box.bottom() - (p.y - low.y) * scale};
                  };
                  Colour colour = ink;
                  colour.alpha = static_cast<float>(0.15 + 0.85 * line.damage);
                  canvas.line(at(line.a), at(line.b), colour, 1 + 2 * line.damage);
                }
              }
            });
}

}  // namespace bench
