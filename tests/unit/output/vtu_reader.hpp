/// A strict reader of VTK XML unstructured grids with raw appended, zlib-compressed arrays: fails on whatever
/// does not agree with the format's description.
#pragma once

#include <cstring>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace cdfp::sample {

struct VtuArray {
  std::string type;
  int components = 1;
  std::string bytes;

  template <class Number>
  std::vector<Number> as() const {
    if (bytes.size() % sizeof(Number)) throw std::runtime_error("size is no multiple of the type's");
    std::vector<Number> values(bytes.size() / sizeof(Number));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
};

struct Vtu {
  std::size_t points = 0, cells = 0;
  double time = 0;
  std::map<std::string, std::map<std::string, VtuArray>> sections;  ///< "PointData" and so on
  const VtuArray& at(const std::string& section, const std::string& name) const {
    return sections.at(section).at(name);
  }
};

Vtu read_vtu(const std::filesystem::path& path);

struct PvdEntry {
  double time;
  std::string file;
};

std::vector<PvdEntry> read_pvd(const std::filesystem::path& path);

std::string read_text(const std::filesystem::path& path);

}  // namespace cdfp::sample
