/// The inner loops of the regular search, one set for each instruction set that the processor may have.
#pragma once

#include <cstddef>
#include <cstdint>

#include "cdfp/types.hpp"
#include "contact/cell_layout.hpp"
#include "contact/cells_view.hpp"

namespace cdfp {

/// Points in cells, and the segments that look for them. Arrays of points may be read a few past their end.
struct NodePairs {
  CellLayout layout;
  const std::uint32_t* first;   ///< points of slice s: [first[s], first[s + 1])
  const std::uint16_t* places;  ///< steps along x, then y, then z
  std::size_t stride;           ///< from x to y to z
  std::size_t points;
  const Index* nodes;      ///< of the points
  const Index* corners;    ///< (segments, 4)
  const double* position;  ///< (all nodes, 3)
  const Index* groups;     ///< of all nodes, or null
  const RoughBox* boxes;   ///< of segments
  float grow;              ///< by at least the buffer
  double buffer;
};

/// What decides, in double precision, whether a node and a segment pair.
struct ExactPairs {
  const Index* nodes;      ///< of the rows
  const Index* corners;    ///< (segments, 4)
  const double* position;  ///< (all nodes, 3)
  double buffer;
};

/// Points on their way into a table of cells.
struct PointSort {
  const CellLayout& layout;
  const Float4* points;
  const Index* nodes;  ///< of the points
  std::size_t count;
  std::uint32_t* slot;    ///< of the points
  std::uint32_t* first;   ///< zeros; then as in `CellsView`
  Index* ids;             ///< which points they are, in the order of the table
  Index* names;           ///< their nodes
  std::uint16_t* places;  ///< along x, then y, then z
  std::size_t stride;     ///< from one of them to the next
};

struct SearchKernels {
  /// Places of nodes [begin, end) about `origin`, and the box that holds them; at least one.
  RoughBox (*place_nodes)(const Index* nodes, const double* position, const double* origin,
                          std::int64_t begin, std::int64_t end, Float4* places);
  /// Boxes of segments [begin, end) about `origin`, and the sum of their mean lengths, sqrt(area).
  double (*place_segments)(const Index* corners, const double* position, const double* origin,
                           std::int64_t begin, std::int64_t end, RoughBox* boxes);
  /// Orders points by slice, then as given.
  void (*sort_points)(const PointSort& job);
  /// Segments from `begin` until `end` or until there is no more room, which is what it returns. `ends[i]`:
  /// where the places of the i-th of them end. `counts`: of segments that each point pairs with; a few past
  /// the last are written.
  std::int64_t (*pair_nodes)(const NodePairs& job, std::int64_t begin, std::int64_t end, FoundPlaces& found,
                             Index* ends, std::uint32_t* counts);
  /// Adds the boxes that overlap `box`, and few others, each once. Their lowest corners lie above `low`.
  void (*find_boxes)(const CellsView<true>& cells, const Float4& low, const RoughBox& box, FoundIds& found);
  /// Adds the segments whose grown boxes, as they are in the table or now, hold the node that is at `place`.
  void (*find_segments)(const CellsView<true>& cells, const Float4& low, const Float4& place,
                        const ExactPairs& exact, Index node, FoundIds& found);
  /// Adds the rows of the nodes that are, or were when the table took them, in a box; `low` and `high`: the
  /// same box in double precision.
  void (*find_rows)(const CellsView<false>& cells, const RoughBox& box, const ExactPairs& exact,
                    const double* low, const double* high, FoundIds& found);
};

extern const SearchKernels kSearchBaseline;
#ifdef CDFP_HAS_X86_VARIANTS
extern const SearchKernels kSearchAvx2;
extern const SearchKernels kSearchAvx512;
#endif

/// Those of `choose_instruction_set`.
const SearchKernels& choose_search_kernels();

}  // namespace cdfp
