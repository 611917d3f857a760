#include "mesh/element_shapes.hpp"

namespace cdfp {

namespace {

constexpr CornerFrame kHexahedronFrames[] = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                             {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};

constexpr CornerFrame kTetrahedronFrames[] = {{0, 1, 2, 3}};

constexpr CornerFrame kWedgeFrames[] = {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5},
                                        {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}};

constexpr CornerFrame kPyramidFrames[] = {{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}};

constexpr ElementShape kShapes[] = {{"hexahedron", kHexahedronFrames},
                                    {"tetrahedron", kTetrahedronFrames},
                                    {"wedge", kWedgeFrames},
                                    {"pyramid", kPyramidFrames}};

}  // namespace

const ElementShape* bulk_shape(ElementType type) {
  const auto i = static_cast<std::size_t>(type);
  return i < std::size(kShapes) ? &kShapes[i] : nullptr;
}

}  // namespace cdfp
