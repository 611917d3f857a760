#include "output/history_csv.hpp"

#include "output/files.hpp"
#include "output/numbers.hpp"

namespace cdfp {

void HistoryCsv::write(const History& history) {
  const std::size_t columns = history.columns.size(), rows = history.rows();
  const bool anew = columns_.empty() || columns_ != history.columns || rows < rows_;
  std::string text;
  if (anew) {
    for (std::size_t c = 0; c < columns; ++c) text += (c ? "," : "") + history.columns[c];
    text += '\n';
  }
  for (std::size_t row = anew ? 0 : rows_; row < rows; ++row) {
    for (std::size_t c = 0; c < columns; ++c) {
      if (c) text += ',';
      text += to_text(history.values[row * columns + c]);
    }
    text += '\n';
  }
  if (anew)
    write_whole_file(path_, text);
  else if (!text.empty())
    append_to_file(path_, text);
  columns_ = history.columns;
  rows_ = rows;
}

}  // namespace cdfp
