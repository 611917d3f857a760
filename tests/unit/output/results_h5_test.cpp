#include "output/results_h5.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>

#include "output/columns.hpp"
#include "output/files.hpp"
#include "sample_run.hpp"
#include "scratch_folder.hpp"

namespace cdfp {
namespace {

struct Opened {
  hid_t file;
  explicit Opened(const std::filesystem::path& path)
      : file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {}
  ~Opened() { H5Fclose(file); }

  std::vector<hsize_t> extent(const std::string& name) const {
    const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT), space = H5Dget_space(set);
    std::vector<hsize_t> sizes(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, sizes.data(), nullptr);
    H5Sclose(space);
    H5Dclose(set);
    return sizes;
  }

  template <class Number>
  std::vector<Number> read(const std::string& name, hid_t type) const {
    std::size_t count = 1;
    for (const hsize_t size : extent(name)) count *= size;
    std::vector<Number> values(count);
    const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT);
    EXPECT_GE(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0) << name;
    H5Dclose(set);
    return values;
  }
  std::vector<double> numbers(const std::string& name) const { return read<double>(name, H5T_NATIVE_DOUBLE); }
  std::vector<Index> indices(const std::string& name) const { return read<Index>(name, H5T_NATIVE_INT32); }

  std::string units(const std::string& name) const {
    const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT), id = H5Aopen(set, "units", H5P_DEFAULT);
    const hid_t type = H5Aget_type(id);
    char* text = nullptr;
    H5Aread(id, type, &text);
    const std::string copy = text;
    H5free_memory(text);
    H5Tclose(type);
    H5Aclose(id);
    H5Dclose(set);
    return copy;
  }

  bool compressed(const std::string& name) const {
    const hid_t set = H5Dopen2(file, name.c_str(), H5P_DEFAULT), list = H5Dget_create_plist(set);
    bool deflated = false;
    for (int i = 0; i < H5Pget_nfilters(list); ++i) {
      unsigned flags = 0, filter = 0;
      std::size_t none = 0;
      deflated |= H5Pget_filter2(list, static_cast<unsigned>(i), &flags, &none, nullptr, 0, nullptr,
                                 &filter) == H5Z_FILTER_DEFLATE;
    }
    H5Pclose(list);
    H5Dclose(set);
    return deflated;
  }
};

TEST(ResultsH5, history_and_state_come_back_bit_for_bit) {
  const sample::ScratchFolder folder("h5");
  make_folder(folder.path());
  const sample::State state = sample::state({}, 120e-6);
  const History history = sample::history(30, 600e-6);
  write_results_h5(folder / "results.h5", state.frame, history);
  const Opened h5(folder / "results.h5");
  for (const std::string& name : history.columns)
    EXPECT_EQ(h5.numbers("/history/" + name), column(history, name));
  EXPECT_EQ(h5.numbers("/final/positions"), state.positions);
  EXPECT_EQ(h5.extent("/final/positions"), (std::vector<hsize_t>{state.positions.size() / 3, 3}));
  EXPECT_EQ(h5.numbers("/final/velocities"), state.velocities);
  EXPECT_EQ(h5.indices("/final/connectivity"), state.connectivity);
  EXPECT_EQ(h5.indices("/final/first_corner"), state.first_corner);
  EXPECT_EQ(h5.indices("/final/parts"), state.parts);
  EXPECT_EQ(h5.numbers("/final/von_mises"), state.frame.von_mises);
  const auto lower = h5.indices("/final/cracks/lower");
  const auto damage = h5.numbers("/final/cracks/damage"), broken = h5.numbers("/final/cracks/broken_time");
  const auto& cracks = state.frame.cracks;
  ASSERT_EQ(damage.size(), cracks.size());
  for (std::size_t f = 0; f < cracks.size(); ++f) {
    EXPECT_EQ(damage[f], cracks[f].damage);
    EXPECT_EQ(broken[f], cracks[f].broken_time);
    for (std::size_t c = 0; c < 4; ++c) EXPECT_EQ(lower[4 * f + c], cracks[f].lower[c]);
  }
  EXPECT_TRUE(h5.compressed("/final/positions"));
  EXPECT_TRUE(h5.compressed("/history/time_s"));
  EXPECT_EQ(h5.units("/history/kinetic_j"), "J");
  EXPECT_EQ(h5.units("/history/energy_balance"), "1");
  EXPECT_EQ(h5.units("/final/velocities"), "m/s");
}

TEST(ResultsH5, nothing_yet_is_a_file_with_empty_datasets) {
  const sample::ScratchFolder folder("h5_empty");
  make_folder(folder.path());
  const sample::State state = sample::state({}, 0);
  write_results_h5(folder / "results.h5", state.frame, {{"time_s"}, {}});
  const Opened h5(folder / "results.h5");
  EXPECT_TRUE(h5.numbers("/history/time_s").empty());
  EXPECT_EQ(h5.extent("/final/cracks/upper"), (std::vector<hsize_t>{0, 4}));
}

}  // namespace
}  // namespace cdfp
