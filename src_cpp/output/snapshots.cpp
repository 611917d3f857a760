#include "output/snapshots.hpp"

#include <charconv>
#include <cstdio>
#include <string>
#include <string_view>
#include <system_error>

#include "output/files.hpp"
#include "output/numbers.hpp"
#include "output/vtu_file.hpp"

namespace cdfp {
namespace {

constexpr std::uint8_t vtk_triangle = 5, vtk_quad = 9, vtk_tetrahedron = 10, vtk_hexahedron = 12,
                       vtk_wedge = 13;

std::string snapshot_name(const char* prefix, std::size_t number) {
  char text[40];
  std::snprintf(text, sizeof text, "snapshots/%s%04zu.vtu", prefix, number);
  return text;
}

void write_bulk(const Frame& frame, const std::filesystem::path& path) {
  const std::size_t elements = frame.parts.size();
  std::vector<std::uint8_t> types(elements, vtk_hexahedron);
  for (std::size_t e = 0; e < elements; ++e) {
    const std::int64_t corners = frame.first_corner[e + 1] - frame.first_corner[e];
    if (corners == 4) types[e] = vtk_tetrahedron;
    if (corners == 6) types[e] = vtk_wedge;
  }
  VtuFile file(frame.positions.size() / 3, elements, frame.time);
  file.points(frame.positions);
  file.cells(frame.connectivity, frame.first_corner.subspan(1), types);
  file.point_array("velocity", 3, frame.velocities);
  file.cell_array("part", frame.parts);
  if (frame.von_mises.size() == elements) file.cell_array("von_mises", frame.von_mises);
  if (frame.max_principal.size() == elements) file.cell_array("max_principal", frame.max_principal);
  for (const ElementField& field : frame.fields) file.cell_array(field.name, field.values);
  file.write(path);
}

void write_cracks(const Frame& frame, const std::filesystem::path& path) {
  std::vector<double> points, damage, insertion_time;
  std::vector<Index> connectivity, ends, layer, part;
  std::vector<std::uint8_t> types;
  for (const CrackFacet& facet : frame.cracks) {
    for (Index corner = 0; corner < facet.corners; ++corner) {
      const auto c = static_cast<std::size_t>(corner);
      const double* upper = &frame.positions[3 * static_cast<std::size_t>(facet.upper[c])];
      const double* lower = &frame.positions[3 * static_cast<std::size_t>(facet.lower[c])];
      connectivity.push_back(static_cast<Index>(points.size() / 3));
      for (int i = 0; i < 3; ++i) points.push_back(0.5 * (upper[i] + lower[i]));
    }
    ends.push_back(static_cast<Index>(connectivity.size()));
    types.push_back(facet.corners == 3 ? vtk_triangle : vtk_quad);
    damage.push_back(facet.damage);
    insertion_time.push_back(facet.insertion_time);
    layer.push_back(facet.layer);
    part.push_back(facet.part);
  }
  VtuFile file(points.size() / 3, types.size(), frame.time);
  file.points(points);
  file.cells(connectivity, ends, types);
  file.cell_array("damage", damage);
  file.cell_array("insertion_time", insertion_time);
  file.cell_array("layer", layer);
  file.cell_array("part", part);
  file.write(path);
}

void write_collection(const std::filesystem::path& path, const char* prefix,
                      const std::vector<double>& times) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (std::size_t i = 0; i < times.size(); ++i)
    text += "    <DataSet timestep=\"" + to_text(times[i]) + "\" part=\"0\" file=\"" +
            snapshot_name(prefix, i) + "\"/>\n";
  write_whole_file(path, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace

void Snapshots::write(const Frame& frame) {
  const std::size_t number = times_.size();
  make_folder(folder_ / "snapshots");
  write_bulk(frame, folder_ / snapshot_name("", number));
  write_cracks(frame, folder_ / snapshot_name("cracks_", number));
  times_.push_back(frame.time);
  write_collections();
}

void Snapshots::take_up(double time) {
  const std::string earlier = contents_of(folder_ / "results.pvd");
  static constexpr std::string_view kBefore = "timestep=\"";
  std::size_t listed = 0;
  times_.clear();
  for (std::size_t at = earlier.find(kBefore); at != std::string::npos; at = earlier.find(kBefore, at)) {
    at += kBefore.size();
    double of_snapshot = 0;
    std::from_chars(earlier.data() + at, earlier.data() + earlier.size(), of_snapshot);
    if (of_snapshot <= time && listed == times_.size()) times_.push_back(of_snapshot);
    ++listed;
  }
  if (listed == times_.size()) return;
  write_collections();
  std::error_code ignored;
  for (std::size_t number = times_.size(); number < listed; ++number) {
    for (const char* prefix : {"", "cracks_"})
      std::filesystem::remove(folder_ / snapshot_name(prefix, number), ignored);
  }
}

void Snapshots::write_collections() const {
  write_collection(folder_ / "results.pvd", "", times_);
  write_collection(folder_ / "cracks.pvd", "cracks_", times_);
}

}  // namespace cdfp
