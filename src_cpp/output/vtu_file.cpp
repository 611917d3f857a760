#include "output/vtu_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string_view>
#include <vector>

#include "output/files.hpp"
#include "output/numbers.hpp"

namespace cdfp {
namespace {

static_assert(std::endian::native == std::endian::little, "the files are declared little-endian");

constexpr std::size_t block_bytes = 1 << 18;
// Coordinates and velocities hardly shrink further at higher levels.
constexpr int compression_level = 4;

/// [blocks][bytes a block][bytes of a shorter last block or 0][compressed bytes of each], then the blocks.
std::string compressed(const unsigned char* data, std::size_t bytes) {
  const std::size_t blocks = (bytes + block_bytes - 1) / block_bytes;
  std::vector<std::uint64_t> head{blocks, block_bytes, bytes % block_bytes};
  head.resize(head.size() + blocks);
  std::string packed(head.size() * sizeof(std::uint64_t), 0);
  std::vector<unsigned char> room(compressBound(block_bytes));
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t begin = block * block_bytes;
    uLongf size = room.size();
    const uLong length = std::min(block_bytes, bytes - begin);
    if (compress2(room.data(), &size, data + begin, length, compression_level) != Z_OK)
      throw Error(Status::internal, "zlib could not compress a block of a snapshot");
    head[3 + block] = size;
    packed.append(reinterpret_cast<const char*>(room.data()), size);
  }
  std::memcpy(packed.data(), head.data(), head.size() * sizeof(std::uint64_t));
  return packed;
}

}  // namespace

VtuFile::VtuFile(std::size_t points, std::size_t cells, double time)
    : point_count_(points), cell_count_(cells), time_(time) {}

std::string VtuFile::add(const char* type, const std::string& name, int components, const void* data,
                         std::size_t bytes) {
  std::string element = std::string("        <DataArray type=\"") + type + "\" Name=\"" + name +
                        "\" NumberOfComponents=\"" + std::to_string(components) +
                        "\" format=\"appended\" offset=\"" + std::to_string(appended_bytes_) + "\"/>\n";
  appended_.push_back(compressed(static_cast<const unsigned char*>(data), bytes));
  appended_bytes_ += appended_.back().size();
  return element;
}

void VtuFile::points(std::span<const double> coordinates) {
  points_ += add("Float64", "Points", 3, coordinates.data(), coordinates.size_bytes());
}

void VtuFile::cells(std::span<const Index> connectivity, std::span<const std::int64_t> offsets,
                    std::span<const std::uint8_t> types) {
  cells_ += add("Int32", "connectivity", 1, connectivity.data(), connectivity.size_bytes());
  cells_ += add("Int64", "offsets", 1, offsets.data(), offsets.size_bytes());
  cells_ += add("UInt8", "types", 1, types.data(), types.size_bytes());
}

void VtuFile::point_array(const std::string& name, int components, std::span<const double> values) {
  point_data_ += add("Float64", name, components, values.data(), values.size_bytes());
}

void VtuFile::cell_array(const std::string& name, std::span<const double> values) {
  cell_data_ += add("Float64", name, 1, values.data(), values.size_bytes());
}

void VtuFile::cell_array(const std::string& name, std::span<const Index> values) {
  cell_data_ += add("Int32", name, 1, values.data(), values.size_bytes());
}

void VtuFile::write(const std::filesystem::path& path) const {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" "
      "compressor=\"vtkZLibDataCompressor\">\n"
      "  <UnstructuredGrid>\n"
      "    <FieldData>\n"
      "      <DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">" +
      to_text(time_) +
      "</DataArray>\n"
      "    </FieldData>\n"
      "    <Piece NumberOfPoints=\"" +
      std::to_string(point_count_) + "\" NumberOfCells=\"" + std::to_string(cell_count_) + "\">\n";
  const auto section = [&text](const char* name, const std::string& arrays) {
    text += std::string("      <") + name + ">\n" + arrays + "      </" + name + ">\n";
  };
  section("PointData", point_data_);
  section("CellData", cell_data_);
  section("Points", points_);
  section("Cells", cells_);
  text +=
      "    </Piece>\n  </UnstructuredGrid>\n"
      "  <AppendedData encoding=\"raw\">\n_";
  const std::string end = "\n  </AppendedData>\n</VTKFile>\n";
  std::vector<std::string_view> pieces{text};
  pieces.insert(pieces.end(), appended_.begin(), appended_.end());
  pieces.push_back(end);
  write_whole_file(path, pieces);
}

}  // namespace cdfp
