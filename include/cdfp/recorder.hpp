/// Everything that a run leaves in its folder.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cdfp/results.hpp"

namespace cdfp {

/// Every file is whole at any moment: a run that is cut short leaves its snapshots, its history and the last
/// snapshot's results.h5 readable.
class Recorder {
 public:
  /// Makes the folder and removes from it what an earlier run left. `crack_parts`: parts whose cracks get a
  /// picture each, `cracks_<name>.png` (without "_glass" at the name's end).
  Recorder(const std::string& folder, std::vector<std::string> crack_parts);
  /// Goes on in the folder of a run that was saved at `time` (s): keeps its snapshots and pictures up to then
  /// and takes away later ones. In another folder it starts with what comes.
  static Recorder continued(const std::string& folder, std::vector<std::string> crack_parts, double time);
  ~Recorder();
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;

  /// Writes a VTU snapshot, brings the .pvd up to date (readable at any moment) and keeps what the crack
  /// pictures need.
  void snapshot(const Frame& frame);
  /// Brings history.csv up to the rows so far.
  void history(const History& history);
  /// history.csv, results.h5, summary.json and the pictures; the last state as a snapshot if it is not one.
  void finish(const Frame& last, const History& history, const Summary& summary);

  /// What this build cannot write for want of a library, a sentence each; also among the summary's warnings.
  static std::vector<std::string> left_out();

 private:
  struct Files;
  explicit Recorder(std::unique_ptr<Files> files);
  std::unique_ptr<Files> files_;
};

}  // namespace cdfp
