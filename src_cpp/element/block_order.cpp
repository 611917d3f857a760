#include "element/block_order.hpp"

#include <algorithm>
#include <numeric>

namespace cdfp {

namespace {

int longest_side(std::span<const Centroid> elements) {
  std::array<double, 3> low = elements[0].x, high = low;
  for (const Centroid& c : elements) {
    for (int d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], c.x[d]);
      high[d] = std::max(high[d], c.x[d]);
    }
  }
  int longest = 0;
  for (int d = 1; d < 3; ++d) {
    if (high[d] - low[d] > high[longest] - low[longest]) longest = d;
  }
  return longest;
}

}  // namespace

void order_in_runs(std::span<Centroid> elements, std::size_t size) {
  if (elements.size() <= size) {
    std::sort(elements.begin(), elements.end(),
              [](const Centroid& a, const Centroid& b) { return a.element < b.element; });
    return;
  }
  const std::size_t runs = (elements.size() + size - 1) / size;
  const std::size_t half = runs / 2 * size;
  const int d = longest_side(elements);
  std::nth_element(elements.begin(), elements.begin() + static_cast<std::ptrdiff_t>(half), elements.end(),
                   [d](const Centroid& a, const Centroid& b) {
                     return a.x[d] != b.x[d] ? a.x[d] < b.x[d] : a.element < b.element;
                   });
  order_in_runs(elements.first(half), size);
  order_in_runs(elements.subspan(half), size);
}

std::vector<std::vector<std::int32_t>> colour(std::span<const std::size_t> first,
                                              std::span<const Index> nodes, Index node_count) {
  constexpr int kMost = 64;  // colours a round, one bit each
  std::vector<std::vector<std::int32_t>> colours;
  std::vector<std::int32_t> waiting(first.size() - 1);
  std::iota(waiting.begin(), waiting.end(), 0);
  while (!waiting.empty()) {
    std::vector<std::uint64_t> taken(static_cast<std::size_t>(node_count), 0);
    std::vector<std::vector<std::int32_t>> round;
    std::vector<std::int32_t> left;
    for (const std::int32_t item : waiting) {
      const std::span<const Index> own = nodes.subspan(first[item], first[item + 1] - first[item]);
      std::uint64_t used = 0;
      for (const Index n : own) used |= taken[n];
      if (used == ~std::uint64_t{0}) {
        left.push_back(item);
        continue;
      }
      // The emptiest colour in use that is free here, or else a new one.
      int choice = kMost;
      for (int c = 0; c < static_cast<int>(round.size()); ++c) {
        if (used >> c & 1) continue;
        if (choice == kMost || round[c].size() < round[choice].size()) choice = c;
      }
      if (choice == kMost) {
        choice = static_cast<int>(round.size());
        round.emplace_back();
      }
      round[choice].push_back(item);
      for (const Index n : own) taken[n] |= std::uint64_t{1} << choice;
    }
    colours.insert(colours.end(), round.begin(), round.end());
    waiting = std::move(left);
  }
  return colours;
}

}  // namespace cdfp
