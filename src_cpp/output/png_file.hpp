/// A PNG file of 8 bits a colour, put together row by row, so that no more of the picture needs to be in
/// memory.
#pragma once

#include <zlib.h>

#include <string>
#include <vector>

namespace cdfp {

class PngFile {
 public:
  PngFile(int width, int height);
  ~PngFile();
  PngFile(const PngFile&) = delete;
  PngFile& operator=(const PngFile&) = delete;

  /// The next row from the top; `pixels`: words 0x00RRGGBB, as cairo has them.
  void add_row(const unsigned char* pixels);
  /// The file, after all rows.
  std::string finish();

 private:
  void deflate_row(int flush);

  int width_, height_;
  z_stream stream_{};
  std::string file_, image_;
  std::vector<unsigned char> above_, row_;
};

}  // namespace cdfp
