// The command as a user meets it: exit codes, messages, files after Ctrl-C.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>
#include <utility>
#include <vector>

namespace {

namespace fs = std::filesystem;

std::string contents(const fs::path& path) {
  std::ifstream stream(path);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

class Command : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cdfp_command_test_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// A copy of the quick case with pieces of its text changed.
  fs::path case_with(const std::vector<std::pair<std::string, std::string>>& changes) const {
    std::string text = contents(CDFP_EXAMPLES "/laminated_glass/case_quick.toml");
    for (const auto& [from, to] : changes) {
      const std::size_t at = text.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      text.replace(at, from.size(), to);
    }
    const fs::path path = folder_ / "case.toml";
    std::ofstream(path) << text;
    return path;
  }

  pid_t start(const std::vector<std::string>& arguments) const {
    const pid_t child = fork();
    if (child != 0) return child;
    std::vector<std::string> words{CDFP_COMMAND};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> raw;
    for (std::string& word : words) raw.push_back(word.data());
    raw.push_back(nullptr);
    const bool redirected = std::freopen((folder_ / "stdout").c_str(), "w", stdout) &&
                            std::freopen((folder_ / "stderr").c_str(), "w", stderr);
    if (redirected) execv(raw[0], raw.data());
    _exit(127);
  }

  static int wait_for(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  int run(const std::vector<std::string>& arguments) const { return wait_for(start(arguments)); }
  std::string out() const { return contents(folder_ / "stdout"); }
  std::string err() const { return contents(folder_ / "stderr"); }

  fs::path folder_;
};

TEST_F(Command, TellsItsVersion) {
  EXPECT_EQ(run({"--version"}), 0);
  EXPECT_EQ(out().rfind("cdfp ", 0), 0u) << out();
}

TEST_F(Command, RefusesWrongUse) {
  EXPECT_EQ(run({}), 2);
  EXPECT_EQ(run({"run"}), 2);
  EXPECT_EQ(run({"run", "x.toml", "--threads", "0"}), 2);
  EXPECT_EQ(run({"run", "x.toml", "--treads", "2"}), 2);
  EXPECT_NE(err().find("--treads"), std::string::npos) << err();
}

TEST_F(Command, TellsWhereACaseIsWrong) {
  const fs::path path = case_with({{"youngs_modulus", "young_modulus"}});
  EXPECT_EQ(run({"check", path}), 1);
  EXPECT_EQ(err().rfind("cdfp: error: " + path.string() + ":", 0), 0u) << err();
  EXPECT_NE(err().find("unknown key 'young_modulus'"), std::string::npos) << err();
  EXPECT_EQ(run({"run", path, "--out", folder_ / "results"}), 1);
  EXPECT_FALSE(fs::exists(folder_ / "results")) << "a case that cannot run leaves no folder";
}

TEST_F(Command, ChecksTheExamples) {
  EXPECT_EQ(run({"check", CDFP_EXAMPLES "/laminated_glass/case_quick.toml"}), 0);
  EXPECT_NE(out().find("8448 elements"), std::string::npos) << out();
}

/// The example of users' materials in a copy of its folder, so that what is compiled stays apart.
TEST_F(Command, RunsUsersMaterials) {
  fs::copy(CDFP_EXAMPLES "/user_material", folder_ / "user_material");
  const fs::path path = folder_ / "user_material" / "case.toml";
  std::string text = contents(path);
  for (const auto& [from, to] :
       {std::pair<const char*, const char*>{"end = 60e-6", "end = 2e-6"},
        std::pair<const char*, const char*>{"snapshot_times = [30e-6, 60e-6]", "snapshot_times = [2e-6]"}}) {
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, std::string(from).size(), to);
  }
  std::ofstream(path) << text;
  ASSERT_EQ(run({"run", path, "--out", folder_ / "results"}), 0) << err();
  EXPECT_NE(contents(folder_ / "results" / "snapshots" / "0000.vtu").find("plastic_strain"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "user_material" / ".cdfp"));

  std::ofstream(folder_ / "user_material" / "johnson_cook.f") << "      subroutine vumat(\n";
  EXPECT_EQ(run({"check", path}), 1);
  EXPECT_EQ(err().rfind("cdfp: error: " + path.string() + ":", 0), 0u) << err();
  EXPECT_NE(err().find("johnson_cook.f:1:"), std::string::npos) << err();
}

TEST_F(Command, BuildsMaterials) {
  const fs::path library = folder_ / "law.so";
  EXPECT_EQ(run({"build-material", CDFP_EXAMPLES "/user_material/johnson_cook.f", "-o", library}), 0)
      << err();
  EXPECT_EQ(out(), library.string() + "\n");
  EXPECT_TRUE(fs::exists(library));
  EXPECT_EQ(run({"build-material", "--single", CDFP_EXAMPLES "/user_material/johnson_cook.f", "-o", library}),
            0);
  EXPECT_EQ(run({"build-material", folder_ / "nothing.f"}), 1);
  EXPECT_NE(err().find("cannot read the source"), std::string::npos) << err();
  EXPECT_EQ(run({"build-material"}), 2);
}

/// A run in two pieces leaves the files of the whole one.
TEST_F(Command, GoesOnWithARunThatWasStopped) {
  const std::vector<std::pair<std::string, std::string>> quick{
      {"columns = 25", "columns = 11"},
      {"snapshot_times = [20e-6, 33e-6, 80e-6]", "snapshot_times = [12e-6, 24e-6, 30e-6]"},
      {"history_interval = 20", "history_interval = 20\nrestart_interval = 150"}};
  const auto ends_at = [&](const std::string& end) {
    std::vector<std::pair<std::string, std::string>> changes = quick;
    changes.emplace_back("end = 80e-6", "end = " + end);
    return case_with(changes);
  };
  const fs::path whole = folder_ / "whole", pieces = folder_ / "pieces";
  ASSERT_EQ(run({"run", ends_at("36e-6"), "--out", whole, "--threads", "1"}), 0) << err();
  ASSERT_EQ(run({"run", ends_at("24e-6"), "--out", pieces, "--threads", "1"}), 0) << err();
  const fs::path saved = folder_ / "saved";
  fs::copy(pieces / "restart.cdfp", saved);
  // It had gone on a little and was lost.
  ASSERT_EQ(
      run({"run", ends_at("30e-6"), "--out", pieces, "--threads", "2", "--restart", pieces / "restart.cdfp"}),
      0)
      << err();
  ASSERT_EQ(run({"run", ends_at("36e-6"), "--out", pieces, "--threads", "2", "--restart", saved}), 0)
      << err();
  EXPECT_NE(contents(whole / "history.csv").size(), 0u);
  std::size_t compared = 0;
  for (const auto& entry : fs::recursive_directory_iterator(whole)) {
    const std::string name = fs::relative(entry.path(), whole).string();
    // These hold wall times or the time of day.
    if (name == "summary.json" || name == "restart.cdfp" || name == "results.h5") continue;
    if (!entry.is_regular_file()) continue;
    EXPECT_TRUE(contents(entry.path()) == contents(pieces / name)) << name;
    ++compared;
  }
  EXPECT_GE(compared, 10u);
  EXPECT_EQ(std::distance(fs::directory_iterator(pieces / "snapshots"), fs::directory_iterator{}),
            std::distance(fs::directory_iterator(whole / "snapshots"), fs::directory_iterator{}));

  EXPECT_EQ(run({"run", case_with({}), "--out", pieces, "--restart", saved}), 1);
  EXPECT_NE(err().find("saved by another model, whose mesh is not as in this one"), std::string::npos)
      << err();
  EXPECT_TRUE(fs::exists(pieces / "history.csv")) << "a run that cannot go on leaves what there is";
}

TEST_F(Command, EndsCleanlyWhenInterrupted) {
  const fs::path results = folder_ / "results";
  const fs::path path = case_with({{"end = 80e-6", "end = 1.0"},
                                   {"snapshot_times = [", "snapshot_times = [0, "},
                                   {"columns = 25", "columns = 5"}});
  const pid_t child = start({"run", path, "--out", results, "--threads", "1"});
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!fs::exists(results / "results.pvd") && std::chrono::steady_clock::now() < give_up) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  kill(child, SIGINT);
  EXPECT_EQ(wait_for(child), 130) << err();
  EXPECT_NE(out().find("wall time"), std::string::npos) << out();
  EXPECT_NE(contents(results / "summary.json").find("\"steps\""), std::string::npos);
  EXPECT_NE(contents(results / "history.csv").find("time_s"), std::string::npos);
}

}  // namespace
