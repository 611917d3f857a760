#include "driver/toml_table.hpp"

#include <algorithm>
#include <cstdio>

#include "cdfp/error.hpp"
#include "driver/nearest_word.hpp"

namespace cdfp {

namespace {

std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

bool inside(double value, const Range& r) {
  return (r.least_excluded ? value > r.least : value >= r.least) &&
         (r.most_excluded ? value < r.most : value <= r.most);
}

std::string range_text(const Range& r) {
  const bool above = std::isfinite(r.least);
  const bool below = std::isfinite(r.most);
  if (above && !below && r.least == 0) return r.least_excluded ? "positive" : "0 or more";
  std::string text;
  if (above) text += (r.least_excluded ? "above " : "at least ") + digits(r.least);
  if (above && below) text += " and ";
  if (below) text += (r.most_excluded ? "below " : "at most ") + digits(r.most);
  return text;
}

std::string list_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "'" : ", '") + word + "'";
  return text;
}

std::string type_text(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

std::string key_text(std::string_view key) {
  return "'" + std::string(key) + "'";
}

}  // namespace

std::string TomlTable::where() const {
  return path_.empty() ? "at the top of the file" : "in [" + path_ + "]";
}

void TomlTable::refuse_at(toml::source_position place, const std::string& message) const {
  throw Error(Status::bad_input, *file_ + ":" + std::to_string(place.line) + ":" +
                                     std::to_string(place.column) + ": " + message);
}

void TomlTable::refuse(std::string_view key, const std::string& message) const {
  const toml::node* node = table_->get(key);
  refuse_at(node ? node->source().begin : table_->source().begin, message);
}

void TomlTable::refuse_table(const std::string& message) const {
  refuse_at(table_->source().begin, message);
}

void TomlTable::refuse_type(const toml::node& node, std::string_view key, const std::string& wanted) const {
  refuse_at(node.source().begin,
            key_text(key) + " " + where() + " must be " + wanted + ", not " + type_text(node));
}

void TomlTable::refuse_word(std::string_view key, const std::string& word,
                            const std::vector<std::string>& words) const {
  const std::string near = nearest_word(word, words);
  refuse(key, key_text(key) + " is '" + word + "'; " + (near.empty() ? "" : "did you mean '" + near + "'? ") +
                  "It may be " + list_text(words));
}

void TomlTable::refuse_unknown(const toml::key& key) const {
  const std::vector<std::string> known(known_.begin(), known_.end());
  const std::string near = nearest_word(key.str(), known);
  refuse_at(key.source().begin,
            "unknown key " + key_text(key.str()) + " " + where() + "; " +
                (near.empty() ? "the keys are " + list_text(known) : "did you mean '" + near + "'?"));
}

const toml::node* TomlTable::find(std::string_view key) {
  known_.emplace(key);
  return table_->get(key);
}

const toml::array* TomlTable::find_array(std::string_view key, const char* wanted) {
  const toml::node* node = find(key);
  if (node && !node->is_array()) refuse_type(*node, key, wanted);
  return node ? node->as_array() : nullptr;
}

void TomlTable::require(std::string_view key) {
  if (find(key)) return;
  for (const auto& [other, value] : *table_) {
    if (!known_.contains(other.str()) && !nearest_word(other.str(), {std::string(key)}).empty()) {
      refuse_unknown(other);
    }
  }
  refuse_table("the key " + key_text(key) + " is missing " + where());
}

void TomlTable::finish() const {
  const toml::key* first = nullptr;
  for (const auto& [key, value] : *table_) {
    if (known_.contains(key.str())) continue;
    const auto before = [](toml::source_position a, toml::source_position b) {
      return a.line != b.line ? a.line < b.line : a.column < b.column;
    };
    if (!first || before(key.source().begin, first->source().begin)) first = &key;
  }
  if (first) refuse_unknown(*first);
}

double TomlTable::number(const toml::node& node, std::string_view key, const Range& range) const {
  const std::optional<double> value = node.value<double>();
  if (!node.is_number() || !value) refuse_type(node, key, "a number");
  if (!std::isfinite(*value)) refuse_at(node.source().begin, key_text(key) + " is not a finite number");
  if (!inside(*value, range)) {
    refuse_at(node.source().begin,
              key_text(key) + " is " + digits(*value) + "; it must be " + range_text(range));
  }
  return *value;
}

void TomlTable::read(std::string_view key, double& value, const Range& range) {
  if (const toml::node* node = find(key)) value = number(*node, key, range);
}

void TomlTable::read(std::string_view key, std::int64_t& value, const Range& range) {
  const toml::node* node = find(key);
  if (!node) return;
  if (!node->is_integer()) refuse_type(*node, key, "an integer");
  number(*node, key, range);
  value = **node->as_integer();
}

void TomlTable::read(std::string_view key, Index& value, const Range& range) {
  using Limits = std::numeric_limits<Index>;
  Range fits = range;
  fits.least = std::max<double>(fits.least, Limits::min());
  fits.most = std::min<double>(fits.most, Limits::max());
  std::int64_t wide = value;
  read(key, wide, fits);
  value = static_cast<Index>(wide);
}

void TomlTable::read(std::string_view key, bool& value) {
  const toml::node* node = find(key);
  if (!node) return;
  if (!node->is_boolean()) refuse_type(*node, key, "true or false");
  value = **node->as_boolean();
}

void TomlTable::read(std::string_view key, std::string& value) {
  const toml::node* node = find(key);
  if (!node) return;
  if (!node->is_string()) refuse_type(*node, key, "a string");
  value = **node->as_string();
}

template <std::size_t n>
void TomlTable::read_numbers(std::string_view key, std::array<double, n>& value, const char* wanted) {
  const toml::array* array = find_array(key, wanted);
  if (!array) return;
  if (array->size() != n) {
    refuse(key, key_text(key) + " has " + std::to_string(array->size()) + " values; it must be " + wanted);
  }
  for (std::size_t i = 0; i < n; ++i) value[i] = number((*array)[i], key, kAnyNumber);
}

void TomlTable::read(std::string_view key, std::array<double, 3>& value) {
  read_numbers(key, value, "an array of 3 numbers");
}

void TomlTable::read(std::string_view key, std::optional<std::array<double, 9>>& value) {
  std::array<double, 9> numbers{};
  read_numbers(key, numbers, "an array of 9 numbers");
  if (has(key)) value = numbers;
}

void TomlTable::read(std::string_view key, std::array<bool, 3>& value) {
  constexpr const char* wanted = "an array of 'x', 'y' and 'z', those that are meant";
  std::vector<std::string> axes;
  const toml::array* array = find_array(key, wanted);
  if (!array) return;
  value = {};
  for (const toml::node& node : *array) {
    const auto* word = node.as_string();
    const bool is_axis = word && (**word == "x" || **word == "y" || **word == "z");
    if (!is_axis) refuse_at(node.source().begin, key_text(key) + " must be " + wanted);
    value[static_cast<std::size_t>((**word)[0] - 'x')] = true;
  }
}

void TomlTable::read(std::string_view key, std::vector<double>& value, const Range& range) {
  const toml::array* array = find_array(key, "an array of numbers");
  if (!array) return;
  value.clear();
  for (const toml::node& node : *array) value.push_back(number(node, key, range));
}

void TomlTable::read(std::string_view key, std::vector<std::string>& value) {
  const toml::array* array = find_array(key, "an array of strings");
  if (!array) return;
  value.clear();
  for (const toml::node& node : *array) {
    if (!node.is_string()) refuse_type(node, key, "an array of strings");
    value.push_back(**node.as_string());
  }
}

void TomlTable::check_name(std::string_view key, const std::string& word,
                           const std::vector<std::string>& names, const std::string& kind) {
  if (std::find(names.begin(), names.end(), word) != names.end()) return;
  const std::string near = nearest_word(word, names);
  refuse(key, "there is no " + kind + " '" + word + "'; " +
                  (names.empty()  ? "none is defined"
                   : near.empty() ? "there are " + list_text(names)
                                  : "did you mean '" + near + "'?"));
}

std::optional<TomlTable> TomlTable::table(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_table()) refuse_type(*node, key, "a table");
  return TomlTable(*node->as_table(), (path_.empty() ? "" : path_ + ".") + std::string(key), *file_);
}

std::vector<std::pair<std::string, TomlTable>> TomlTable::named_tables(std::string_view key) {
  std::vector<std::pair<std::string, TomlTable>> tables;
  std::optional<TomlTable> parent = table(key);
  if (!parent) return tables;
  for (const auto& [name, node] : *parent->table_)
    tables.emplace_back(name.str(), *parent->table(name.str()));
  std::sort(tables.begin(), tables.end(), [](const auto& a, const auto& b) {
    const toml::source_position p = a.second.table_->source().begin;
    const toml::source_position q = b.second.table_->source().begin;
    return p.line != q.line ? p.line < q.line : p.column < q.column;
  });
  return tables;
}

std::vector<TomlTable> TomlTable::table_array(std::string_view key) {
  std::vector<TomlTable> tables;
  const toml::array* array = find_array(key, "an array of tables");
  if (!array) return tables;
  const std::string path = (path_.empty() ? "" : path_ + ".") + std::string(key);
  for (const toml::node& node : *array) {
    if (!node.is_table()) refuse_type(node, key, "an array of tables");
    tables.emplace_back(*node.as_table(), path, *file_);
  }
  return tables;
}

}  // namespace cdfp
