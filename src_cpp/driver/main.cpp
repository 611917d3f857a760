// The command `cdfp`: runs case files.

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>

#include "cdfp/material_library.hpp"
#include "driver/case_reader.hpp"
#include "driver/large_blocks.hpp"
#include "driver/run_case.hpp"
#include "model/lookup.hpp"
#include "scene/scene.hpp"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUse = 2;
constexpr int kInterrupted = 130;

std::string default_folder(const std::string& case_file) {
  return "out/" + std::filesystem::path(case_file).stem().string();
}

int check(const std::string& case_file) {
  const cdfp::Model model = cdfp::read_case(case_file);
  const std::vector<std::string> warnings = cdfp::check_model(model);
  std::size_t segments = 0;
  for (const std::string& name : model.contact.surfaces)
    segments += cdfp::facet_set(model.mesh, name).facets.size();
  std::printf("%s: %s: %d elements, %d nodes, %zu segments\n", case_file.c_str(), model.title.c_str(),
              model.mesh.element_count(), model.mesh.node_count(), segments);
  for (const std::string& warning : warnings) std::printf("warning: %s\n", warning.c_str());
  return 0;
}

int run(const std::string& case_file, const std::string& folder, int threads, const std::string& restart) {
  cdfp::Model model = cdfp::read_case(case_file);
  if (threads > 0) model.threads = threads;
  return cdfp::run_case(std::move(model), folder, restart) ? 0 : kInterrupted;
}

int build(const std::string& source, const std::string& output, bool single) {
  const std::string library =
      output.empty() ? std::filesystem::path(source).replace_extension(".so").string() : output;
  cdfp::build_material(source, library, {single});
  std::printf("%s\n", library.c_str());
  return 0;
}

/// GNU's OpenMP lets threads spin for about a millisecond before they sleep, and reads how long when the
/// program is loaded. Beside other work on the same processors that makes two threads ten times slower than
/// one; on a free machine the short spin costs nothing measurable. A user's own choice stands, and so does a
/// tool such as valgrind, which a new start would shake off.
void start_with_short_spin(char** arguments) {
  for (const char* name : {"OMP_WAIT_POLICY", "GOMP_SPINCOUNT", "LD_PRELOAD"}) {
    if (std::getenv(name) != nullptr) return;
  }
  if (setenv("GOMP_SPINCOUNT", "20000", 1) == 0) execv("/proc/self/exe", arguments);
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): nothing is left to do when memory runs out in CLI11
int main(int argc, char** argv) {
  start_with_short_spin(argv);
  cdfp::give_large_blocks_back();
  CLI::App app{"Explicit finite elements for impact fracture of laminated glass", "cdfp"};
  app.set_version_flag("--version", "cdfp " CDFP_VERSION);
  app.require_subcommand(1);
  std::string case_file;
  std::string folder;
  int threads = 0;
  CLI::App* run_command = app.add_subcommand("run", "Run a case and write its results");
  run_command->add_option("CASE", case_file, "Case file (TOML)")->required();
  run_command->add_option("--out", folder, "Folder of the results (default: out/ and the case file's name)");
  run_command
      ->add_option("--threads", threads, "Threads (default: the case's, or as many as the machine has)")
      ->check(CLI::Range(1, 1024));
  std::string restart;
  run_command->add_option("--restart", restart,
                          "Go on from restart.cdfp, as an earlier run of the case has saved it");
  CLI::App* check_command = app.add_subcommand("check", "Read and check a case without running it");
  check_command->add_option("CASE", case_file, "Case file (TOML)")->required();
  std::string source;
  std::string library;
  bool single = false;
  CLI::App* build_command =
      app.add_subcommand("build-material", "Compile a VUMAT or another material to a shared library");
  build_command->add_option("FILE", source, "Source: Fortran (.f .for .f90), C or C++")->required();
  build_command->add_option("-o,--output", library, "Library (default: the source with the ending .so)");
  build_command->add_flag("--single", single, "Reals of four bytes (vaba_param_sp.inc)");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kWrongUse;
  }
  try {
    if (check_command->parsed()) return check(case_file);
    if (build_command->parsed()) return build(source, library, single);
    return run(case_file, folder.empty() ? default_folder(case_file) : folder, threads, restart);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cdfp: error: %s\n", error.what());
    return kFailed;
  }
}
