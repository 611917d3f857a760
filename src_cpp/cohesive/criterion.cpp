#include "cohesive/criterion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cohesive/law.hpp"

namespace cdfp {

namespace {

/// Twice the area of a facet along its outward normal.
Vec3 doubled_area(const FacetNodes& facet, std::span<const double> position) {
  const auto x = [&](int c) { return Vec3::load(&position[3 * static_cast<std::size_t>(facet.nodes[c])]); };
  return facet.count == 4 ? cross(x(2) - x(0), x(3) - x(1)) : cross(x(1) - x(0), x(2) - x(0));
}

/// What may open the facet: pressure holds part of the shear back (Mohr-Coulomb).
double opening_traction(Vec3 traction, Vec3 normal, const CohesiveLaw& law) {
  const double pressure = -dot(traction, normal);
  if (pressure <= 0) return effective_traction(traction, normal, law.shear_ratio);
  const double shear = norm(traction + pressure * normal);
  return std::max(0.0, shear - law.internal_friction * pressure) / law.shear_ratio;
}

constexpr std::int64_t kPiece = 64;  ///< elements that one thread looks at together

double norm_of(const Mat3& a) {
  return std::sqrt(dot(a.r[0], a.r[0]) + dot(a.r[1], a.r[1]) + dot(a.r[2], a.r[2]));
}

}  // namespace

Criterion::Criterion(const Model& model)
    : strength_(model), recovery_(model.stress_recovery), known_(model.mesh.types.size()) {}

/// A little less, as a norm and a traction round differently.
double Criterion::least_norm(Index element) const {
  const CohesiveLaw* law = strength_.law_of(element);
  return law ? (1 - 1e-12) * strength_.least_of_element(element) * std::min(1.0, law->shear_ratio)
             : std::numeric_limits<double>::infinity();
}

void Criterion::list(std::span<const Index> elements, std::span<const Mat3> stresses, const Scene& scene,
                     const Threads& threads) {
  listed_.assign(elements.begin(), elements.end());
  stresses_.resize(listed_.size());
  norms_.resize(listed_.size());
  is_able_.resize(listed_.size());
  threads.deal_ranges(std::ssize(listed_), kPiece, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      const Index element = listed_[i];
      stresses_[i] = stresses.empty() ? scene.stress(element) : stresses[i];
      norms_[i] = norm_of(stresses_[i]);
      is_able_[i] = static_cast<std::uint8_t>(norms_[i] >= least_norm(element));
    }
  });
  known_.take(listed_);
  able_.clear();
  for (std::size_t i = 0; i < listed_.size(); ++i) {
    if (is_able_[i] != 0) able_.push_back(listed_[i]);
  }
}

std::vector<Index> Criterion::with_neighbours(const Topology& topology) const {
  std::vector<Index> all;
  std::vector<VertexUse> around;
  for (const Index e : able_) {
    for (const Index node : topology.nodes(e)) {
      topology.elements_around_node(node, around);
      for (const VertexUse& use : around) {
        if (use.element < topology.bulk_count()) all.push_back(use.element);
      }
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// Sums go over elements in the order of their numbers, whichever facet asks.
Mat3 Criterion::nodal_stress(const FacetNodes& facet, Index part, const Scene& scene) const {
  Mat3 sum;
  std::vector<VertexUse> around;
  for (const Index node : facet.view()) {
    scene.topology.elements_around_node(node, around);
    std::erase_if(around, [&](const VertexUse& use) {
      return use.element >= scene.topology.bulk_count() || strength_.part_of(use.element) != part;
    });
    Mat3 at_node;
    for (const VertexUse& use : around) at_node = at_node + stress_of(use.element, scene);
    sum = sum + 1.0 / (static_cast<double>(around.size()) * facet.count) * at_node;
  }
  return sum;
}

void Criterion::look_at_facets(Index element, const Scene& scene, std::vector<OpenFacet>& open) const {
  const CohesiveLaw* law = strength_.law_of(element);
  if (!law) return;
  const bool nodal = recovery_ == StressRecovery::nodal;
  const double own_norm = norms_[known_.place(element)];
  for (Index f = 0; f < scene.topology.facet_count(element); ++f) {
    const FacetUse use{element, f}, mate = scene.topology.mate(use);
    if (mate.element == kNone || mate.element >= scene.topology.bulk_count()) continue;
    if (strength_.part_of(mate.element) != strength_.part_of(element)) continue;
    const Index place = known_.place(mate.element);
    if (mate.element < element && place != kNone && is_able_[place] != 0) continue;  // its turn
    const FacetUse lower = mate.element > element ? use : mate;
    const double strength = strength_.of(lower, std::max(element, mate.element));
    if (!nodal) {
      const double mate_norm = place != kNone ? norms_[place] : (1 + 1e-9) * least_norm(mate.element);
      if (0.5 * (own_norm + mate_norm) < (1 - 1e-9) * strength * std::min(1.0, law->shear_ratio)) continue;
    }
    const FacetNodes facet = scene.topology.facet_nodes(lower);
    const Vec3 normal = normalized(doubled_area(facet, scene.position));
    const Mat3 recovered =
        nodal ? nodal_stress(facet, strength_.part_of(element), scene)
              : 0.5 * (stress_of(lower.element, scene) + stress_of(std::max(element, mate.element), scene));
    const Vec3 traction = recovered * normal;
    if (opening_traction(traction, normal, *law) >= strength) open.push_back({lower, traction});
  }
}

void Criterion::find(std::span<const Index> candidates, std::span<const Mat3> candidate_stresses,
                     const Topology& topology, std::span<const double> position,
                     const std::function<Mat3(Index)>& stress, std::vector<OpenFacet>& open,
                     const Threads& threads) {
  open.clear();
  if (candidates.empty()) return;
  const Scene scene{topology, position, stress};
  list(candidates, candidate_stresses, scene, threads);
  if (recovery_ == StressRecovery::nodal) {
    const std::vector<Index> wider = with_neighbours(topology);
    known_.drop(listed_);
    list(wider, {}, scene, threads);
    is_able_.assign(wider.size(), 1);
    able_ = wider;
  }
  found_.resize((able_.size() + kPiece - 1) / kPiece);
  threads.deal_ranges(std::ssize(able_), kPiece, [&](std::int64_t begin, std::int64_t end) {
    std::vector<OpenFacet>& here = found_[begin / kPiece];
    here.clear();
    for (std::int64_t i = begin; i < end; ++i) look_at_facets(able_[i], scene, here);
  });
  for (const std::vector<OpenFacet>& piece : found_) open.insert(open.end(), piece.begin(), piece.end());
  std::sort(open.begin(), open.end(),
            [](const OpenFacet& a, const OpenFacet& b) { return a.lower < b.lower; });
  known_.drop(listed_);
}

}  // namespace cdfp
