/// A number that tells contents apart: of files that may be damaged, of models that may differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <vector>

namespace cdfp {

class Digest {
 public:
  void bytes(const void* data, std::size_t count) {
    const char* at = static_cast<const char*>(data);
    for (std::size_t left = count; left > 0;) {
      const std::size_t taken = left < sizeof(std::uint64_t) ? left : sizeof(std::uint64_t);
      std::uint64_t word = 0;
      std::memcpy(&word, at, taken);
      mix(word);
      at += taken, left -= taken;
    }
    mix(count);
  }
  void add(std::string_view text) { bytes(text.data(), text.size()); }
  template <class T>
  void add(const std::vector<T>& values) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    bytes(values.data(), values.size() * sizeof(T));
  }
  template <class T, std::enable_if_t<std::is_arithmetic_v<T> || std::is_enum_v<T>, int> = 0>
  void add(T value) {
    bytes(&value, sizeof value);
  }

  std::uint64_t value() const { return value_; }

 private:
  // Steps that can be undone one by one lose nothing of what went in before.
  void mix(std::uint64_t word) {
    value_ = (value_ ^ word) * 0x9E3779B97F4A7C15u;
    value_ ^= value_ >> 32;
  }

  std::uint64_t value_ = 0x2545F4914F6CDD1Du;
};

}  // namespace cdfp
