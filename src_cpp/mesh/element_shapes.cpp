#include "mesh/element_shapes.hpp"

namespace cdfp {

namespace {

constexpr FacetCorners kHexahedronFacets[] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                              {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
constexpr CornerFrame kHexahedronFrames[] = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                             {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};

constexpr FacetCorners kTetrahedronFacets[] = {
    {0, 2, 1, kNone}, {0, 1, 3, kNone}, {1, 2, 3, kNone}, {2, 0, 3, kNone}};
constexpr CornerFrame kTetrahedronFrames[] = {{0, 1, 2, 3}};

constexpr FacetCorners kWedgeFacets[] = {
    {0, 2, 1, kNone}, {3, 4, 5, kNone}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
constexpr CornerFrame kWedgeFrames[] = {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5},
                                        {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}};

constexpr FacetCorners kPyramidFacets[] = {
    {0, 3, 2, 1}, {0, 1, 4, kNone}, {1, 2, 4, kNone}, {2, 3, 4, kNone}, {3, 0, 4, kNone}};
constexpr CornerFrame kPyramidFrames[] = {{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}};

constexpr ElementShape kShapes[] = {{"hexahedron", 8, kHexahedronFacets, kHexahedronFrames},
                                    {"tetrahedron", 4, kTetrahedronFacets, kTetrahedronFrames},
                                    {"wedge", 6, kWedgeFacets, kWedgeFrames},
                                    {"pyramid", 5, kPyramidFacets, kPyramidFrames}};

}  // namespace

const ElementShape* bulk_shape(ElementType type) {
  const auto i = static_cast<std::size_t>(type);
  return i < std::size(kShapes) ? &kShapes[i] : nullptr;
}

}  // namespace cdfp
