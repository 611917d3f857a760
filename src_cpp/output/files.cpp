#include "output/files.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace cdfp {
namespace {

void write_stream(const std::filesystem::path& path, const char* mode,
                  std::span<const std::string_view> pieces) {
  std::FILE* stream = std::fopen(path.c_str(), mode);
  if (!stream) throw write_error(path);
  std::setvbuf(stream, nullptr, _IONBF, 0);
  bool written = true;
  for (const std::string_view piece : pieces) {
    written = written && std::fwrite(piece.data(), 1, piece.size(), stream) == piece.size();
  }
  const int reason = errno;
  const bool closed = std::fclose(stream) == 0;
  if (!written) errno = reason;
  if (!written || !closed) throw write_error(path);
}

}  // namespace

Error write_error(const std::filesystem::path& path) {
  return Error(Status::io, "cannot write '" + path.string() + "': " + std::strerror(errno) +
                               "; give an output folder on a disk that has room and that you may write to");
}

std::filesystem::path temporary_beside(const std::filesystem::path& path) {
  std::filesystem::path temporary = path;
  temporary += ".part";
  return temporary;
}

void move_into_place(const std::filesystem::path& temporary, const std::filesystem::path& path) {
  if (std::rename(temporary.c_str(), path.c_str()) != 0) throw write_error(path);
}

void write_whole_file(const std::filesystem::path& path, std::string_view content) {
  write_whole_file(path, std::span(&content, 1));
}

void write_whole_file(const std::filesystem::path& path, std::span<const std::string_view> pieces) {
  const std::filesystem::path temporary = temporary_beside(path);
  write_stream(temporary, "wb", pieces);
  move_into_place(temporary, path);
}

GrowingFile::GrowingFile(std::filesystem::path path)
    : path_(std::move(path)),
      temporary_(temporary_beside(path_)),
      stream_(std::fopen(temporary_.c_str(), "wb")) {
  if (!stream_) throw write_error(path_);
}
GrowingFile::~GrowingFile() {
  if (!stream_) return;
  std::fclose(stream_);
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
}

void GrowingFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_) != bytes.size()) throw write_error(path_);
}

void GrowingFile::append(std::string_view bytes) {
  write(bytes);
  size_ += bytes.size();
}

void GrowingFile::overwrite(std::size_t at, std::string_view bytes) {
  if (std::fseek(stream_, static_cast<long>(at), SEEK_SET) != 0) throw write_error(path_);
  write(bytes);
  if (std::fseek(stream_, 0, SEEK_END) != 0) throw write_error(path_);
}

void GrowingFile::finish() {
  std::FILE* stream = std::exchange(stream_, nullptr);
  if (std::fclose(stream) != 0) throw write_error(path_);
  move_into_place(temporary_, path_);
}

void append_to_file(const std::filesystem::path& path, std::string_view lines) {
  write_stream(path, "ab", std::span(&lines, 1));
}

std::string contents_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return stream ? std::string(std::istreambuf_iterator<char>(stream), {}) : std::string();
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code reason;
  std::filesystem::create_directories(folder, reason);
  if (!reason && std::filesystem::is_directory(folder)) return;
  throw Error(Status::io, "cannot make the output folder '" + folder.string() + "': " +
                              (reason ? reason.message() : std::string("a file of that name is there")) +
                              "; give another folder");
}

}  // namespace cdfp
