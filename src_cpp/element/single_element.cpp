#include "element/single_element.hpp"

#include <type_traits>

#include "element/full_integration.hpp"
#include "element/one_point.hpp"
#include "element/tetrahedron.hpp"
#include "element/wedge.hpp"
#include "element/wedge_geometry.hpp"
#include "material/elastic.hpp"
#include "material/rate_dependent.hpp"
#include "material/stored.hpp"

namespace cdfp {

namespace {

using host::Symmetric;

/// `visit<Formulation, Law>()`
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
    case BlockKind::full_prism_elastic:
      return visit.template operator()<FullIntegration<PrismPoints>, Elastic>();
    case BlockKind::full_prism_rate_dependent:
      return visit.template operator()<FullIntegration<PrismPoints>, RateDependent>();
    case BlockKind::full_elastic:
      return visit.template operator()<FullIntegration<HexahedronPoints>, Elastic>();
    case BlockKind::full_rate_dependent:
      return visit.template operator()<FullIntegration<HexahedronPoints>, RateDependent>();
    case BlockKind::tetrahedron_elastic:
      return visit.template operator()<Tetrahedron, Elastic>();
    case BlockKind::tetrahedron_rate_dependent:
      return visit.template operator()<Tetrahedron, RateDependent>();
    case BlockKind::prism_stored:
      return visit.template operator()<OnePoint<Prism>, Stored>();
    case BlockKind::hexahedron_stored:
      return visit.template operator()<OnePoint<Hexahedron>, Stored>();
    case BlockKind::full_prism_stored:
      return visit.template operator()<FullIntegration<PrismPoints>, Stored>();
    case BlockKind::full_stored:
      return visit.template operator()<FullIntegration<HexahedronPoints>, Stored>();
    case BlockKind::tetrahedron_stored:
      return visit.template operator()<Tetrahedron, Stored>();
    case BlockKind::wedge_elastic:
      return visit.template operator()<Wedge, Elastic>();
    case BlockKind::wedge_rate_dependent:
      return visit.template operator()<Wedge, RateDependent>();
    case BlockKind::wedge_stored:
      return visit.template operator()<Wedge, Stored>();
  }
}

/// `visit<Formulation>(constants, corners, stress_of)`
template <class Visit>
void with_stress(const BlockGroup& group, std::size_t slot, std::span<const double> position, Visit&& visit) {
  for_kind(group.kind, [&]<class Formulation, class Law>() {
    const std::size_t row = slot / kLanes, lane = slot % kLanes;
    const double* constants = &group.constants[row * Formulation::kConstants].value[lane];
    const double* state =
        Law::kState ? &group.state[row * Formulation::kPoints * Law::kState].value[lane] : nullptr;
    double x[Formulation::kCorners][3];
    for (int corner = 0; corner < Formulation::kCorners; ++corner) {
      host::gather3(position.data(), group.corner_offsets(slot) + corner * kLanes, x[corner]);
    }
    visit.template operator()<Formulation>(constants, x, [&](const Symmetric<double>& strain, int point) {
      return Law::stress(group.plan.constants.material, strain, state + point * Law::kState * kLanes);
    });
  });
}

}  // namespace

Mat3 element_stress(const BlockGroup& group, std::size_t slot, std::span<const double> position) {
  Mat3 stress;
  with_stress(group, slot, position,
              [&]<class Formulation>(const double* constants, const auto& x, auto&& stress_of) {
                double sum[3][3];
                const double volume = Formulation::kirchhoff_stress(constants, x, sum, stress_of);
                for (int i = 0; i < 3; ++i) {
                  for (int j = 0; j <= i; ++j) stress(i, j) = stress(j, i) = sum[i][j] / volume;
                }
              });
  return stress;
}

void element_force(const BlockGroup& group, std::size_t slot, std::span<const double> position,
                   std::span<double> force) {
  with_stress(group, slot, position,
              [&]<class Formulation>(const double* constants, const auto& x, auto&& stress_of) {
                double f[Formulation::kCorners][3];
                Formulation::force(group.plan.constants, constants, x, f, stress_of);
                for (std::size_t i = 0; i < 3 * Formulation::kCorners; ++i) force[i] = -f[i / 3][i % 3];
              });
}

double hourglass_density(const BlockGroup& group, std::size_t slot, std::span<const double> position) {
  double density = 0;
  with_stress(group, slot, position, [&]<class Formulation>(const double* constants, const auto& x, auto&&) {
    double strain = 0, hourglass = 0, volume = 0;
    Formulation::energy(group.plan.constants, constants, x, strain, hourglass,
                        [](const Symmetric<double>&, int) { return 0.0; });
    for (int point = 0; point < Formulation::kPoints; ++point) {
      volume += Formulation::template volume<double>(constants, point);
    }
    density = hourglass / volume;
  });
  return density;
}

double corner_mass(const BlockGroup& group, std::size_t slot) {
  double volume = 0;
  for_kind(group.kind, [&]<class Formulation, class Law>() {
    const double* constants =
        &group.constants[slot / kLanes * static_cast<std::size_t>(Formulation::kConstants)]
             .value[slot % kLanes];
    if constexpr (std::is_same_v<Formulation, host::FullIntegration<host::PrismPoints>>) {
      volume = constants[host::PrismPoints::kVolume * kLanes];
    } else {
      for (int point = 0; point < Formulation::kPoints; ++point) {
        volume += Formulation::template volume<double>(constants, point);
      }
    }
  });
  return group.plan.constants.density * volume / group.corners();
}

double element_volume(const BlockGroup& group, std::size_t slot, std::span<const double> position) {
  const auto gathered = [&](auto& x) {
    for (Eigen::Index corner = 0; corner < x.rows(); ++corner) {
      x.row(corner) =
          Eigen::Map<const Eigen::RowVector3d>(&position[group.corner_offsets(slot)[corner * kLanes]]);
    }
  };
  if (group.corners() == 4) {
    TetrahedronCorners x;
    gathered(x);
    return tetrahedron_geometry(x).volume;
  }
  if (group.corners() == 6) {
    WedgeCorners x;
    gathered(x);
    return wedge_volume(x);
  }
  Corners x;
  gathered(x);
  return hexahedron_volume(x);
}

}  // namespace cdfp
