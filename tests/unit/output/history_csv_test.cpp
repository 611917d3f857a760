#include "output/history_csv.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <sstream>

#include "cdfp/error.hpp"
#include "output/columns.hpp"
#include "output/files.hpp"
#include "sample_run.hpp"
#include "scratch_folder.hpp"
#include "vtu_reader.hpp"

namespace cdfp {
namespace {

History read_csv(const std::filesystem::path& path) {
  History history;
  std::istringstream lines(sample::read_text(path));
  std::string line, cell;
  std::getline(lines, line);
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) history.columns.push_back(cell);
  while (std::getline(lines, line)) {
    std::size_t count = 0;
    for (std::istringstream cells(line); std::getline(cells, cell, ','); ++count)
      history.values.push_back(std::strtod(cell.c_str(), nullptr));
    EXPECT_EQ(count, history.columns.size()) << line;
  }
  return history;
}

TEST(HistoryCsv, numbers_come_back_bit_for_bit) {
  const sample::ScratchFolder folder("csv");
  make_folder(folder.path());
  History history{
      {"a_s", "b"},
      {0.1, 1.0 / 3, 6e-8, -1e-310, std::numeric_limits<double>::infinity(), 123456789012345678.0}};
  HistoryCsv(folder / "history.csv").write(history);
  const History read = read_csv(folder / "history.csv");
  EXPECT_EQ(read.columns, history.columns);
  EXPECT_EQ(read.values, history.values);
}

TEST(HistoryCsv, growing_gives_the_file_of_one_write) {
  const sample::ScratchFolder folder("grow");
  make_folder(folder.path());
  HistoryCsv growing(folder / "growing.csv");
  const History whole = sample::history(50, 600e-6);
  for (const std::size_t rows : {1u, 2u, 2u, 17u, 50u}) {
    History part = whole;
    part.values.resize(rows * whole.columns.size());
    growing.write(part);
    EXPECT_EQ(read_csv(folder / "growing.csv").values, part.values);
  }
  HistoryCsv(folder / "whole.csv").write(whole);
  EXPECT_EQ(sample::read_text(folder / "growing.csv"), sample::read_text(folder / "whole.csv"));
}

TEST(HistoryCsv, a_shorter_or_other_history_starts_anew) {
  const sample::ScratchFolder folder("anew");
  make_folder(folder.path());
  HistoryCsv csv(folder / "history.csv");
  csv.write({{"a", "b"}, {1, 2, 3, 4}});
  csv.write({{"a", "b"}, {5, 6}});
  EXPECT_EQ(sample::read_text(folder / "history.csv"), "a,b\n5,6\n");
  csv.write({{"c"}, {7, 8}});
  EXPECT_EQ(sample::read_text(folder / "history.csv"), "c\n7\n8\n");
}

TEST(Columns, are_found_by_name_and_tell_their_units) {
  const History history{{"time_s", "step"}, {0.5, 1, 1.5, 2}};
  EXPECT_EQ(column(history, "step"), (std::vector<double>{1, 2}));
  EXPECT_TRUE(column(history, "force_n").empty());
  EXPECT_STREQ(column_units("time_s"), "s");
  EXPECT_STREQ(column_units("impactor_velocity_z_mps"), "m/s");
  EXPECT_STREQ(column_units("cohesive_dissipated_j"), "J");
  EXPECT_STREQ(column_units("impactor_force_z_n"), "N");
  EXPECT_STREQ(column_units("impactor_position_z_m"), "m");
  EXPECT_STREQ(column_units("cohesive_broken"), "1");
}

TEST(Files, what_cannot_be_written_is_named) {
  try {
    write_whole_file("/nowhere/at/all.txt", "x");
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::io);
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all.txt"), std::string::npos);
  }
}

}  // namespace
}  // namespace cdfp
