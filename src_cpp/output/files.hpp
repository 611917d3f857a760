/// Files that are whole at any moment: written beside their place, then renamed into it.
#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "cdfp/error.hpp"

namespace cdfp {

/// Where `write_whole_file` and others prepare a file before it takes its place.
std::filesystem::path temporary_beside(const std::filesystem::path& path);

/// Puts a prepared file in its place; who has the old one open goes on reading the old one.
void move_into_place(const std::filesystem::path& temporary, const std::filesystem::path& path);

void write_whole_file(const std::filesystem::path& path, std::string_view content);
void write_whole_file(const std::filesystem::path& path, std::span<const std::string_view> pieces);

/// A file too large to be put together in memory: it grows beside its place and takes it at `finish`.
class GrowingFile {
 public:
  explicit GrowingFile(std::filesystem::path path);
  ~GrowingFile();
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  std::size_t size() const { return size_; }
  void append(std::string_view bytes);
  /// `at` + the length of `bytes` is at most `size()`.
  void overwrite(std::size_t at, std::string_view bytes);
  void finish();

 private:
  void write(std::string_view bytes);

  std::filesystem::path path_, temporary_;
  std::FILE* stream_;
  std::size_t size_ = 0;
};

/// Appends whole lines with one write.
void append_to_file(const std::filesystem::path& path, std::string_view lines);

/// Nothing if there is no such file.
std::string contents_of(const std::filesystem::path& path);

void make_folder(const std::filesystem::path& folder);

/// Names the file, what the system said and the cure.
Error write_error(const std::filesystem::path& path);

}  // namespace cdfp
