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
  return (start_.capacity() + partners_.capacity() + head_.capacity() + next_.capacity() +
          added_.capacity()) *
         sizeof(Index);
}

void PairRows::assign(Index rows, std::span<const std::array<Index, 2>> row_and_partner) {
  start_.assign(static_cast<std::size_t>(rows) + 1, 0);
  for (const auto& pair : row_and_partner) ++start_[pair[0] + 1];
  for (Index r = 0; r < rows; ++r) start_[r + 1] += start_[r];
  partners_.resize(row_and_partner.size());
  for (const auto& pair : row_and_partner) partners_[start_[pair[0]]++] = pair[1];
  for (Index r = rows; r > 0; --r) start_[r] = start_[r - 1];
  start_[0] = 0;
  head_.assign(rows, kNone);
  next_.clear();
  added_.clear();
}

}  // namespace cdfp
