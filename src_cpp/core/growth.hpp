/// Lists that cracks lengthen: they add little to a large mesh, so these take an eighth more at a time, not
/// twice the memory.
#pragma once

#include <cstddef>
#include <vector>

namespace cdfp {

template <class List>
void make_room(List& list, std::size_t size) {
  if (size > list.capacity()) list.reserve(size + size / 8 + 4);
}

template <class T, class Allocator>
void append(std::vector<T, Allocator>& list, T item) {  // by value: it may be one of the list
  make_room(list, list.size() + 1);
  list.push_back(item);
}

template <class T, class Allocator>
void lengthen(std::vector<T, Allocator>& list, std::size_t size, T item = T()) {
  make_room(list, size);
  list.resize(size, item);
}

}  // namespace cdfp
