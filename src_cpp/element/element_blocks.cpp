#include "element/element_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "cdfp/error.hpp"
#include "core/numbered.hpp"
#include "element/block_order.hpp"
#include "element/full_integration.hpp"
#include "element/one_point.hpp"
#include "element/step_bound.hpp"
#include "element/tetrahedron.hpp"
#include "element/wedge.hpp"
#include "element/wedge_geometry.hpp"
#include "model/lookup.hpp"
#include "state/slabs.hpp"

namespace cdfp {

namespace {

// More blocks a task save traffic to the nodes that they share; fewer leave tasks for every thread. The
// choice must not depend on the number of threads, since it orders the sums.
constexpr std::size_t kMostBlocksATask = 32;
constexpr std::size_t kTasksWanted = 128;

BlockKind kind_of(const PartPlan& plan, ElementType type, bool prism) {
  if (plan.user) {
    if (type == ElementType::tetrahedron) return BlockKind::tetrahedron_stored;
    if (type == ElementType::wedge) return BlockKind::wedge_stored;
    if (plan.full) return prism ? BlockKind::full_prism_stored : BlockKind::full_stored;
    return prism ? BlockKind::prism_stored : BlockKind::hexahedron_stored;
  }
  if (type == ElementType::tetrahedron) {
    return plan.rate_dependent ? BlockKind::tetrahedron_rate_dependent : BlockKind::tetrahedron_elastic;
  }
  if (type == ElementType::wedge) {
    return plan.rate_dependent ? BlockKind::wedge_rate_dependent : BlockKind::wedge_elastic;
  }
  if (plan.full && prism) {
    return plan.rate_dependent ? BlockKind::full_prism_rate_dependent : BlockKind::full_prism_elastic;
  }
  if (plan.full) return plan.rate_dependent ? BlockKind::full_rate_dependent : BlockKind::full_elastic;
  if (prism) return plan.rate_dependent ? BlockKind::prism_rate_dependent : BlockKind::prism_elastic;
  return plan.rate_dependent ? BlockKind::hexahedron_rate_dependent : BlockKind::hexahedron_elastic;
}

/// g_i of one_point.hpp: H_ii = l_j l_k / (3 l_i).
Eigen::Vector3d hourglass_constants(const HexahedronGeometry& geometry, double factor) {
  const Eigen::Vector3d& l = geometry.lengths;
  return (factor * l.prod() / 3 * l.cwiseProduct(l).cwiseInverse()).cwiseSqrt();
}

/// `OfCorners`: Corners, TetrahedronCorners or WedgeCorners, from the element's first entry in the
/// connectivity.
template <class OfCorners>
OfCorners corners_of(const Mesh& mesh, Index first) {
  OfCorners x;
  for (Eigen::Index c = 0; c < x.rows(); ++c) {
    const Index node = mesh.connectivity[static_cast<std::size_t>(first + c)];
    x.row(c) = Eigen::Map<const Eigen::RowVector3d>(&mesh.coordinates[3 * static_cast<std::size_t>(node)]);
  }
  return x;
}

Eigen::RowVector3d centre_of(const Mesh& mesh, Index first, Index end) {
  Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
  for (Index c = first; c < end; ++c) {
    sum += Eigen::Map<const Eigen::RowVector3d>(
        &mesh.coordinates[3 * static_cast<std::size_t>(mesh.connectivity[c])]);
  }
  return sum / (end - first);
}

/// An element's constants in the order of its formulation: `write(component, value)`.
template <class Write>
void write_constants(BlockKind kind, const HexahedronGeometry& geometry, const Eigen::Vector3d& g,
                     Write&& write) {
  const auto gradient = [&] {
    for (int mode = 0; mode < 7; ++mode) {
      for (int axis = 0; axis < 3; ++axis) write(3 * mode + axis, geometry.b(mode, axis));
    }
  };
  const auto prism_gradient = [&](int count) {
    const Eigen::Matrix<double, 7, 3>& b = geometry.b;
    const double kept[] = {b(0, 0), b(0, 1), b(1, 0), b(1, 1), b(2, 2), b(3, 2), b(4, 2)};
    for (int i = 0; i < count; ++i) write(i, kept[i]);
  };
  switch (kind) {
    case BlockKind::prism_elastic:
    case BlockKind::prism_stored:
    case BlockKind::prism_rate_dependent: {
      using Shape = host::Prism;
      prism_gradient(7);
      for (int i = 0; i < 2; ++i) write(Shape::kMoments + i, geometry.moments(2, i));
      for (int i = 0; i < 3; ++i) write(Shape::kStiffness + i, g[i]);
      write(Shape::kVolume, geometry.volume);
      return;
    }
    case BlockKind::hexahedron_elastic:
    case BlockKind::hexahedron_stored:
    case BlockKind::hexahedron_rate_dependent: {
      using Shape = host::Hexahedron;
      gradient();
      for (int mode = 0; mode < 4; ++mode) {
        for (int axis = 0; axis < 3; ++axis) {
          write(Shape::kMoments + 3 * mode + axis, geometry.moments(mode, axis));
        }
      }
      for (int i = 0; i < 3; ++i) write(Shape::kStiffness + i, g[i]);
      write(Shape::kVolume, geometry.volume);
      return;
    }
    case BlockKind::full_prism_elastic:
    case BlockKind::full_prism_stored:
    case BlockKind::full_prism_rate_dependent: {
      using Shape = host::PrismPoints;
      prism_gradient(5);
      const double area = std::sqrt(3.0) * 64 * geometry.volume * geometry.b(2, 2);
      write(Shape::kBend, geometry.moments(2, 1) / area);
      write(Shape::kBend + 1, -geometry.moments(2, 0) / area);
      write(Shape::kVolume, geometry.volume);
      return;
    }
    case BlockKind::full_elastic:
    case BlockKind::full_stored:
    case BlockKind::full_rate_dependent: {
      using Shape = host::HexahedronPoints;
      gradient();
      for (int p = 0; p < 8; ++p) {
        const int first = Shape::kPoint + Shape::kPerPoint * p;
        for (int axis = 0; axis < 3; ++axis) {
          for (int j = 0; j < 3; ++j) write(first + 3 * axis + j, geometry.to_points[p](axis, j));
        }
        write(first + 9, geometry.point_volumes[p]);
      }
      return;
    }
    default:
      return;
  }
}

template <class Write>
void write_constants(const WedgeGeometry& geometry, const WedgeStiffness& stiffness, Write&& write) {
  using host::Wedge;
  for (int k = 0; k < 15; ++k) write(k, geometry.b(k / 3, k % 3));
  for (int k = 0; k < 6; ++k) write(Wedge::kMoments + k, geometry.moments(k / 3, k % 3));
  for (int k = 0; k < 4; ++k) write(Wedge::kSlopes + k, geometry.slopes(k / 2, k % 2));
  write(Wedge::kStiffness, stiffness.twist);
  write(Wedge::kStiffness + 1, stiffness.warp);
  write(Wedge::kPoisson, stiffness.poisson);
  write(Wedge::kVolume, geometry.volume);
}

/// Highest squared frequency of a hexahedron or wedge.
double exact_of(const BlockGroup& group, const Mesh& mesh, Index first) {
  const PartConstants& part = group.plan.constants;
  if (group.corners() == 6) {
    const WedgeGeometry geometry = wedge_geometry(corners_of<WedgeCorners>(mesh, first));
    return wedge_exact(geometry, part, wedge_stiffness(geometry, group.plan));
  }
  const HexahedronGeometry geometry = hexahedron_geometry(corners_of<Corners>(mesh, first));
  if (group.plan.full) return full_exact(geometry, part, part.density);
  return one_point_exact(geometry, part, hourglass_constants(geometry, group.plan.hourglass_factor),
                         part.density);
}

/// For bounds, which stay bounds.
float rounded_up(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

void require_stiffness(const Mesh& mesh) {
  for (Index e = 0; e < mesh.element_count(); ++e) {
    const ElementType type = mesh.types[e];
    if (type != ElementType::hexahedron && type != ElementType::tetrahedron && type != ElementType::wedge) {
      throw Error(Status::bad_mesh,
                  "element " + numbered(e) +
                      " is no hexahedron, tetrahedron or wedge; only these have a stiffness, so mesh part '" +
                      mesh.part_names[mesh.parts[e]] + "' with them (a pyramid makes two tetrahedra)");
    }
  }
}

struct Shape {
  double volume;
  bool prism, inverted;
};
Shape shape_of(const Mesh& mesh, ElementType type, Index first) {
  if (type == ElementType::tetrahedron) {
    const double volume = tetrahedron_geometry(corners_of<TetrahedronCorners>(mesh, first)).volume;
    return {volume, false, !(volume > 0)};
  }
  if (type == ElementType::wedge) {
    const WedgeGeometry geometry = wedge_geometry(corners_of<WedgeCorners>(mesh, first));
    return {geometry.volume, false, !(geometry.volume > 0 && geometry.least_jacobian > 0)};
  }
  const HexahedronGeometry geometry = hexahedron_geometry(corners_of<Corners>(mesh, first));
  return {geometry.volume, geometry.prism, !(geometry.volume > 0 && geometry.least_jacobian > 0)};
}

}  // namespace

ElementBlocks::ElementBlocks(const Model& model) : part_count(model.mesh.part_names.size()) {
  const Threads threads(model.threads);
  require_stiffness(model.mesh);
  first_corner = first_corners(model.mesh);
  sort_into_groups(model, threads);
  for (BlockGroup& group : groups) {
    if (group.plan.user) start_user_law(group, model.mesh);
  }
  for (BlockGroup& group : groups) fill(group, model.mesh, threads);
  tighten_step_terms(model.mesh);
  colour_tasks(model.mesh);
}

void ElementBlocks::sort_into_groups(const Model& model, const Threads& threads) {
  const Mesh& mesh = model.mesh;
  std::vector<std::optional<PartPlan>> plans;
  for (const Part* part : parts_in_order(model)) plans.push_back(plan_part(model, *part));

  const auto count = static_cast<std::size_t>(mesh.element_count());
  std::vector<std::uint8_t> prism(count), inverted(count);
  threads.for_each(mesh.element_count(), [&](std::int64_t e) {
    if (!plans[mesh.parts[e]]) return;
    const Shape shape = shape_of(mesh, mesh.types[e], first_corner[e]);
    prism[e] = shape.prism;
    inverted[e] = shape.inverted;
  });
  if (const auto bad = std::find(inverted.begin(), inverted.end(), 1); bad != inverted.end()) {
    const auto e = bad - inverted.begin();
    throw Error(Status::bad_mesh,
                "element " + numbered(e) + " of part '" + mesh.part_names[mesh.parts[e]] +
                    "' is inverted or degenerate; order its corners as in VTK and repair the mesh there");
  }

  std::vector<std::vector<Centroid>> members(part_count * kBlockKinds);
  std::size_t deformable = 0;
  for (Index e = 0; e < mesh.element_count(); ++e) {
    const Index part = mesh.parts[e];
    if (!plans[part]) continue;
    ++deformable;
    const Eigen::RowVector3d centre = centre_of(mesh, first_corner[e], first_corner[e + 1]);
    members[static_cast<std::size_t>(part) * kBlockKinds +
            static_cast<int>(kind_of(*plans[part], mesh.types[e], prism[e]))]
        .push_back({{centre[0], centre[1], centre[2]}, e});
  }
  blocks_a_task_ = std::clamp<std::size_t>(deformable / kBlock / kTasksWanted, 1, kMostBlocksATask);
  slots_.assign(count, kNone);
  for (std::size_t m = 0; m < members.size(); ++m) {
    if (members[m].empty()) continue;
    const Index part = static_cast<Index>(m / kBlockKinds);
    const std::size_t run = blocks_a_task_ * kBlock;
    order_in_runs(members[m], run);
    for (std::size_t first = 0; first < members[m].size(); first += run) {
      const std::span<Centroid> rest = std::span(members[m]).subspan(first);
      order_in_runs(rest.first(std::min(rest.size(), run)), kBlock);
    }
    BlockGroup group{static_cast<BlockKind>(m % kBlockKinds),
                     &kernels.kinds[m % kBlockKinds],
                     part,
                     *plans[part],
                     block_count,
                     {},
                     {},
                     {},
                     {},
                     {},
                     nullptr};
    group.elements.reserve(members[m].size());
    for (const Centroid& member : members[m]) {
      slots_[member.element] = static_cast<Index>(block_count * kBlock + group.elements.size());
      group.elements.push_back(member.element);
    }
    block_count += group.blocks();
    groups.push_back(std::move(group));
  }
}

ElementBlocks::Place ElementBlocks::place(Index element) const {
  const Index slot = slots_[static_cast<std::size_t>(element)];
  if (slot == kNone) return {kNone, 0};
  std::size_t group = groups.size() - 1;
  while (groups[group].first_block * kBlock > static_cast<std::size_t>(slot)) --group;
  return {static_cast<std::int32_t>(group),
          static_cast<std::size_t>(slot) - groups[group].first_block * kBlock};
}

/// Before `fill`, since the law's first answer may be what the constants follow from.
void ElementBlocks::start_user_law(BlockGroup& group, const Mesh& mesh) {
  std::vector<UserPoints::Element> elements;
  for (const Index e : group.elements) {
    const double volume = shape_of(mesh, mesh.types[e], first_corner[e]).volume;
    UserPoints::Element element{e, std::cbrt(volume), Mat3::identity()};
    if (group.corners() != 4) {
      const Eigen::Matrix3d frame =
          group.corners() == 8 ? hexahedron_geometry(corners_of<Corners>(mesh, first_corner[e])).frame
                               : wedge_geometry(corners_of<WedgeCorners>(mesh, first_corner[e])).frame;
      for (int i = 0; i < 9; ++i) element.axes(i / 3, i % 3) = frame(i / 3, i % 3);
    }
    elements.push_back(element);
  }
  group.user =
      std::make_unique<UserPoints>(group.plan, group.kernel->points, group.corners(), std::move(elements));
  const UserPoints::Moduli shown = group.user->start([&](std::size_t slot, int corner) {
    const Index node = mesh.connectivity[first_corner[group.elements[slot]] + corner];
    return &mesh.coordinates[3 * static_cast<std::size_t>(node)];
  });
  const UserMaterial& law = *group.plan.user;
  if (shown.youngs == 0 && law.youngs_modulus == 0) {
    throw Error(
        Status::bad_argument,
        "material '" + group.plan.material +
            "' gave no stress like an elastic solid's for the tiny strain of its first call; give its "
            "youngs_modulus and poissons_ratio, or make it answer there");
  }
  if (shown.youngs > 0) set_elasticity(group.plan, shown.youngs, shown.poisson);
  if (law.youngs_modulus == 0) set_hourglass(group.plan, shown.youngs, shown.poisson);
}

void ElementBlocks::fill(BlockGroup& group, const Mesh& mesh, const Threads& threads) const {
  const std::size_t rows = group.blocks() * kRows;
  const auto constants = static_cast<std::size_t>(group.kernel->constants);
  group.constants.resize(rows * constants);
  group.state.assign(rows * static_cast<std::size_t>(group.kernel->state), Lanes{});
  group.step_terms.resize(rows * 4);
  group.offsets.resize(rows * static_cast<std::size_t>(group.corners()) * kLanes);
  const PartConstants& part = group.plan.constants;
  threads.for_each(static_cast<std::int64_t>(rows * kLanes), [&](std::int64_t i) {
    const auto slot = static_cast<std::size_t>(i), row = slot / kLanes, lane = slot % kLanes;
    const Index e = group.elements[std::min(slot, group.elements.size() - 1)];
    const auto write = [&](int component, double value) {
      group.constants[row * constants + static_cast<std::size_t>(component)].value[lane] = value;
    };
    for (Index corner = 0; corner < group.corners(); ++corner) {
      group.corner_offsets(slot)[corner * kLanes] = 3 * mesh.connectivity[first_corner[e] + corner];
    }
    StepTerms terms;
    if (group.corners() == 4) {
      const auto geometry = tetrahedron_geometry(corners_of<TetrahedronCorners>(mesh, first_corner[e]));
      for (int k = 0; k < 9; ++k) write(k, geometry.gradient(1 + k / 3, k % 3));
      write(host::Tetrahedron::kVolume, geometry.volume);
      terms = tetrahedron_terms(geometry, part, part.density);
    } else if (group.corners() == 6) {
      const WedgeGeometry geometry = wedge_geometry(corners_of<WedgeCorners>(mesh, first_corner[e]));
      const WedgeStiffness stiffness = wedge_stiffness(geometry, group.plan);
      write_constants(geometry, stiffness, write);
      terms = wedge_terms(geometry, part, stiffness);
    } else {
      const HexahedronGeometry geometry = hexahedron_geometry(corners_of<Corners>(mesh, first_corner[e]));
      const Eigen::Vector3d g = hourglass_constants(geometry, group.plan.hourglass_factor);
      write_constants(group.kind, geometry, g, write);
      terms = group.plan.full ? full_terms(geometry, part, part.density)
                              : one_point_terms(geometry, part, g, part.density);
    }
    SingleLanes* at = &group.step_terms[4 * row];
    at[0].value[lane] = rounded_up(terms.material);
    at[1].value[lane] = rounded_up(terms.hourglass);
    at[2].value[lane] = rounded_up(terms.coupling);
    at[3].value[lane] = rounded_up(terms.geometric);
  });
}

/// Solves the eigenproblem of those elements whose bound could decide the stable step. Where the rate scales
/// the material's stiffness but not that of the hourglass, the bound stays.
void ElementBlocks::tighten_step_terms(const Mesh& mesh) {
  constexpr double kSlack = 1.005;
  struct Candidate {
    double bound;
    BlockGroup* group;
    std::size_t slot;
  };
  std::vector<Candidate> candidates;
  double highest = 0;
  for (BlockGroup& group : groups) {
    for (std::size_t slot = 0; slot < group.elements.size(); ++slot) {
      const SingleLanes* at = &group.step_terms[slot / kLanes * 4];
      const std::size_t lane = slot % kLanes;
      const StepTerms terms{at[0].value[lane], at[1].value[lane], at[2].value[lane], at[3].value[lane]};
      highest = std::max(highest, std::max(terms.material, terms.hourglass));
      const bool follows = group.plan.full || group.corners() == 6;
      if (terms.coupling > 0 && (follows || !group.plan.rate_dependent))
        candidates.push_back({terms.bound(), &group, slot});
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.bound > b.bound; });
  for (const auto& [bound, group, slot] : candidates) {
    if (bound <= kSlack * highest) break;
    const double exact = exact_of(*group, mesh, first_corner[group->elements[slot]]);
    SingleLanes* at = &group->step_terms[slot / kLanes * 4];
    const std::size_t lane = slot % kLanes;
    const double material = at[0].value[lane], hourglass = at[1].value[lane];
    at[2].value[lane] =
        rounded_up(std::max(0.0, (exact - std::max(material, hourglass)) / std::sqrt(material * hourglass)));
    highest = std::max(highest, exact);
  }
}

void ElementBlocks::colour_tasks(const Mesh& mesh) {
  std::vector<std::size_t> first{0};
  std::vector<Index> nodes;
  std::vector<Task> tasks;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const BlockGroup& group = groups[g];
    for (std::size_t block = 0; block < group.blocks(); block += blocks_a_task_) {
      const std::size_t last = std::min(block + blocks_a_task_, group.blocks());
      for (std::size_t slot = block * kBlock; slot < std::min(last * kBlock, group.elements.size()); ++slot) {
        const std::int32_t* offsets = group.corner_offsets(slot);
        for (int corner = 0; corner < group.corners(); ++corner)
          nodes.push_back(offsets[corner * kLanes] / 3);
      }
      first.push_back(nodes.size());
      tasks.push_back(
          {static_cast<std::int32_t>(g), static_cast<std::int32_t>(block), static_cast<std::int32_t>(last)});
    }
  }
  // Threads share nodes out in slabs, too.
  const int axis = slab_axis(extents_of_pieces(mesh.coordinates));
  std::vector<double> place(tasks.size(), 0);
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    for (std::size_t i = first[t]; i < first[t + 1]; ++i) place[t] += mesh.coordinates[3 * nodes[i] + axis];
    place[t] /= static_cast<double>(first[t + 1] - first[t]);
  }
  for (std::vector<std::int32_t>& of_colour : colour(first, nodes, mesh.node_count())) {
    std::stable_sort(of_colour.begin(), of_colour.end(),
                     [&](std::int32_t a, std::int32_t b) { return place[a] < place[b]; });
    std::vector<Task>& list = colours.emplace_back();
    for (const std::int32_t task : of_colour) list.push_back(tasks[task]);
  }
}

}  // namespace cdfp
