/// A table of a case file, read key by key. What is wrong is told with file, line and column; a key that
/// nobody asked for is wrong too.
#pragma once

#include <toml++/toml.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cdfp/types.hpp"

namespace cdfp {

/// Numbers that a key may take.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool least_excluded = false;
  bool most_excluded = false;
};
inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive{.least = 0, .least_excluded = true};
inline constexpr Range kNotNegative{.least = 0};

class TomlTable {
 public:
  /// `path` names the table in messages, such as "materials.glass"; empty at the top of the file.
  TomlTable(const toml::table& table, std::string path, const std::string& file)
      : table_(&table), path_(std::move(path)), file_(&file) {}

  bool has(std::string_view key) const { return table_->contains(key); }

  // Each leaves `value` as it is if the key is missing.
  void read(std::string_view key, double& value, const Range& range = kAnyNumber);
  void read(std::string_view key, std::int64_t& value, const Range& range = kAnyNumber);
  void read(std::string_view key, Index& value, const Range& range = kAnyNumber);
  void read(std::string_view key, bool& value);
  void read(std::string_view key, std::string& value);
  void read(std::string_view key, std::array<double, 3>& value);
  void read(std::string_view key, std::optional<std::array<double, 9>>& value);
  void read(std::string_view key, std::array<bool, 3>& value);
  void read(std::string_view key, std::vector<double>& value, const Range& range = kAnyNumber);
  void read(std::string_view key, std::vector<std::string>& value);

  template <class Value, class... Rest>
  void need(std::string_view key, Value& value, Rest&&... rest) {
    require(key);
    read(key, value, std::forward<Rest>(rest)...);
  }

  /// One of the given words.
  template <class Choice>
  void choose(std::string_view key, Choice& value, std::span<const std::pair<const char*, Choice>> choices) {
    if (!has(key)) {
      known_.emplace(key);
      return;
    }
    std::string word;
    read(key, word);
    std::vector<std::string> words;
    for (const auto& [name, choice] : choices) {
      if (word == name) {
        value = choice;
        return;
      }
      words.emplace_back(name);
    }
    refuse_word(key, word, words);
  }

  /// The word under `key` must be one of `names`, which are of the given kind.
  void check_name(std::string_view key, const std::string& word, const std::vector<std::string>& names,
                  const std::string& kind);

  std::optional<TomlTable> table(std::string_view key);
  /// The tables inside the table `key`, with their names, in the order of the file.
  std::vector<std::pair<std::string, TomlTable>> named_tables(std::string_view key);
  /// The tables of the array `key`.
  std::vector<TomlTable> table_array(std::string_view key);

  void require(std::string_view key);
  /// Call it when all keys have been read: any other is an error.
  void finish() const;

  /// Throws `Error(bad_input)` at the place of the key's value (of the table if there is none).
  [[noreturn]] void refuse(std::string_view key, const std::string& message) const;
  /// The same, at the table itself: its name is wrong.
  [[noreturn]] void refuse_table(const std::string& message) const;

 private:
  const toml::node* find(std::string_view key);
  const toml::array* find_array(std::string_view key, const char* wanted);
  template <std::size_t n>
  void read_numbers(std::string_view key, std::array<double, n>& value, const char* wanted);
  [[noreturn]] void refuse_type(const toml::node& node, std::string_view key,
                                const std::string& wanted) const;
  [[noreturn]] void refuse_word(std::string_view key, const std::string& word,
                                const std::vector<std::string>& words) const;
  [[noreturn]] void refuse_at(toml::source_position place, const std::string& message) const;
  [[noreturn]] void refuse_unknown(const toml::key& key) const;
  double number(const toml::node& node, std::string_view key, const Range& range) const;
  std::string where() const;

  const toml::table* table_;
  std::string path_;
  const std::string* file_;
  std::set<std::string, std::less<>> known_;
};

}  // namespace cdfp
