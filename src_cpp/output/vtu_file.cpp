#include "output/vtu_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <bit>
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

std::string_view view(const void* data, std::size_t bytes) {
  return {static_cast<const char*>(data), bytes};
}

/// [blocks][bytes a block][bytes of a shorter last block or 0][compressed bytes of each], then the blocks.
void append_compressed(GrowingFile& file, std::span<const unsigned char> bytes) {
  const std::size_t blocks = (bytes.size() + block_bytes - 1) / block_bytes, at = file.size();
  std::vector<std::uint64_t> head{blocks, block_bytes, bytes.size() % block_bytes};
  head.resize(head.size() + blocks);
  const std::size_t head_bytes = head.size() * sizeof(std::uint64_t);
  file.append(view(head.data(), head_bytes));
  std::vector<unsigned char> room(compressBound(block_bytes));
  for (std::size_t block = 0; block < blocks; ++block) {
    const std::size_t begin = block * block_bytes;
    uLongf size = room.size();
    const uLong length = std::min(block_bytes, bytes.size() - begin);
    if (compress2(room.data(), &size, &bytes[begin], length, compression_level) != Z_OK)
      throw Error(Status::internal, "zlib could not compress a block of a snapshot");
    head[3 + block] = size;
    file.append(view(room.data(), size));
  }
  file.overwrite(at, view(head.data(), head_bytes));
}

}  // namespace

VtuFile::VtuFile(std::size_t points, std::size_t cells, double time)
    : point_count_(points), cell_count_(cells), time_(time) {}

template <class T>
void VtuFile::add(const char* section, const char* type, const std::string& name, int components,
                  std::span<const T> values) {
  arrays_.push_back({section,
                     type,
                     name,
                     components,
                     {reinterpret_cast<const unsigned char*>(values.data()), values.size_bytes()}});
}

void VtuFile::points(std::span<const double> coordinates) {
  add("Points", "Float64", "Points", 3, coordinates);
}

void VtuFile::cells(std::span<const Index> connectivity, std::span<const Index> offsets,
                    std::span<const std::uint8_t> types) {
  add("Cells", "Int32", "connectivity", 1, connectivity);
  add("Cells", "Int32", "offsets", 1, offsets);
  add("Cells", "UInt8", "types", 1, types);
}

void VtuFile::point_array(const std::string& name, int components, std::span<const double> values) {
  add("PointData", "Float64", name, components, values);
}

void VtuFile::cell_array(const std::string& name, std::span<const double> values) {
  add("CellData", "Float64", name, 1, values);
}

void VtuFile::cell_array(const std::string& name, std::span<const Index> values) {
  add("CellData", "Int32", name, 1, values);
}

/// Of one length for all offsets: blanks stand for the digits that are not there.
std::string VtuFile::head(const std::vector<std::size_t>& offsets) const {
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
  for (const std::string_view section : {"PointData", "CellData", "Points", "Cells"}) {
    text.append("      <").append(section).append(">\n");
    for (std::size_t i = 0; i < arrays_.size(); ++i) {
      const Array& array = arrays_[i];
      if (array.section != section) continue;
      constexpr std::size_t most_digits = 20;
      const std::string offset = std::to_string(offsets[i]);
      text.append("        <DataArray type=\"").append(array.type).append("\" Name=\"").append(array.name);
      text.append("\" NumberOfComponents=\"").append(std::to_string(array.components));
      text.append("\" format=\"appended\" offset=\"").append(offset).append("\"/>");
      text.append(most_digits - offset.size(), ' ').append("\n");
    }
    text.append("      </").append(section).append(">\n");
  }
  return text +
         "    </Piece>\n  </UnstructuredGrid>\n"
         "  <AppendedData encoding=\"raw\">\n_";
}

void VtuFile::write(const std::filesystem::path& path) const {
  GrowingFile file(path);
  std::vector<std::size_t> offsets(arrays_.size(), 0);
  file.append(head(offsets));
  const std::size_t first = file.size();
  for (std::size_t i = 0; i < arrays_.size(); ++i) {
    offsets[i] = file.size() - first;
    append_compressed(file, arrays_[i].bytes);
  }
  file.append("\n  </AppendedData>\n</VTKFile>\n");
  file.overwrite(0, head(offsets));
  file.finish();
}

}  // namespace cdfp
