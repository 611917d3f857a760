/// VTK XML unstructured grid, arrays appended raw and compressed by zlib. They are compressed on their way to
/// the file, so they must stay until `write`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "cdfp/types.hpp"

namespace cdfp {

class VtuFile {
 public:
  VtuFile(std::size_t points, std::size_t cells, double time);

  void points(std::span<const double> coordinates);
  /// `offsets`: end of each cell in `connectivity`; `types`: numbers of VTK's cell types.
  void cells(std::span<const Index> connectivity, std::span<const Index> offsets,
             std::span<const std::uint8_t> types);
  void point_array(const std::string& name, int components, std::span<const double> values);
  void cell_array(const std::string& name, std::span<const double> values);
  void cell_array(const std::string& name, std::span<const Index> values);

  void write(const std::filesystem::path& path) const;

 private:
  struct Array {
    const char* section;
    const char* type;
    std::string name;
    int components;
    std::span<const unsigned char> bytes;
  };
  template <class T>
  void add(const char* section, const char* type, const std::string& name, int components,
           std::span<const T> values);
  std::string head(const std::vector<std::size_t>& offsets) const;

  std::size_t point_count_, cell_count_;
  double time_;
  std::vector<Array> arrays_;
};

}  // namespace cdfp
