#include <algorithm>

#include "cdfp/contact.hpp"

namespace cdfp {

bool PairRows::contains(Index row, Index partner) const {
  bool found = false;
  for_each(row, [&](Index p) { found |= p == partner; });
  return found;
}

void PairRows::compress(std::vector<Index>& start, std::vector<Index>& partners) const {
  start.assign(1, 0);
  partners.clear();
  for (Index row = 0; row < rows(); ++row) {
    for_each(row, [&](Index p) { partners.push_back(p); });
    std::sort(partners.begin() + start.back(), partners.end());
    start.push_back(static_cast<Index>(partners.size()));
  }
}

std::size_t PairRows::memory() const {
  return (start_.capacity() + partners_.capacity() + head_.capacity()) * sizeof(Index) +
         added_.capacity() * sizeof(Added);
}

void PairRows::assign(Index rows, std::span<const Found> pieces) {
  // start_[r + 1] is where row r goes on while it fills, and where it ends when it is full.
  start_.assign(static_cast<std::size_t>(rows) + 2, 0);
  Index* const start = start_.data();
  std::size_t count = 0;
  for (const Found& piece : pieces) {
    for (std::size_t i = 0; i < piece.count; ++i) ++start[piece.rows[i] + 2];
    count += piece.count;
  }
  for (Index r = 0; r < rows; ++r) start[r + 2] += start[r + 1];
  partners_.resize(count);
  Index* const partners = partners_.data();
  Index partner = 0;
  for (const Found& piece : pieces) {
    std::size_t i = 0;
    for (const std::size_t end : piece.end) {
      for (; i < end; ++i) partners[start[piece.rows[i] + 1]++] = partner;
      ++partner;
    }
  }
  start_.pop_back();
  head_.assign(rows, kNone);
  added_.clear();
}

}  // namespace cdfp
