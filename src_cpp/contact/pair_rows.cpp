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
  return ranges_.capacity() * sizeof(Range) + (partners_.capacity() + head_.capacity()) * sizeof(Index) +
         added_.memory();
}

void PairRows::archive(Archive& a) {
  a("pairs.ranges", ranges_);
  a("pairs.partners", partners_);
  a("pairs.head", head_);
  added_.archive(a, "pairs.added");
}

void PairRows::Found::start(Index first, Index partners, std::size_t places) {
  first_ = first, partners_ = partners;
  count_ = 0;
  ends_.clear();
  ends_.reserve(partners);
  counts_.assign(places + kSpare, 0);
}

void PairRows::Found::took(std::size_t count, std::span<const Index> ends) {
  for (const Index end : ends) ends_.push_back(static_cast<Index>(count_) + end);
  count_ += count;
}

/// As much as all partners will take if the rest are like those so far.
void PairRows::Found::make_room() {
  const double share = ends_.empty() ? 1 : static_cast<double>(ends_.size()) / partners_;
  const auto expected = static_cast<std::size_t>(1.05 * static_cast<double>(count_) / std::max(share, 0.01));
  found_.resize(std::max(expected, found_.size() + found_.size() / 2 + 4096) + kAhead);
}

void PairRows::Found::scatter(std::span<Index> partners) {
  if (count_ == 0) return;
  constexpr std::size_t kNear = 1 << 19;  // partners that the cache next to the processor may hold
  const Places* found = found_.data();
  const Places* const first = found;
  std::uint32_t* const next = counts_.data();
  Index* const to = partners.data();
  const auto write = [&](const auto& ask) {
    Index partner = first_;
    for (const Index end : ends_) {
      for (; found < first + end; ++found) {
        ask(found[kAhead]);
        for (std::uint32_t bits = found->bits; bits != 0; bits &= bits - 1) {
          to[next[found->at + __builtin_ctz(bits)]++] = partner;
        }
      }
      ++partner;
    }
  };
  if (partners.size() <= kNear) return write([](const Places&) {});
  std::fill_n(found_.data() + count_, kAhead, Places{});
  write([&](const Places& places) {
    for (std::uint32_t bits = places.bits; bits != 0; bits &= bits - 1) {
      __builtin_prefetch(&to[next[places.at + __builtin_ctz(bits)]], 1);
    }
  });
}

void PairRows::assign(std::span<const Index> rows, std::span<Found> shares) {
  ranges_.resize(rows.size());
  std::size_t count = 0;
  for (std::size_t place = 0; place < rows.size(); ++place) {
    const std::size_t begin = count;
    for (Found& share : shares) {
      count += std::exchange(share.counts_[place], static_cast<std::uint32_t>(count));
    }
    ranges_[rows[place]] = {static_cast<Index>(begin), static_cast<Index>(count)};
  }
  if (count > std::numeric_limits<Index>::max()) {
    ranges_.assign(rows.size(), {});
    partners_.clear();
    throw Error(Status::bad_argument,
                "contact search: " + std::to_string(count) +
                    " pairs are more than 32 bits count; make the buffer factor smaller");
  }
  partners_.resize(count);
  Threads(static_cast<int>(shares.size())).for_each(std::ssize(shares), [&](std::int64_t t) {
    shares[t].scatter(partners_);
  });
  head_.assign(rows.size(), kNone);
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
