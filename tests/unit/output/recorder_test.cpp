#include "cdfp/recorder.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "cdfp/error.hpp"
#include "sample_run.hpp"
#include "scratch_folder.hpp"
#include "vtu_reader.hpp"
#ifdef CDFP_HAS_HDF5
#include <hdf5.h>
#endif

namespace cdfp {
namespace {

const std::vector<std::string> panes = {"upper_glass", "lower_glass"};

/// Every file that is there can be read, and agrees with the others.
void expect_readable(const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder / "results.pvd")) {
    for (const auto& entry : sample::read_pvd(folder / "results.pvd"))
      EXPECT_EQ(sample::read_vtu(folder / entry.file).time, entry.time);
  }
  if (std::filesystem::exists(folder / "history.csv")) {
    const std::string text = sample::read_text(folder / "history.csv");
    EXPECT_EQ(text.back(), '\n');
    EXPECT_EQ(std::count(text.begin(), text.end(), ',') % std::count(text.begin(), text.end(), '\n'), 0);
  }
#ifdef CDFP_HAS_HDF5
  if (std::filesystem::exists(folder / "results.h5")) {
    const hid_t file = H5Fopen((folder / "results.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    EXPECT_GE(file, 0);
    EXPECT_GT(H5Lexists(file, "/final/cracks/damage", H5P_DEFAULT), 0);
    H5Fclose(file);
  }
#endif
}

TEST(Recorder, a_whole_run_leaves_every_file) {
  const sample::ScratchFolder folder("run");
  Recorder recorder(folder.path().string(), panes);
  for (const double time : {0.0, 33e-6, 120e-6}) recorder.snapshot(sample::state({}, time).frame);
  const History history = sample::history(20, 267e-6);
  recorder.history(history);
  recorder.finish(sample::state({}, 267e-6).frame, history, sample::summary());
  expect_readable(folder.path());
  EXPECT_EQ(sample::read_pvd(folder / "results.pvd").size(), 4u);
  EXPECT_EQ(sample::read_pvd(folder / "results.pvd").back().time, 267e-6);
  const auto json = nlohmann::json::parse(sample::read_text(folder / "summary.json"));
  EXPECT_EQ(json["elements"], 47088);
  EXPECT_EQ(json["warnings"].size(), 1 + Recorder::left_out().size());
  EXPECT_TRUE(std::filesystem::exists(folder / "history.csv"));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

TEST(Recorder, the_last_state_is_not_written_twice) {
  const sample::ScratchFolder folder("twice");
  Recorder recorder(folder.path().string(), panes);
  const sample::State last = sample::state({}, 33e-6);
  recorder.snapshot(last.frame);
  recorder.finish(last.frame, sample::history(3, 33e-6), sample::summary());
  EXPECT_EQ(sample::read_pvd(folder / "results.pvd").size(), 1u);
}

TEST(Recorder, an_earlier_run_leaves_no_trace_but_other_files_stay) {
  const sample::ScratchFolder folder("earlier");
  {
    Recorder recorder(folder.path().string(), panes);
    recorder.snapshot(sample::state({}, 33e-6).frame);
    recorder.finish(sample::state({}, 120e-6).frame, sample::history(3, 120e-6), sample::summary());
  }
  std::ofstream(folder / "notes.txt") << "mine";
  std::ofstream(folder / "cracks_by_hand.txt") << "mine";
  Recorder again(folder.path().string(), panes);
  std::vector<std::string> left;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    if (entry.is_regular_file()) left.push_back(entry.path().filename().string());
  std::sort(left.begin(), left.end());
  EXPECT_EQ(left, (std::vector<std::string>{"cracks_by_hand.txt", "notes.txt"}));
}

TEST(Recorder, a_folder_that_cannot_be_made_is_named) {
  const sample::ScratchFolder folder("file");
  std::filesystem::create_directories(folder.path());
  std::ofstream(folder / "taken") << "x";
  try {
    Recorder recorder((folder / "taken").string(), panes);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::io);
    EXPECT_NE(std::string(error.what()).find("taken"), std::string::npos);
  }
}

TEST(Recorder, a_run_that_is_killed_leaves_readable_files) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const std::vector<sample::State> states = [] {
    std::vector<sample::State> all;
    for (int i = 0; i < 40; ++i) all.push_back(sample::state({}, i * 15e-6));
    return all;
  }();
  for (int round = 0; round < 8; ++round) {
    const sample::ScratchFolder folder("killed" + std::to_string(round));
    const pid_t child = fork();
    if (child == 0) {
      Recorder recorder(folder.path().string(), panes);
      for (int i = 0; i < 40; ++i) {
        recorder.history(sample::history(i + 1, i * 15e-6));
        recorder.snapshot(states[static_cast<std::size_t>(i)].frame);
      }
      _exit(0);
    }
    std::this_thread::sleep_for(
        std::chrono::microseconds(std::uniform_int_distribution<>(2000, 150000)(random)));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    expect_readable(folder.path());
  }
}

}  // namespace
}  // namespace cdfp
