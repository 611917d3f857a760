/// What TopS stores: one record an element (its nodes, then its mates) and one anchoring use a node.
///
/// Records lie in one pool a type; a hexahedron's fills one cache line. A mesh of a single type needs no
/// further word an element, a mixed one has a table of places.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "cdfp/topology.hpp"
#include "topology/templates.hpp"

namespace cdfp {

/// An element and one of its facets, or corners, in one non-negative word; `kNone` for none.
using Packed = Index;
inline constexpr Index kMaxElements = (Index{1} << 28) - 2;
constexpr Packed pack(Index element, Index local) {
  return element * 8 + local;
}
constexpr Index element_of(Packed word) {
  return word >> 3;
}
constexpr Index local_of(Packed word) {
  return word & 7;
}

template <class T>
struct CacheLineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};
  CacheLineAllocator() = default;
  template <class U>
  CacheLineAllocator(const CacheLineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kLine)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, kLine); }
  friend bool operator==(const CacheLineAllocator&, const CacheLineAllocator&) { return true; }
};
using Pool = std::vector<Index, CacheLineAllocator<Index>>;

struct ElementView {
  const Index* nodes;
  const Packed* mates;
  const ElementTemplate* shape;

  /// The corner of local facet `facet` that names `node`.
  Index corner(Index facet, Index node) const {
    for (const auto c : shape->facet(facet)) {
      if (nodes[c] == node) return c;
    }
    return kNone;
  }
};

struct TopologyStore {
  static constexpr std::size_t kBulkTypes = 4;
  static constexpr std::size_t kCohesiveWords = 10;  ///< 8 nodes (a triangle leaves two unused), 2 mates
  static constexpr int kTypeShift = 29;
  static constexpr Packed kFirstHinge = -2;

  TopologyStore(Index node_count, std::span<const ElementType> types, std::span<const Index> connectivity);

  /// Words of a record: nodes and mates, to full quarters of a cache line.
  static constexpr std::array<std::size_t, kBulkTypes> kStride = [] {
    std::array<std::size_t, kBulkTypes> stride{};
    for (std::size_t t = 0; t < kBulkTypes; ++t) {
      stride[t] =
          static_cast<std::size_t>(kTemplates[t].corner_count + kTemplates[t].facet_count + 3) / 4 * 4;
    }
    return stride;
  }();

  Index element_count() const { return bulk_count + static_cast<Index>(cohesive.size() / kCohesiveWords); }

  ElementType type(Index e) const {
    if (e >= bulk_count) {
      const Index* record = &cohesive[static_cast<std::size_t>(e - bulk_count) * kCohesiveWords];
      return record[6] == kNone ? ElementType::cohesive_triangle : ElementType::cohesive_quadrilateral;
    }
    return places.empty() ? only_type : static_cast<ElementType>(places[e] >> kTypeShift);
  }

  ElementView view(Index e) const {
    if (e < bulk_count) {
      std::size_t t = static_cast<std::size_t>(only_type);
      std::size_t slot = static_cast<std::size_t>(e);
      if (!places.empty()) {
        t = places[slot] >> kTypeShift;
        slot = places[slot] & ((1u << kTypeShift) - 1);
      }
      const Index* record = pools[t].data() + slot * kStride[t];
      return {record, record + kTemplates[t].corner_count, &kTemplates[t]};
    }
    const Index* record = &cohesive[static_cast<std::size_t>(e - bulk_count) * kCohesiveWords];
    return {record, record + 8, &element_template(type(e))};
  }

  Index* mutable_nodes(Index e) { return const_cast<Index*>(view(e).nodes); }
  Packed* mutable_mates(Index e) { return const_cast<Packed*>(view(e).mates); }

  bool is_cohesive(Index e) const { return e >= bulk_count; }

  /// The lowest use of each part that meets the node; parts of the initial mesh that share a node but no
  /// facet at it are several. These uses keep the node's number for good.
  std::span<const Packed> anchors_of(Index node) const {
    const Packed& word = anchors[node];
    if (word >= 0) return {&word, 1};
    if (word == kNone) return {};
    const Packed* group = &hinges[kFirstHinge - word];
    return {group + 1, static_cast<std::size_t>(*group)};
  }

  /// Bytes on the heap.
  std::size_t memory() const {
    std::size_t words = places.capacity() + cohesive.capacity() + anchors.capacity() + hinges.capacity();
    for (const Pool& pool : pools) words += pool.capacity();
    return words * sizeof(Index);
  }

  Index bulk_count = 0;
  ElementType only_type = ElementType::hexahedron;
  std::vector<std::uint32_t> places;  ///< type and slot in its pool; empty if all elements are of one type
  std::array<Pool, kBulkTypes> pools;
  std::vector<Index> cohesive;
  std::vector<Packed> anchors;  ///< one a node; kNone without elements, kFirstHinge - i for group i of hinges
  std::vector<Packed> hinges;   ///< groups of a count and as many anchors

 private:
  void copy_elements(std::span<const ElementType> types, std::span<const Index> connectivity);
  void match_facets();
  void anchor_nodes();
};

/// The first relation that does not hold, or an empty string.
std::string check(const TopologyStore& store);

}  // namespace cdfp
