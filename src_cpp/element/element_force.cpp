#include "element/element_force.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <variant>

#include "cdfp/error.hpp"
#include "element/block_order.hpp"
#include "element/full_integration.hpp"
#include "element/geometry.hpp"
#include "element/kernels.hpp"
#include "element/one_point.hpp"
#include "element/step_bound.hpp"
#include "material/elastic.hpp"
#include "material/rate_dependent.hpp"

namespace cdfp {

namespace {

/// Modulus of rate-dependent parts in the hourglass stiffness: that at this rate, 1/s.
constexpr double kRateOfHourglass = 100;

/// What the constructor knows of a deformable part.
struct PartPlan {
  PartConstants constants;
  bool full = false;
  bool rate_dependent = false;
  double hourglass_factor = 0;  ///< g_i^2 = hourglass_factor * H_ii
  double smoothing_time = 0;
  bool cracks = false;
};

template <class Items, class Name>
const auto& named(const Items& items, const Name& name, const std::string& what) {
  for (const auto& item : items) {
    if (item.name == name) return item;
  }
  throw Error(Status::bad_argument, what + " '" + name + "' is not defined; add it to the model");
}

double lambda_of(double modulus, double nu) {
  return modulus * nu / ((1 + nu) * (1 - 2 * nu));
}
double mu_of(double modulus, double nu) {
  return modulus / (2 * (1 + nu));
}

/// Norm of the second Piola-Kirchhoff stress below which the Cauchy stress stays under `stress`. Where S has
/// that norm, |E| <= |S| / (2 mu), and |sigma| <= (1 + 2|E|) / (1 - 2|E|)^1.5 |S|.
double critical_norm(double stress, double mu) {
  const double strain = stress / (2 * mu);
  if (strain >= 0.25) return 0;
  return 0.999 * stress * std::pow(1 - 2 * strain, 1.5) / (1 + 2 * strain);
}

/// Nothing for a rigid part.
std::optional<PartPlan> plan_part(const Model& model, const std::string& name) {
  const Part& part = named(model.parts, name, "part");
  const Material& material = named(model.materials, part.material, "material");
  PartPlan plan;
  PartConstants& constants = plan.constants;
  double nu = 0, hourglass_modulus = 0;
  if (const auto* elastic = std::get_if<ElasticMaterial>(&material.law)) {
    nu = elastic->poissons_ratio;
    hourglass_modulus = elastic->youngs_modulus;
    constants.density = elastic->density;
    constants.material.lambda = lambda_of(elastic->youngs_modulus, nu);
    constants.material.mu = mu_of(elastic->youngs_modulus, nu);
  } else if (const auto* rate = std::get_if<RateDependentMaterial>(&material.law)) {
    nu = rate->poissons_ratio;
    hourglass_modulus =
        rate->static_modulus + rate->rate_modulus * std::pow(kRateOfHourglass, rate->rate_exponent);
    constants.density = rate->density;
    constants.material = {lambda_of(rate->static_modulus, nu),
                          mu_of(rate->static_modulus, nu),
                          lambda_of(1, nu),
                          mu_of(1, nu),
                          rate->rate_modulus,
                          rate->rate_exponent};
    plan.smoothing_time = rate->smoothing_time;
    plan.rate_dependent = true;
  } else {
    return std::nullopt;
  }
  plan.full = part.formulation == Formulation::full;
  plan.hourglass_factor = part.hourglass * 2 * mu_of(hourglass_modulus, nu) / (1 - nu) / 64;
  constants.bending_coupling = nu;
  constants.shear_share = (1 - nu) / 2;
  constants.warping_share = (1 - nu * nu) / 3;
  plan.cracks = !part.cohesive_law.empty();
  double norm = std::numeric_limits<double>::infinity();
  if (plan.cracks) {
    const CohesiveLaw& law = named(model.cohesive_laws, part.cohesive_law, "cohesive law");
    const double stress = law.strength * std::min(1.0, law.shear_ratio);
    norm = plan.rate_dependent ? 0 : critical_norm(stress, constants.material.mu);
  }
  constants.critical_norm_squared = norm * norm;
  return plan;
}

BlockKind kind_of(const PartPlan& plan, bool prism) {
  if (plan.full) return plan.rate_dependent ? BlockKind::full_rate_dependent : BlockKind::full_elastic;
  if (prism) return plan.rate_dependent ? BlockKind::prism_rate_dependent : BlockKind::prism_elastic;
  return plan.rate_dependent ? BlockKind::hexahedron_rate_dependent : BlockKind::hexahedron_elastic;
}

/// `visit<Formulation, Law>()` of a kind, for one element at a time.
template <class Visit>
void for_kind(BlockKind kind, Visit&& visit) {
  using namespace host;
  switch (kind) {
    case BlockKind::prism_elastic:
      return visit.template operator()<OnePoint<Prism>, Elastic>();
    case BlockKind::prism_rate_dependent:
      return visit.template operator()<OnePoint<Prism>, RateDependent>();
    case BlockKind::hexahedron_elastic:
      return visit.template operator()<OnePoint<Hexahedron>, Elastic>();
    case BlockKind::hexahedron_rate_dependent:
      return visit.template operator()<OnePoint<Hexahedron>, RateDependent>();
    case BlockKind::full_elastic:
      return visit.template operator()<FullIntegration, Elastic>();
    case BlockKind::full_rate_dependent:
      return visit.template operator()<FullIntegration, RateDependent>();
  }
}

/// g_i of one_point.hpp: H_ii = l_j l_k / (3 l_i).
Eigen::Vector3d hourglass_constants(const HexahedronGeometry& geometry, double factor) {
  const Eigen::Vector3d& l = geometry.lengths;
  return (factor * l.prod() / 3 * l.cwiseProduct(l).cwiseInverse()).cwiseSqrt();
}

Corners corners_of(const Mesh& mesh, Index element) {
  Corners x;
  for (int c = 0; c < 8; ++c) {
    const Index node = mesh.connectivity[8 * static_cast<std::size_t>(element) + c];
    x.row(c) = Eigen::Map<const Eigen::RowVector3d>(&mesh.coordinates[3 * static_cast<std::size_t>(node)]);
  }
  return x;
}

/// An element's constants, in the order of its formulation; `write(component, value)`.
template <class Write>
void write_constants(BlockKind kind, const HexahedronGeometry& geometry, const Eigen::Vector3d& g,
                     Write&& write) {
  const auto all_modes = [&] {
    for (int mode = 0; mode < 7; ++mode) {
      for (int axis = 0; axis < 3; ++axis) write(3 * mode + axis, geometry.b(mode, axis));
    }
  };
  switch (kind) {
    case BlockKind::prism_elastic:
    case BlockKind::prism_rate_dependent: {
      using Shape = host::Prism;
      const Eigen::Matrix<double, 7, 3>& b = geometry.b;
      const double kept[] = {b(0, 0), b(0, 1), b(1, 0), b(1, 1), b(2, 2), b(3, 2), b(4, 2)};
      for (int i = 0; i < 7; ++i) write(Shape::kGradient + i, kept[i]);
      for (int i = 0; i < 2; ++i) write(Shape::kMoments + i, geometry.moments(2, i));
      for (int i = 0; i < 3; ++i) write(Shape::kStiffness + i, g[i]);
      write(Shape::kVolume, geometry.volume);
      return;
    }
    case BlockKind::hexahedron_elastic:
    case BlockKind::hexahedron_rate_dependent: {
      using Shape = host::Hexahedron;
      all_modes();
      for (int mode = 0; mode < 4; ++mode) {
        for (int axis = 0; axis < 3; ++axis) {
          write(Shape::kMoments + 3 * mode + axis, geometry.moments(mode, axis));
        }
      }
      for (int i = 0; i < 3; ++i) write(Shape::kStiffness + i, g[i]);
      write(Shape::kVolume, geometry.volume);
      return;
    }
    case BlockKind::full_elastic:
    case BlockKind::full_rate_dependent: {
      using Shape = host::FullIntegration;
      all_modes();
      for (int p = 0; p < Shape::kPoints; ++p) {
        const int first = Shape::kPoint + Shape::kPerPoint * p;
        for (int axis = 0; axis < 3; ++axis) {
          for (int j = 0; j < 3; ++j) write(first + 3 * axis + j, geometry.to_points[p](axis, j));
        }
        write(first + 9, geometry.point_volumes[p]);
      }
      return;
    }
  }
}

}  // namespace

struct ElementForce::Blocks {
  /// All blocks of one part and kind.
  struct Group {
    BlockKind kind;
    const BlockKernel* kernel;
    Index part;
    PartPlan plan;
    std::size_t first_block = 0;  ///< of all groups' blocks
    std::size_t count = 0;        ///< blocks
    std::vector<Index> elements;  ///< [block][lane]; the last block may have idle lanes
    std::vector<Lanes> constants, state, terms;
    std::vector<std::int32_t> offsets;

    int lanes(std::size_t block) const {
      return static_cast<int>(std::min<std::size_t>(kLanes, elements.size() - block * kLanes));
    }
    BlockInput input(std::size_t block, std::span<const double> position, StepConstants step = {}) const {
      return {constants.data() + block * static_cast<std::size_t>(kernel->constants),
              offsets.data() + block * 8 * kLanes,
              const_cast<Lanes*>(state.data()) + block * static_cast<std::size_t>(kernel->state),
              lanes(block),
              &plan.constants,
              step,
              position.data()};
    }
  };
  struct Place {
    std::int32_t group = kNone;
    std::int32_t slot = 0;  ///< block * kLanes + lane
  };
  struct Task {
    std::int32_t group;
    std::int32_t block;
  };

  explicit Blocks(const Model& model);

  void make_groups(const Model& model, const Threads& threads);
  void fill(Group& group, const Model& model, const Threads& threads) const;
  void tighten_step_bounds(const Model& model);
  void colour(const Model& model);

  std::int32_t& offset(const Place& place, Index corner) {
    return groups[place.group]
        .offsets[place.slot / kLanes * 8 * kLanes + corner * kLanes + place.slot % kLanes];
  }
  void corners(const Place& place, std::span<const double> position, double (&x)[8][3]) const;

  const Kernels& kernels = choose_kernels();
  std::vector<Group> groups;
  std::size_t blocks = 0;
  std::vector<Place> places;                ///< one an element
  std::vector<std::vector<Task>> colours;   ///< blocks of one colour share no node
  std::vector<StepConstants> steps;         ///< one a group
  std::vector<std::uint64_t> critical_now;  ///< one a block, bit l: lane l
  std::vector<std::uint64_t> critical_set;  ///< one bit an element
  std::vector<Index> critical;
  std::vector<double> corner_masses;
  std::size_t part_count = 0;
  bool any_cracks = false;
};

ElementForce::Blocks::Blocks(const Model& model) : part_count(model.mesh.part_names.size()) {
  const Threads threads(model.threads);
  make_groups(model, threads);
  for (Group& group : groups) fill(group, model, threads);
  tighten_step_bounds(model);
  colour(model);
  steps.resize(groups.size());
  critical_now.assign(blocks, 0);
  if (any_cracks) critical_set.assign((places.size() + 63) / 64, 0);
}

void ElementForce::Blocks::make_groups(const Model& model, const Threads& threads) {
  const Mesh& mesh = model.mesh;
  std::vector<std::optional<PartPlan>> plans;
  for (const std::string& name : mesh.part_names) {
    plans.push_back(plan_part(model, name));
    any_cracks = any_cracks || (plans.back() && plans.back()->cracks);
  }
  const Index count = mesh.element_count();
  for (Index e = 0; e < count; ++e) {
    if (mesh.types[e] != ElementType::hexahedron) {
      throw Error(Status::bad_mesh,
                  "element " + std::to_string(e) +
                      " is not a hexahedron; only hexahedra have a stiffness, so mesh part '" +
                      mesh.part_names[mesh.parts[e]] + "' with hexahedra");
    }
  }
  std::vector<std::uint8_t> prism(static_cast<std::size_t>(count)), inverted(static_cast<std::size_t>(count));
  corner_masses.assign(static_cast<std::size_t>(count), 0);
  threads.for_each(count, [&](std::int64_t e) {
    const std::optional<PartPlan>& plan = plans[mesh.parts[e]];
    if (!plan) return;
    const HexahedronGeometry geometry = hexahedron_geometry(corners_of(mesh, static_cast<Index>(e)));
    prism[e] = geometry.prism;
    inverted[e] = !(geometry.volume > 0 && geometry.least_jacobian > 0);
    corner_masses[e] = plan->constants.density * geometry.volume / 8;
  });
  if (const auto bad = std::find(inverted.begin(), inverted.end(), 1); bad != inverted.end()) {
    const auto e = bad - inverted.begin();
    throw Error(Status::bad_mesh,
                "element " + std::to_string(e) + " of part '" + mesh.part_names[mesh.parts[e]] +
                    "' is inverted or degenerate; order its corners as in VTK and repair the mesh there");
  }

  std::vector<std::vector<Centroid>> members(part_count * kBlockKinds);
  for (Index e = 0; e < count; ++e) {
    const Index part = mesh.parts[e];
    if (!plans[part]) continue;
    const Eigen::RowVector3d centre = corners_of(mesh, e).colwise().mean();
    members[static_cast<std::size_t>(part) * kBlockKinds + static_cast<int>(kind_of(*plans[part], prism[e]))]
        .push_back({{centre[0], centre[1], centre[2]}, e});
  }
  places.resize(static_cast<std::size_t>(count));
  for (std::size_t m = 0; m < members.size(); ++m) {
    if (members[m].empty()) continue;
    order_in_blocks(members[m], kLanes);
    const Index part = static_cast<Index>(m / kBlockKinds);
    const auto kind = static_cast<BlockKind>(m % kBlockKinds);
    Group group{kind, &kernels.kinds[m % kBlockKinds], part, *plans[part], blocks, 0, {}, {}, {}, {}, {}};
    group.count = (members[m].size() + kLanes - 1) / kLanes;
    for (const Centroid& member : members[m]) {
      places[member.element] = {static_cast<std::int32_t>(groups.size()),
                                static_cast<std::int32_t>(group.elements.size())};
      group.elements.push_back(member.element);
    }
    blocks += group.count;
    groups.push_back(std::move(group));
  }
}

void ElementForce::Blocks::fill(Group& group, const Model& model, const Threads& threads) const {
  const Mesh& mesh = model.mesh;
  const auto constants = static_cast<std::size_t>(group.kernel->constants);
  group.constants.resize(group.count * constants);
  group.state.assign(group.count * static_cast<std::size_t>(group.kernel->state), Lanes{});
  group.terms.resize(group.count * 4);
  group.offsets.resize(group.count * 8 * kLanes);
  threads.for_each(static_cast<std::int64_t>(group.count), [&](std::int64_t block) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const std::size_t slot =
          std::min(static_cast<std::size_t>(block) * kLanes + static_cast<std::size_t>(lane),
                   group.elements.size() - 1);
      const Index e = group.elements[slot];
      const HexahedronGeometry geometry = hexahedron_geometry(corners_of(mesh, e));
      const Eigen::Vector3d g = hourglass_constants(geometry, group.plan.hourglass_factor);
      write_constants(group.kind, geometry, g, [&](int component, double value) {
        group.constants[static_cast<std::size_t>(block) * constants + component].value[lane] = value;
      });
      for (int corner = 0; corner < 8; ++corner) {
        group.offsets[(static_cast<std::size_t>(block) * 8 + corner) * kLanes + lane] =
            3 * mesh.connectivity[8 * static_cast<std::size_t>(e) + corner];
      }
      const PartConstants& part = group.plan.constants;
      const StepTerms terms = group.plan.full ? full_terms(geometry, part, part.density)
                                              : one_point_terms(geometry, part, g, part.density);
      Lanes* at = &group.terms[4 * static_cast<std::size_t>(block)];
      at[0].value[lane] = terms.material;
      at[1].value[lane] = terms.hourglass;
      at[2].value[lane] = terms.coupling;
      at[3].value[lane] = terms.geometric;
    }
  });
}

/// Solves the eigenproblem of those elastic elements whose bound could decide the stable step.
void ElementForce::Blocks::tighten_step_bounds(const Model& model) {
  constexpr double kSlack = 1.005;
  struct Candidate {
    double bound;
    Place place;
  };
  std::vector<Candidate> candidates;
  double highest = 0;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Group& group = groups[g];
    for (std::size_t slot = 0; slot < group.elements.size(); ++slot) {
      const Lanes* at = &group.terms[slot / kLanes * 4];
      const int lane = static_cast<int>(slot % kLanes);
      const StepTerms terms{at[0].value[lane], at[1].value[lane], at[2].value[lane], at[3].value[lane]};
      highest = std::max(highest, std::max(terms.material, terms.hourglass));
      if (terms.coupling > 0 && !group.plan.rate_dependent) {
        candidates.push_back(
            {terms.bound(), {static_cast<std::int32_t>(g), static_cast<std::int32_t>(slot)}});
      }
    }
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.bound > b.bound; });
  for (const auto& [bound, place] : candidates) {
    if (bound <= kSlack * highest) break;
    Group& group = groups[place.group];
    const HexahedronGeometry geometry =
        hexahedron_geometry(corners_of(model.mesh, group.elements[place.slot]));
    const PartConstants& part = group.plan.constants;
    const double exact = one_point_exact(
        geometry, part, hourglass_constants(geometry, group.plan.hourglass_factor), part.density);
    Lanes* at = &group.terms[static_cast<std::size_t>(place.slot / kLanes) * 4];
    const int lane = place.slot % kLanes;
    const double material = at[0].value[lane], hourglass = at[1].value[lane];
    at[2].value[lane] =
        std::max(0.0, (exact - std::max(material, hourglass)) / std::sqrt(material * hourglass));
    highest = std::max(highest, exact);
  }
}

void ElementForce::Blocks::colour(const Model& model) {
  std::vector<std::size_t> first{0};
  std::vector<Index> nodes;
  std::vector<Task> tasks;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (std::size_t block = 0; block < groups[g].count; ++block) {
      for (int lane = 0; lane < groups[g].lanes(block); ++lane) {
        const Index* corner =
            &model.mesh.connectivity[8 * static_cast<std::size_t>(groups[g].elements[block * kLanes + lane])];
        nodes.insert(nodes.end(), corner, corner + 8);
      }
      first.push_back(nodes.size());
      tasks.push_back({static_cast<std::int32_t>(g), static_cast<std::int32_t>(block)});
    }
  }
  for (const std::vector<std::int32_t>& of_colour : colour_blocks(first, nodes, model.mesh.node_count())) {
    std::vector<Task>& list = colours.emplace_back();
    for (const std::int32_t block : of_colour) list.push_back(tasks[block]);
  }
}

void ElementForce::Blocks::corners(const Place& place, std::span<const double> position,
                                   double (&x)[8][3]) const {
  const std::int32_t* offsets =
      &groups[place.group]
           .offsets[static_cast<std::size_t>(place.slot / kLanes) * 8 * kLanes + place.slot % kLanes];
  for (int corner = 0; corner < 8; ++corner)
    host::gather3(position.data(), offsets + corner * kLanes, x[corner]);
}

ElementForce::ElementForce(const Model& model) : blocks_(std::make_unique<Blocks>(model)) {}
ElementForce::~ElementForce() = default;

void ElementForce::add_mass(std::span<double> mass) const {
  for (std::size_t e = 0; e < blocks_->places.size(); ++e) {
    const Blocks::Place& place = blocks_->places[e];
    if (place.group == kNone) continue;
    for (Index corner = 0; corner < 8; ++corner) {
      mass[blocks_->offset(place, corner) / 3] += blocks_->corner_masses[e];
    }
  }
}

double ElementForce::corner_mass(Index element) const {
  return blocks_->corner_masses[element];
}

void ElementForce::add_force(std::span<const double> position, std::span<double> force, double step,
                             const Threads& threads) {
  Blocks& b = *blocks_;
  for (std::size_t g = 0; g < b.groups.size(); ++g) {
    const PartPlan& plan = b.groups[g].plan;
    if (plan.rate_dependent && step > 0) {
      b.steps[g] = {1 / step, -std::expm1(-step / plan.smoothing_time)};
    } else {
      b.steps[g] = {};
    }
  }
  const auto run = [&](const Blocks::Task& task) {
    const Blocks::Group& group = b.groups[task.group];
    const auto block = static_cast<std::size_t>(task.block);
    b.critical_now[group.first_block + block] =
        group.kernel->add_force(group.input(block, position, b.steps[task.group]), force.data());
  };
  if (threads.count() == 1) {
    for (const std::vector<Blocks::Task>& tasks : b.colours) {
      for (const Blocks::Task& task : tasks) run(task);
    }
  } else {
#pragma omp parallel num_threads(threads.count())
    for (const std::vector<Blocks::Task>& tasks : b.colours) {
      const auto count = static_cast<std::int64_t>(tasks.size());
#pragma omp for schedule(dynamic, 2)
      for (std::int64_t i = 0; i < count; ++i) run(tasks[static_cast<std::size_t>(i)]);
    }
  }

  if (!b.any_cracks) return;
  b.critical.clear();
  for (const Blocks::Group& group : b.groups) {
    if (!group.plan.cracks) continue;
    for (std::size_t block = 0; block < group.count; ++block) {
      std::uint64_t lanes = b.critical_now[group.first_block + block];
      if (const int used = group.lanes(block); used < kLanes) lanes &= (std::uint64_t{1} << used) - 1;
      for (; lanes; lanes &= lanes - 1) {
        const Index e = group.elements[block * kLanes + static_cast<std::size_t>(std::countr_zero(lanes))];
        b.critical_set[static_cast<std::size_t>(e) / 64] |= std::uint64_t{1} << (e % 64);
      }
    }
  }
  for (std::size_t word = 0; word < b.critical_set.size(); ++word) {
    for (std::uint64_t bits = b.critical_set[word]; bits; bits &= bits - 1) {
      b.critical.push_back(static_cast<Index>(64 * word) + std::countr_zero(bits));
    }
    b.critical_set[word] = 0;
  }
}

std::span<const Index> ElementForce::critical_elements() const {
  return blocks_->critical;
}

Mat3 ElementForce::stress(Index element, std::span<const double> position) const {
  const Blocks::Place& place = blocks_->places[element];
  Mat3 sigma;
  if (place.group == kNone) return sigma;
  const Blocks::Group& group = blocks_->groups[place.group];
  double x[8][3];
  blocks_->corners(place, position, x);
  const BlockInput input = group.input(static_cast<std::size_t>(place.slot / kLanes), position);
  const int lane = place.slot % kLanes;
  for_kind(group.kind, [&]<class Formulation, class Law>() {
    const double* state = Law::kState ? &input.state->value[lane] : nullptr;
    double sum[3][3];
    const double volume = Formulation::kirchhoff_stress(
        &input.constants->value[lane], x, sum, [&](const host::Symmetric<double>& strain, int point) {
          return Law::stress(input.part->material, strain, state + point * Law::kState * kLanes);
        });
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) sigma(i, j) = sum[i][j] / volume;
    }
  });
  return sigma;
}

void ElementForce::corner_force(Index element, std::span<const double> position,
                                std::span<double> force) const {
  const Blocks::Place& place = blocks_->places[element];
  std::fill_n(force.begin(), 24, 0.0);
  if (place.group == kNone) return;
  const Blocks::Group& group = blocks_->groups[place.group];
  double x[8][3], f[8][3];
  blocks_->corners(place, position, x);
  const BlockInput input = group.input(static_cast<std::size_t>(place.slot / kLanes), position);
  const int lane = place.slot % kLanes;
  for_kind(group.kind, [&]<class Formulation, class Law>() {
    const double* state = Law::kState ? &input.state->value[lane] : nullptr;
    Formulation::force(*input.part, &input.constants->value[lane], x, f,
                       [&](const host::Symmetric<double>& strain, int point) {
                         return Law::stress(input.part->material, strain,
                                            state + point * Law::kState * kLanes);
                       });
  });
  for (std::size_t i = 0; i < 24; ++i) force[i] = -f[i / 3][i % 3];
}

void ElementForce::replace_node(Index element, Index corner, Index node) {
  const Blocks::Place& place = blocks_->places[element];
  if (place.group != kNone) blocks_->offset(place, corner) = 3 * node;
}

StepBound ElementForce::stable_step(std::span<const double> position, const Threads& threads) const {
  const Blocks& b = *blocks_;
  struct Highest {
    double omega_squared = 0;
    Index element = kNone;
  };
  std::vector<Highest> of_block(b.blocks);
  for (const Blocks::Group& group : b.groups) {
    threads.for_each(static_cast<std::int64_t>(group.count), [&](std::int64_t i) {
      const auto block = static_cast<std::size_t>(i);
      Lanes omega_squared;
      group.kernel->step_bound(group.input(block, position), &group.terms[4 * block], omega_squared.value);
      Highest highest;
      for (int lane = 0; lane < group.lanes(block); ++lane) {
        const double value = omega_squared.value[lane];
        if (value <= highest.omega_squared) continue;
        highest = {value, group.elements[block * kLanes + static_cast<std::size_t>(lane)]};
        if (std::isnan(value)) break;
      }
      of_block[group.first_block + block] = highest;
    });
  }
  Highest highest;
  for (const Highest& h : of_block) {
    if (h.omega_squared <= highest.omega_squared) continue;
    highest = h;
    if (std::isnan(h.omega_squared)) break;
  }
  return {2 / std::sqrt(highest.omega_squared), highest.element};
}

std::vector<PartEnergy> ElementForce::energies(std::span<const double> position,
                                               const Threads& threads) const {
  const Blocks& b = *blocks_;
  std::vector<PartEnergy> parts(b.part_count);
  std::vector<BlockEnergy> of_block;
  for (const Blocks::Group& group : b.groups) {
    of_block.resize(group.count);
    threads.for_each(static_cast<std::int64_t>(group.count), [&](std::int64_t block) {
      of_block[block] = group.kernel->energy(group.input(static_cast<std::size_t>(block), position));
    });
    PartEnergy& part = parts[group.part];
    for (const BlockEnergy& energy : of_block) {
      part.strain += energy.strain;
      part.hourglass += energy.hourglass;
      part.dissipated += energy.dissipated;
    }
  }
  return parts;
}

Index ElementForce::first_inverted(std::span<const double> position) const {
  for (std::size_t e = 0; e < blocks_->places.size(); ++e) {
    const Blocks::Place& place = blocks_->places[e];
    if (place.group == kNone) continue;
    double x[8][3];
    blocks_->corners(place, position, x);
    Corners corners;
    for (int c = 0; c < 8; ++c) corners.row(c) << x[c][0], x[c][1], x[c][2];
    const double volume = hexahedron_volume(corners);
    if (!(volume > 0) || !std::isfinite(volume)) return static_cast<Index>(e);
  }
  return kNone;
}

std::size_t ElementForce::memory() const {
  const Blocks& b = *blocks_;
  std::size_t bytes = b.places.size() * (sizeof(Blocks::Place) + sizeof(double));
  for (const Blocks::Group& group : b.groups) {
    bytes += group.elements.size() * sizeof(Index) + group.offsets.size() * sizeof(std::int32_t);
    bytes += (group.constants.size() + group.state.size() + group.terms.size()) * sizeof(Lanes);
  }
  return b.places.empty() ? 0 : bytes / b.places.size();
}

}  // namespace cdfp
