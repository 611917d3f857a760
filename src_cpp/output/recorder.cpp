#include "cdfp/recorder.hpp"

#include <filesystem>
#include <system_error>

#include "output/files.hpp"
#include "output/history_csv.hpp"
#include "output/snapshots.hpp"
#include "output/summary_json.hpp"
#ifdef CDFP_HAS_HDF5
#include "output/results_h5.hpp"
#endif
#ifdef CDFP_HAS_CAIRO
#include "output/pictures.hpp"
#endif

namespace cdfp {
namespace {

/// Files of an earlier run would pass for this one's.
void remove_earlier(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::vector<std::filesystem::path> earlier;
  for (const char* name : {"results.pvd", "cracks.pvd", "history.csv", "results.h5", "summary.json",
                           "restart.cdfp", "snapshots/pictures.cdfp"})
    earlier.push_back(folder / name);
  for (const auto& entry : std::filesystem::directory_iterator(folder / "snapshots", ignored))
    if (entry.path().extension() == ".vtu") earlier.push_back(entry.path());
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    const std::string stem = entry.path().stem().string(), kind = entry.path().extension().string();
    const bool picture =
        stem == "force" || stem == "energy" || stem == "section" || stem.starts_with("cracks_");
    if (picture && (kind == ".png" || kind == ".svg")) earlier.push_back(entry.path());
  }
  for (const std::filesystem::path& path : earlier) std::filesystem::remove(path, ignored);
}

}  // namespace

struct Recorder::Files {
  std::filesystem::path folder;
  Snapshots snapshots;
  HistoryCsv history_csv;
  History rows;
#ifdef CDFP_HAS_CAIRO
  Pictures pictures;
#endif

  static std::unique_ptr<Files> in(const std::filesystem::path& path, std::vector<std::string> crack_parts);
};

Recorder::Recorder(std::unique_ptr<Files> files) : files_(std::move(files)) {}
Recorder::~Recorder() = default;
Recorder::Recorder(Recorder&&) noexcept = default;
Recorder& Recorder::operator=(Recorder&&) noexcept = default;

std::unique_ptr<Recorder::Files> Recorder::Files::in(const std::filesystem::path& path,
                                                     [[maybe_unused]] std::vector<std::string> crack_parts) {
  make_folder(path);
  return std::unique_ptr<Files>(new Files{.folder = path,
                                          .snapshots = Snapshots(path),
                                          .history_csv = HistoryCsv(path / "history.csv"),
                                          .rows = {},
#ifdef CDFP_HAS_CAIRO
                                          .pictures = Pictures(path, std::move(crack_parts))
#endif
  });
}

Recorder::Recorder(const std::string& folder, std::vector<std::string> crack_parts)
    : files_(Files::in(folder, std::move(crack_parts))) {
  remove_earlier(files_->folder);
}

Recorder Recorder::continued(const std::string& folder, std::vector<std::string> crack_parts, double time) {
  Recorder recorder(Files::in(folder, std::move(crack_parts)));
  recorder.files_->snapshots.take_up(time);
#ifdef CDFP_HAS_CAIRO
  recorder.files_->pictures.take_up(time);
#endif
  return recorder;
}

void Recorder::snapshot(const Frame& frame) {
  files_->snapshots.write(frame);
#ifdef CDFP_HAS_HDF5
  write_results_h5(files_->folder / "results.h5", frame, files_->rows);
#endif
#ifdef CDFP_HAS_CAIRO
  files_->pictures.keep(frame);
#endif
}

void Recorder::history(const History& history) {
  files_->rows = history;
  files_->history_csv.write(history);
}

void Recorder::finish(const Frame& last, const History& rows, const Summary& summary) {
  history(rows);
  if (files_->snapshots.last_time() != last.time) snapshot(last);
#ifdef CDFP_HAS_HDF5
  write_results_h5(files_->folder / "results.h5", last, rows);
#endif
  Summary complete = summary;
  for (std::string& sentence : left_out()) complete.warnings.push_back(std::move(sentence));
  write_whole_file(files_->folder / "summary.json", summary_json(complete));
#ifdef CDFP_HAS_CAIRO
  files_->pictures.draw(rows, summary);
#endif
}

std::vector<std::string> Recorder::left_out() {
  std::vector<std::string> sentences;
#ifndef CDFP_HAS_HDF5
  sentences.push_back(
      "results.h5 is not written: this build lacks HDF5; install libhdf5-dev and build again");
#endif
#ifndef CDFP_HAS_CAIRO
  sentences.push_back(
      "pictures are not drawn: this build lacks cairo; install libcairo2-dev and build again");
#endif
  return sentences;
}

}  // namespace cdfp
