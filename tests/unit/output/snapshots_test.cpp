#include "output/snapshots.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <random>

#include "output/files.hpp"
#include "output/vtu_file.hpp"
#include "sample_run.hpp"
#include "scratch_folder.hpp"
#include "vtu_reader.hpp"

namespace cdfp {
namespace {

TEST(Snapshots, bulk_arrays_come_back_bit_for_bit) {
  const sample::ScratchFolder folder("bulk");
  const sample::State state = sample::state({}, 120e-6);
  make_folder(folder.path());
  Snapshots(folder.path()).write(state.frame);
  const sample::Vtu vtu = sample::read_vtu(folder / "snapshots/0000.vtu");
  EXPECT_EQ(vtu.points, state.positions.size() / 3);
  EXPECT_EQ(vtu.cells, state.parts.size());
  EXPECT_EQ(vtu.time, 120e-6);
  EXPECT_EQ(vtu.at("Points", "Points").as<double>(), state.positions);
  EXPECT_EQ(vtu.at("Points", "Points").components, 3);
  EXPECT_EQ(vtu.at("PointData", "velocity").as<double>(), state.velocities);
  EXPECT_EQ(vtu.at("PointData", "velocity").components, 3);
  EXPECT_EQ(vtu.at("Cells", "connectivity").as<Index>(), state.connectivity);
  EXPECT_EQ(vtu.at("CellData", "part").as<Index>(), state.parts);
  EXPECT_EQ(vtu.at("CellData", "von_mises").as<double>(), state.frame.von_mises);
  EXPECT_EQ(vtu.at("CellData", "max_principal").as<double>(), state.frame.max_principal);
  const auto offsets = vtu.at("Cells", "offsets").as<Index>();
  ASSERT_EQ(offsets.size(), vtu.cells);
  const auto types = vtu.at("Cells", "types").as<std::uint8_t>();
  for (std::size_t e = 0; e < vtu.cells; ++e) {
    EXPECT_EQ(offsets[e], state.first_corner[e + 1]);
    EXPECT_EQ(types[e], e + 1 < vtu.cells ? 12 : 10);
  }
}

TEST(Snapshots, a_wedge_is_a_cell_of_type_13) {
  const sample::ScratchFolder folder("wedge");
  const std::vector<double> positions{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1}, velocities(18);
  const std::vector<Index> connectivity{0, 1, 2, 3, 4, 5}, first_corner{0, 6}, parts{0};
  Frame frame;
  frame.positions = positions;
  frame.velocities = velocities;
  frame.connectivity = connectivity;
  frame.first_corner = first_corner;
  frame.parts = parts;
  make_folder(folder.path());
  Snapshots(folder.path()).write(frame);
  const sample::Vtu vtu = sample::read_vtu(folder / "snapshots/0000.vtu");
  EXPECT_EQ(vtu.at("Cells", "types").as<std::uint8_t>(), std::vector<std::uint8_t>{13});
  EXPECT_EQ(vtu.at("Cells", "offsets").as<Index>(), std::vector<Index>{6});
}

TEST(Snapshots, crack_faces_lie_midway_between_their_sides) {
  const sample::ScratchFolder folder("faces");
  sample::State state = sample::state({}, 120e-6);
  CrackFacet triangle = state.frame.cracks.front();
  triangle.corners = 3;
  triangle.upper[3] = triangle.lower[3] = kNone;
  state.frame.cracks.push_back(triangle);
  state.positions[3 * static_cast<std::size_t>(state.frame.cracks[1].lower[2])] += 4e-6;
  state.frame.positions = state.positions;
  Snapshots(folder.path()).write(state.frame);
  const sample::Vtu vtu = sample::read_vtu(folder / "snapshots/cracks_0000.vtu");
  const auto& cracks = state.frame.cracks;
  ASSERT_EQ(vtu.cells, cracks.size());
  const auto points = vtu.at("Points", "Points").as<double>();
  const auto ends = vtu.at("Cells", "offsets").as<Index>();
  const auto corners = vtu.at("Cells", "connectivity").as<Index>();
  const auto types = vtu.at("Cells", "types").as<std::uint8_t>();
  std::int64_t begin = 0;
  for (std::size_t f = 0; f < cracks.size(); ++f) {
    ASSERT_EQ(ends[f] - begin, cracks[f].corners);
    EXPECT_EQ(types[f], cracks[f].corners == 3 ? 5 : 9);
    for (std::size_t c = 0; c < static_cast<std::size_t>(cracks[f].corners); ++c) {
      const std::size_t at = 3 * static_cast<std::size_t>(corners[static_cast<std::size_t>(begin) + c]);
      for (std::size_t i = 0; i < 3; ++i) {
        const double a = state.positions[3 * static_cast<std::size_t>(cracks[f].upper[c]) + i];
        const double b = state.positions[3 * static_cast<std::size_t>(cracks[f].lower[c]) + i];
        EXPECT_NEAR(points[at + i], a + (b - a) / 2, 1e-15);
      }
    }
    EXPECT_EQ(vtu.at("CellData", "damage").as<double>()[f], cracks[f].damage);
    EXPECT_EQ(vtu.at("CellData", "insertion_time").as<double>()[f], cracks[f].insertion_time);
    EXPECT_EQ(vtu.at("CellData", "layer").as<Index>()[f], cracks[f].layer);
    EXPECT_EQ(vtu.at("CellData", "part").as<Index>()[f], cracks[f].part);
    begin = ends[f];
  }
}

TEST(Snapshots, a_state_without_cracks_has_an_empty_file_of_cracks) {
  const sample::ScratchFolder folder("whole");
  const sample::State state = sample::state({}, 0);
  Snapshots(folder.path()).write(state.frame);
  const sample::Vtu vtu = sample::read_vtu(folder / "snapshots/cracks_0000.vtu");
  EXPECT_EQ(vtu.cells, 0u);
  EXPECT_EQ(vtu.points, 0u);
  EXPECT_TRUE(vtu.at("CellData", "damage").bytes.empty());
}

TEST(Snapshots, the_collections_name_every_time) {
  const sample::ScratchFolder folder("times");
  Snapshots snapshots(folder.path());
  const std::vector<double> times = {0, 33e-6, 1.2e-4};
  for (std::size_t i = 0; i < times.size(); ++i) {
    snapshots.write(sample::state({}, times[i]).frame);
    for (const char* name : {"results.pvd", "cracks.pvd"}) {
      const auto entries = sample::read_pvd(folder / name);
      ASSERT_EQ(entries.size(), i + 1);
      for (std::size_t k = 0; k <= i; ++k) {
        EXPECT_EQ(entries[k].time, times[k]);
        EXPECT_EQ(sample::read_vtu(folder / entries[k].file).time, times[k]);
      }
    }
  }
}

// Sizes around the block length, where a reader's count of blocks and of the last one's bytes can go wrong.
TEST(VtuFile, arrays_of_any_length_come_back) {
  const sample::ScratchFolder folder("blocks");
  make_folder(folder.path());
  std::mt19937 random(20150411);
  for (const std::size_t points : {0u, 1u, 10922u, 10923u, 32768u, 32769u, 98304u, 100000u}) {
    SCOPED_TRACE(points);
    std::vector<double> coordinates(3 * points);
    for (double& x : coordinates) x = std::uniform_real_distribution<>(-1, 1)(random);
    VtuFile file(points, 0, 1);
    file.points(coordinates);
    file.write(folder / "a.vtu");
    EXPECT_EQ(sample::read_vtu(folder / "a.vtu").at("Points", "Points").as<double>(), coordinates);
  }
}

TEST(Snapshots, vtk_reads_the_same_values) {
  const sample::ScratchFolder folder("vtk");
  const sample::State state = sample::state({}, 267e-6);
  Snapshots(folder.path()).write(state.frame);
  const std::string values = (folder / "values.txt").string();
  const std::string command =
      std::string("/usr/bin/python3 ") + CDFP_READ_WITH_VTK + " " + (folder / "snapshots/0000.vtu").string() +
      " " + (folder / "snapshots/cracks_0000.vtu").string() + " > " + values + " 2>/dev/null";
  const int status = std::system(command.c_str());
  constexpr int no_vtk = 77, no_python = 127;
  if (WEXITSTATUS(status) == no_vtk || WEXITSTATUS(status) == no_python)
    GTEST_SKIP() << "VTK for Python is not there (python3-vtk9)";
  ASSERT_EQ(status, 0);
  std::ifstream in(values);
  std::map<std::string, std::vector<double>> arrays;
  std::string name;
  for (std::size_t count = 0; in >> name >> count;) {
    std::string number;
    for (std::size_t i = 0; i < count && in >> number; ++i)
      arrays[name].push_back(std::strtod(number.c_str(), nullptr));
    ASSERT_EQ(arrays[name].size(), count) << name;
  }
  EXPECT_EQ(arrays["0:points"], state.positions);
  EXPECT_EQ(arrays["0:velocity"], state.velocities);
  EXPECT_EQ(arrays["0:part"], std::vector<double>(state.parts.begin(), state.parts.end()));
  EXPECT_EQ(arrays["0:von_mises"], state.frame.von_mises);
  EXPECT_EQ(arrays["0:max_principal"], state.frame.max_principal);
  EXPECT_EQ(arrays["0:TimeValue"], std::vector<double>{267e-6});
  std::vector<double> types(state.parts.size(), 12);
  types.back() = 10;
  EXPECT_EQ(arrays["0:cell_types"], types);
  EXPECT_EQ(arrays["0:corners"], std::vector<double>(state.connectivity.begin(), state.connectivity.end()));
  std::vector<double> damage, layer;
  for (const CrackFacet& facet : state.frame.cracks) {
    damage.push_back(facet.damage);
    layer.push_back(facet.layer);
  }
  EXPECT_EQ(arrays["1:damage"], damage);
  EXPECT_EQ(arrays["1:layer"], layer);
  EXPECT_EQ(arrays["1:cell_types"], std::vector<double>(damage.size(), 9));
}

}  // namespace
}  // namespace cdfp
