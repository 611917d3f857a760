#include <algorithm>
#include <limits>
#include <utility>

#include "cdfp/contact.hpp"
#include "cdfp/error.hpp"
#include "core/archive.hpp"
#include "core/parallel.hpp"

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
  return (start_.capacity() + partners_.capacity() + head_.capacity()) * sizeof(Index) + added_.memory();
}

void PairRows::archive(Archive& a) {
  a("pairs.start", start_);
  a("pairs.partners", partners_);
  a("pairs.head", head_);
  added_.archive(a, "pairs.added");
}

void PairRows::Found::start(Index first, Index partners, Index rows) {
  first_ = first, partners_ = partners;
  count_ = 0;
  ends_.clear();
  ends_.reserve(partners);
  row_counts_.assign(rows, 0);
}

void PairRows::Found::took(std::size_t count, std::span<const Index> ends) {
  for (const Index end : ends) ends_.push_back(static_cast<Index>(count_) + end);
  for (const std::size_t end = count_ + count; count_ < end; ++count_) ++row_counts_[rows_[count_]];
}

/// As much as all partners will take if the rest are like those so far.
void PairRows::Found::make_room() {
  const double share = ends_.empty() ? 1 : static_cast<double>(ends_.size()) / partners_;
  const auto expected = static_cast<std::size_t>(1.05 * static_cast<double>(count_) / std::max(share, 0.01));
  rows_.resize(std::max(expected, rows_.size() + rows_.size() / 2 + 4096));
}

void PairRows::assign(Index rows, std::span<Found> shares) {
  std::size_t count = 0;
  for (const Found& share : shares) count += share.count_;
  if (count > std::numeric_limits<Index>::max()) {
    throw Error(Status::bad_argument,
                "contact search: " + std::to_string(count) +
                    " pairs are more than 32 bits count; make the buffer factor smaller");
  }
  start_.resize(static_cast<std::size_t>(rows) + 1);
  Index at = 0;
  for (Index r = 0; r < rows; ++r) {
    start_[r] = at;
    for (Found& share : shares) at += std::exchange(share.row_counts_[r], at);
  }
  start_[rows] = at;
  partners_.resize(count);
  Threads(static_cast<int>(shares.size())).for_each(std::ssize(shares), [&](std::int64_t t) {
    Found& share = shares[t];
    if (share.count_ == 0) return;
    Index* const row = share.rows_.data();
    std::fill_n(row + share.count_, Found::kAhead, row[0]);
    Index* const next = share.row_counts_.data();
    Index* const to = partners_.data();
    Index partner = share.first_, i = 0;
    for (const Index end : share.ends_) {
      for (; i < end; ++i) {
        __builtin_prefetch(&to[next[row[i + Found::kAhead]]], 1);
        to[next[row[i]]++] = partner;
      }
      ++partner;
    }
  });
  head_.assign(rows, kNone);
  added_.clear();
}

void PairRows::add(Index row, std::span<const Index> partners) {
  auto at = static_cast<Index>(added_.size());
  added_.resize(added_.size() + partners.size());
  Index next = head_[row];
  for (const Index partner : partners) {
    added_[at] = {partner, next};
    next = at++;
  }
  head_[row] = next;
}

void PairRows::add(std::span<const Index> rows, Index partner) {
  auto at = static_cast<Index>(added_.size());
  added_.resize(added_.size() + rows.size());
  for (const Index row : rows) {
    added_[at] = {partner, head_[row]};
    head_[row] = at++;
  }
}

}  // namespace cdfp
