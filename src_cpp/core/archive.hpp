/// What a simulation carries from step to step, as named arrays in one stream of bytes. A class lists its
/// members in one function for both ways, so that what is saved and what is restored cannot drift apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "cdfp/error.hpp"

namespace cdfp {

class Archive {
 public:
  /// To be filled.
  Archive() = default;
  /// To be read in the order in which it was filled.
  explicit Archive(std::string bytes) : bytes_(std::move(bytes)), reads_(true) {}

  bool reads() const { return reads_; }
  const std::string& bytes() const { return bytes_; }

  /// A number, or a struct of numbers.
  template <class T>
  void operator()(std::string_view name, T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const std::uint64_t count = head(name, sizeof(T), 1);
    if (count != 1) differs(name);
    move(&value, 1);
  }
  template <class T>
  void operator()(std::string_view name, std::optional<T>& value) {
    bool given = value.has_value();
    (*this)(name, given);
    T content = value.value_or(T{});
    (*this)(name, content);
    value = given ? std::optional(content) : std::nullopt;
  }
  template <class T, class Allocator>
  void operator()(std::string_view name, std::vector<T, Allocator>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    values.resize(head(name, sizeof(T), values.size()));
    move(values.data(), values.size());
  }
  void operator()(std::string_view name, std::string& text) {
    text.resize(head(name, 1, text.size()));
    move(text.data(), text.size());
  }
  void operator()(std::string_view name, std::vector<std::string>& texts) {
    std::uint64_t count = texts.size();
    (*this)(name, count);
    texts.resize(count);
    for (std::string& text : texts) (*this)(name, text);
  }

  /// For sizes that the model decides: throws if what was saved is another.
  void require_same(std::string_view name, std::uint64_t size) {
    std::uint64_t saved = size;
    (*this)(name, saved);
    if (saved != size) differs(name);
  }

  [[noreturn]] static void differs(std::string_view name) {
    throw Error(Status::bad_input, "the saved state does not fit: '" + std::string(name) +
                                       "' differs; it was saved by another build of cdfp, so continue with "
                                       "that one or start anew");
  }

 private:
  std::uint64_t head(std::string_view name, std::uint64_t size, std::uint64_t count) {
    if (!reads_) {
      const std::uint64_t length = name.size();
      append(&length, sizeof length);
      append(name.data(), name.size());
      append(&size, sizeof size);
      append(&count, sizeof count);
      return count;
    }
    std::uint64_t length = 0;
    take(&length, sizeof length, name);
    if (length != name.size() || length > bytes_.size() - at_ || bytes_.compare(at_, length, name) != 0) {
      differs(name);
    }
    at_ += length;
    std::uint64_t saved_size = 0, saved_count = 0;
    take(&saved_size, sizeof saved_size, name);
    take(&saved_count, sizeof saved_count, name);
    if (saved_size != size || saved_count > (bytes_.size() - at_) / size) differs(name);
    return saved_count;
  }
  template <class T>
  void move(T* values, std::size_t count) {
    if (count == 0) return;
    const std::size_t size = count * sizeof(T);
    if (reads_) {
      std::memcpy(values, bytes_.data() + at_, size);
      at_ += size;
    } else if constexpr (std::is_class_v<T>) {
      for (std::size_t i = 0; i < count; ++i) {
        T value = values[i];
        clear_padding(value);
        append(&value, sizeof(T));
      }
    } else {
      append(values, size);
    }
  }
  /// What lies between the members may be anything: equal states are to be equal bytes.
  template <class T>
  static void clear_padding([[maybe_unused]] T& value) {
#if defined(__has_builtin)
#if __has_builtin(__builtin_clear_padding)
    __builtin_clear_padding(&value);
#endif
#endif
  }
  void append(const void* data, std::size_t count) {
    bytes_.append(static_cast<const char*>(data), count);
  }
  void take(void* data, std::size_t count, std::string_view name) {
    if (count > bytes_.size() - at_) differs(name);
    std::memcpy(data, bytes_.data() + at_, count);
    at_ += count;
  }

  std::string bytes_;
  std::size_t at_ = 0;
  bool reads_ = false;
};

}  // namespace cdfp
