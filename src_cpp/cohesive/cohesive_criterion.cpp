#include <cmath>
#include <string>

#include "cdfp/cohesive.hpp"
#include "cohesive/check_law.hpp"
#include "cohesive/criterion.hpp"
#include "core/numbered.hpp"
#include "core/require.hpp"

namespace cdfp {

namespace {

/// What `Criterion` reads of a model.
Model model_of(const Topology& topology, std::span<const double> coordinates,
               const CohesiveCriterion::Settings& settings) {
  const Index elements = topology.bulk_count();
  require(coordinates.size() == 3 * static_cast<std::size_t>(topology.node_count()),
          "'coordinates' has " + std::to_string(coordinates.size()) +
              " numbers; give three for each of the " + std::to_string(topology.node_count()) +
              " nodes of the topology");
  require(settings.parts.size() == static_cast<std::size_t>(elements),
          "'parts' has " + std::to_string(settings.parts.size()) + " numbers; give one for each of the " +
              std::to_string(elements) + " bulk elements");
  require(settings.strength_shares.empty() || settings.strength_shares.size() == settings.parts.size(),
          "'strength_shares' has " + std::to_string(settings.strength_shares.size()) +
              " numbers; give one for each of the " + std::to_string(elements) + " bulk elements, or none");
  for (const double share : settings.strength_shares) require_positive(share, "a strength share");

  Model model;
  model.mesh.coordinates.assign(coordinates.begin(), coordinates.end());
  model.mesh.parts = settings.parts;
  for (Index e = 0; e < elements; ++e) {
    model.mesh.types.push_back(topology.type(e));
    const std::span<const Index> nodes = topology.nodes(e);
    model.mesh.connectivity.insert(model.mesh.connectivity.end(), nodes.begin(), nodes.end());
    require(settings.parts[e] >= 0 && settings.parts[e] < static_cast<Index>(settings.law_of_part.size()),
            "element " + numbered(e) + " is of part " + numbered(settings.parts[e]) + "; there are " +
                std::to_string(settings.law_of_part.size()) + " parts, counted from " + numbered(0));
  }
  for (const CohesiveLaw& law : settings.laws) {
    check_law(law);
    model.cohesive_laws.push_back(law);
    model.cohesive_laws.back().name = std::to_string(model.cohesive_laws.size() - 1);
  }
  for (const Index law : settings.law_of_part) {
    require(law == kNone || (law >= 0 && law < static_cast<Index>(settings.laws.size())),
            "part " + numbered(model.parts.size()) + " has the cohesive law " + numbered(law) +
                "; there are " + std::to_string(settings.laws.size()) + ", counted from " + numbered(0));
    require(law == kNone || settings.laws[law].kind != CohesiveKind::bilinear,
            "part " + numbered(model.parts.size()) +
                " has a bilinear law, which stands from the start; a facet opens by another kind");
    Part part;
    part.name = std::to_string(model.parts.size());
    if (law != kNone) part.cohesive_law = std::to_string(law);
    model.mesh.part_names.push_back(part.name);
    model.parts.push_back(part);
  }
  model.stress_recovery = settings.recovery;
  model.strength_shares = settings.strength_shares;
  return model;
}

}  // namespace

struct CohesiveCriterion::Kept {
  Model model;
  Criterion criterion{model};
  std::vector<Index> law_of_element{};
  std::vector<double>
      least{};  ///< Pa2 by element: square of the stress norm below which none of its facets opens
  std::vector<Index> candidates{};
  std::vector<OpenFacet> open{};
};

CohesiveCriterion::CohesiveCriterion(const Topology& topology, std::span<const double> coordinates,
                                     const Settings& settings)
    : kept_(new Kept{model_of(topology, coordinates, settings)}) {
  Mesh& mesh = kept_->model.mesh;
  mesh.coordinates = {};
  mesh.connectivity = {};
  mesh.types = {};
  for (Index e = 0; e < topology.bulk_count(); ++e) {
    kept_->law_of_element.push_back(settings.law_of_part[settings.parts[e]]);
    const double least = (1 - 1e-9) * kept_->criterion.least_norm(e);
    kept_->least.push_back(least * least);
  }
}
CohesiveCriterion::~CohesiveCriterion() = default;
CohesiveCriterion::CohesiveCriterion(CohesiveCriterion&&) noexcept = default;
CohesiveCriterion& CohesiveCriterion::operator=(CohesiveCriterion&&) noexcept = default;

void CohesiveCriterion::find(const Topology& topology, std::span<const double> position,
                             std::span<const double> stress, std::vector<Opening>& open, int threads) {
  const auto elements = static_cast<Index>(kept_->least.size());
  require(topology.bulk_count() == elements, "the topology has " + std::to_string(topology.bulk_count()) +
                                                 " bulk elements, but the criterion was made for " +
                                                 std::to_string(elements));
  require(position.size() == 3 * static_cast<std::size_t>(topology.node_count()),
          "'position' has " + std::to_string(position.size()) + " numbers; give three for each of the " +
              std::to_string(topology.node_count()) + " nodes of the topology");
  require(stress.size() == 6 * kept_->least.size(), "'stress' has " + std::to_string(stress.size()) +
                                                        " numbers; give six for each of the " +
                                                        std::to_string(elements) + " bulk elements");
  kept_->candidates.clear();
  for (Index e = 0; e < elements; ++e) {
    const double* s = &stress[6 * static_cast<std::size_t>(e)];
    const double square =
        s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
    if (square < kept_->least[e]) continue;
    require(std::isfinite(square), "the stress of element " + numbered(e) +
                                       " is not finite; the state is lost: take a smaller step");
    if (kept_->law_of_element[e] != kNone) kept_->candidates.push_back(e);
  }
  open.clear();
  if (kept_->candidates.empty()) return;
  kept_->criterion.find(
      kept_->candidates, {}, topology, position,
      [&](Index e) {
        const double* s = &stress[6 * static_cast<std::size_t>(e)];
        return Mat3{{Vec3{s[0], s[3], s[5]}, Vec3{s[3], s[1], s[4]}, Vec3{s[5], s[4], s[2]}}};
      },
      kept_->open, Threads(threads));
  for (const OpenFacet& facet : kept_->open) {
    Opening opening;
    opening.lower = facet.lower;
    opening.law = kept_->law_of_element[facet.lower.element];
    facet.traction.store(opening.traction.data());
    open.push_back(opening);
  }
}

}  // namespace cdfp
