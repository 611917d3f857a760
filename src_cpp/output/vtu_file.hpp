/// VTK XML unstructured grid, arrays appended raw and compressed by zlib.
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
  void cells(std::span<const Index> connectivity, std::span<const std::int64_t> offsets,
             std::span<const std::uint8_t> types);
  void point_array(const std::string& name, int components, std::span<const double> values);
  void cell_array(const std::string& name, std::span<const double> values);
  void cell_array(const std::string& name, std::span<const Index> values);

  void write(const std::filesystem::path& path) const;

 private:
  std::string add(const char* type, const std::string& name, int components, const void* data,
                  std::size_t bytes);

  std::size_t point_count_, cell_count_;
  double time_;
  std::string points_, cells_, point_data_, cell_data_;
  std::vector<std::string> appended_;  // array after array
  std::size_t appended_bytes_ = 0;
};

}  // namespace cdfp
