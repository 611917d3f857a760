#include <dlfcn.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cdfp/error.hpp"
#include "cdfp/material_library.hpp"

extern char** environ;  // NOLINT(readability-redundant-declaration): POSIX leaves it to the program

namespace cdfp {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

enum class Language { fixed_fortran, free_fortran, c, cpp };

std::string contents_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad()) {
    throw Error(Status::io,
                "cannot read the source '" + path.string() + "'; check that it exists and is no folder");
  }
  return text;
}

std::string lower(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word;
}

Language language_of(const std::string& source, const std::string& text) {
  const std::string ending = lower(fs::path(source).extension().string());
  if (ending == ".c") return Language::c;
  if (ending == ".cpp" || ending == ".cc" || ending == ".cxx") return Language::cpp;
  if (ending == ".f90" || ending == ".f95" || ending == ".f03" || ending == ".f08")
    return Language::free_fortran;
  if (ending != ".f" && ending != ".for" && ending != ".ftn") {
    throw Error(Status::bad_argument,
                "source '" + source +
                    "' has an ending that tells no language; it may be .f, "
                    ".for, .ftn (fixed form), .f90, .f95, .f03, .f08 (free form), .c, .cpp, .cc "
                    "or .cxx");
  }
  static const std::regex free_form("(^|\n)[!cC*]\\s*D(IR|EC)\\$\\s*FREEFORM", std::regex::icase);
  return std::regex_search(text, free_form) ? Language::free_fortran : Language::fixed_fortran;
}

/// Where cdfp's headers are: installed beside the library or command, else where they were built from.
fs::path include_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&include_folder), &info) != 0 && info.dli_fname) {
    std::error_code ignored;
    fs::path folder = fs::canonical(info.dli_fname, ignored).parent_path();
    for (int up = 0; up < 3 && !folder.empty(); ++up, folder = folder.parent_path()) {
      if (fs::exists(folder / "include" / "cdfp" / "material.h", ignored)) return folder / "include";
    }
  }
  return CDFP_SOURCE_INCLUDE;
}

std::string environment_or(const char* variable, const char* otherwise) {
  const char* value = std::getenv(variable);
  return value && *value ? value : otherwise;
}

/// The compiler, which may come with options, and its arguments.
Words command(const char* variable, const char* otherwise, const Words& arguments) {
  std::istringstream stream(environment_or(variable, otherwise));
  Words words{std::istream_iterator<std::string>(stream), {}};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

bool has_directives(const std::string& text) {
  static const std::regex directive("(^|\n)#");
  return std::regex_search(text, directive);
}

/// The command but for source, output and length of lines.
Words command_for(Language language, const std::string& text, const BuildOptions& options) {
  const std::string include = include_folder().string();
  const std::string folder =
      include + (options.single_precision ? "/cdfp/vumat/single" : "/cdfp/vumat/double");
  if (language == Language::c) return command("CC", "cc", {"-O2", "-fPIC", "-shared", "-I", include});
  if (language == Language::cpp) {
    return command("CXX", "c++", {"-std=c++20", "-O2", "-fPIC", "-shared", "-I", include});
  }
  Words words = command("FC", "gfortran",
                        {"-O2", "-fPIC", "-shared", "-w", "-std=legacy", "-fdec", "-fcray-pointer",
                         "-frecursive", "-fallow-argument-mismatch", "-fno-range-check",
                         language == Language::fixed_fortran ? "-ffixed-form" : "-ffree-form", "-I", folder});
  if (!options.single_precision) words.insert(words.end(), {"-fdefault-real-8", "-fdefault-double-8"});
  if (has_directives(text)) words.emplace_back("-cpp");
  for (const char* stop :
       {"stop_string", "stop_numeric", "error_stop_string", "error_stop_numeric", "exit_i4", "exit_i8"}) {
    words.push_back(std::string("-Wl,--wrap=_gfortran_") + stop);
  }
  return words;
}

struct Outcome {
  bool found = true;  ///< the compiler
  bool done = false;
  std::string said;
};

Outcome run(const Words& words, const fs::path& log) {
  std::vector<char*> raw;
  raw.reserve(words.size() + 1);
  for (const std::string& word : words) raw.push_back(const_cast<char*>(word.c_str()));
  raw.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t child = 0;
  const int failed = posix_spawnp(&child, raw[0], &actions, nullptr, raw.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return {false, false, {}};
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  Outcome outcome;
  outcome.found = !(WIFEXITED(status) && WEXITSTATUS(status) == 127);
  outcome.done = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  outcome.said = contents_of(log);
  return outcome;
}

/// The first lines, which hold the first error.
std::string first_lines(const std::string& text) {
  constexpr int kLines = 40;
  std::istringstream stream(text);
  std::string line, result;
  for (int n = 0; n < kLines && std::getline(stream, line); ++n) result += "\n  " + line;
  return stream.peek() == EOF ? result : result + "\n  ...";
}

bool has_long_lines(const std::string& text) {
  std::istringstream stream(text);
  std::string line;
  while (std::getline(stream, line)) {
    if (line.size() > 72) return true;
  }
  return false;
}

/// What the compiler would read besides: files that it includes, wherever they lie near the source.
void add_included(const fs::path& source, const std::string& text, std::set<fs::path>& seen,
                  std::string& all) {
  static const std::regex include("(^|\n)\\s*#?\\s*include\\s*['\"<]([^'\"<>\n]+)['\">]", std::regex::icase);
  for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end; ++match) {
    const fs::path path = source.parent_path() / (*match)[2].str();
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored) || !seen.insert(path).second) continue;
    const std::string inner = contents_of(path);
    all += inner;
    add_included(path, inner, seen, all);
  }
}

/// FNV-1a
std::string fingerprint(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const unsigned char c : text) hash = (hash ^ c) * 1099511628211ULL;
  char digits[20];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

bool can_write(const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  return !failed && access(folder.c_str(), W_OK) == 0;
}

fs::path cache_folder(const fs::path& source) {
  fs::path beside = source.parent_path() / ".cdfp";
  if (can_write(beside)) return beside;
  const std::string home = environment_or("HOME", "/tmp");
  fs::path own = fs::path(environment_or("XDG_CACHE_HOME", (home + "/.cache").c_str())) / "cdfp";
  if (can_write(own)) return own;
  throw Error(Status::io,
              "there is no place for the library of '" + source.string() + "': neither " + beside.string() +
                  " nor " + own.string() +
                  " can be written; compile it by cdfp build-material FILE -o LIBRARY and name that");
}

}  // namespace

void build_material(const std::string& source, const std::string& library, const BuildOptions& options) {
  const std::string text = contents_of(source);
  const Language language = language_of(source, text);
  Words words = command_for(language, text, options);
  const fs::path parent = fs::absolute(library).parent_path();
  std::error_code ignored;
  fs::create_directories(parent, ignored);
  if (access(parent.c_str(), W_OK) != 0) {
    throw Error(Status::io,
                "folder " + parent.string() + " cannot be written; give another place for the library");
  }
  const std::string unique = "." + std::to_string(getpid()) + ".tmp";
  const fs::path made = fs::absolute(library).string() + unique + ".so",
                 log = fs::absolute(library).string() + unique + ".log";
  words.insert(words.end(), {"-o", made.string(), fs::absolute(source).string()});

  std::vector<Words> attempts{words};
  if (language == Language::fixed_fortran) {
    attempts[0].insert(attempts[0].end() - 3, "-ffixed-line-length-none");
    // Old sources have numbers of cards behind column 72.
    if (has_long_lines(text)) attempts.push_back(words);
  } else if (language == Language::free_fortran) {
    attempts[0].insert(attempts[0].end() - 3, "-ffree-line-length-none");
  }
  std::string first;
  for (const Words& attempt : attempts) {
    const Outcome outcome = run(attempt, log);
    fs::remove(log, ignored);
    if (!outcome.found) {
      throw Error(Status::unavailable,
                  "there is no compiler '" + attempt[0] + "' to compile '" + source +
                      "'; install it (such as by apt-get install gfortran), or name yours in the environment "
                      "variable " +
                      (language == Language::c     ? "CC"
                       : language == Language::cpp ? "CXX"
                                                   : "FC"));
    }
    if (outcome.done) {
      fs::rename(made, library);
      return;
    }
    fs::remove(made, ignored);
    if (first.empty()) first = outcome.said;
  }
  std::string command;
  for (const std::string& word : attempts[0]) command += " " + word;
  throw Error(Status::bad_input,
              "'" + source + "' does not compile:" + first_lines(first) + "\n  (by" + command + ")");
}

std::string built_material(const std::string& source, const BuildOptions& options) {
  const fs::path path = fs::absolute(source);
  const std::string text = contents_of(source);
  std::string all = text;
  std::set<fs::path> seen;
  add_included(path, text, seen, all);
  for (const std::string& word : command_for(language_of(source, text), text, options)) all += '\0' + word;
  const fs::path library = cache_folder(path) / (path.stem().string() + "-" + fingerprint(all) + ".so");
  std::error_code ignored;
  if (!fs::exists(library, ignored)) build_material(source, library.string(), options);
  return library.string();
}

}  // namespace cdfp
