#include "output/png_file.hpp"

#include <cstdint>
#include <cstring>
#include <utility>

#include "cdfp/error.hpp"

namespace cdfp {
namespace {

void append_word(std::string& bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(word >> shift & 0xff);
}

/// [bytes of the content][type and content][checksum of these]
void append_chunk(std::string& file, const char* type, const std::string& content) {
  append_word(file, static_cast<std::uint32_t>(content.size()));
  const std::string body = type + content;
  file += body;
  append_word(file, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()),
                                                     static_cast<uInt>(body.size()))));
}

}  // namespace

PngFile::PngFile(int width, int height)
    : width_(width),
      height_(height),
      file_("\x89PNG\r\n\x1a\n"),
      above_(3 * static_cast<std::size_t>(width), 0),
      row_(1 + above_.size()) {
  if (deflateInit(&stream_, 6) != Z_OK) throw Error(Status::internal, "zlib could not start on a picture");
}
PngFile::~PngFile() {
  deflateEnd(&stream_);
}

void PngFile::add_row(const unsigned char* pixels) {
  constexpr unsigned char difference_to_the_row_above = 2;
  row_[0] = difference_to_the_row_above;
  for (std::size_t x = 0; x < static_cast<std::size_t>(width_); ++x) {
    std::uint32_t pixel = 0;
    std::memcpy(&pixel, pixels + 4 * x, sizeof pixel);
    for (std::size_t colour = 0; colour < 3; ++colour) {
      const auto value = static_cast<unsigned char>(pixel >> (16 - 8 * colour) & 0xff);
      row_[1 + 3 * x + colour] = static_cast<unsigned char>(value - above_[3 * x + colour]);
      above_[3 * x + colour] = value;
    }
  }
  stream_.next_in = row_.data();
  stream_.avail_in = static_cast<uInt>(row_.size());
  deflate_row(Z_NO_FLUSH);
}

void PngFile::deflate_row(int flush) {
  unsigned char room[1 << 14];
  do {
    stream_.next_out = room;
    stream_.avail_out = sizeof room;
    if (deflate(&stream_, flush) == Z_STREAM_ERROR)
      throw Error(Status::internal, "zlib could not compress a picture");
    image_.append(reinterpret_cast<const char*>(room), sizeof room - stream_.avail_out);
  } while (stream_.avail_out == 0);
}

std::string PngFile::finish() {
  stream_.avail_in = 0;
  deflate_row(Z_FINISH);
  std::string head;
  append_word(head, static_cast<std::uint32_t>(width_));
  append_word(head, static_cast<std::uint32_t>(height_));
  head += {8, 2, 0, 0,
           0};  // bits a colour, colours without palette; the one compression and filter; no interlacing
  append_chunk(file_, "IHDR", head);
  append_chunk(file_, "IDAT", image_);
  append_chunk(file_, "IEND", "");
  return std::move(file_);
}

}  // namespace cdfp
