// The kernels, compiled once for each instruction set: the including file sets CDFP_ISA and CDFP_KERNELS.
// Only headers whose functions live in namespace CDFP_ISA, or that hold none, may be included here.
#include "element/full_integration.hpp"
#include "element/kernels.hpp"
#include "element/one_point.hpp"
#include "material/elastic.hpp"
#include "material/rate_dependent.hpp"

namespace cdfp {

namespace CDFP_ISA {

CDFP_INLINE void gather_corners(const BlockInput& block, int first, Pack (&x)[8][3]) {
  for (int corner = 0; corner < 8; ++corner) {
    gather3(block.position, block.offsets + corner * kLanes + first, x[corner]);
  }
}

template <class Formulation, class Law>
std::uint64_t add_force(const BlockInput& block, double* force) {
  const PartConstants part = *block.part;
  const StepConstants step = block.step;
  std::uint64_t critical = 0;
  for (int first = 0; first < block.count; first += kWidth) {
    Pack x[8][3], f[8][3];
    gather_corners(block, first, x);
    double* state = Law::kState ? &block.state->value[first] : nullptr;
    const Pack norm = Formulation::force(
        part, &block.constants->value[first], x, f, [&](const Symmetric<Pack>& strain, int point) {
          return Law::advance(part.material, step, strain, state + point * Law::kState * kLanes);
        });
    critical |= lanes_at_least(norm, Pack(part.critical_norm_squared)) << first;
    const int left = block.count - first;
    const int lanes = left < kWidth ? left : kWidth;
    for (int corner = 0; corner < 8; ++corner) {
      scatter_subtract3(force, block.offsets + corner * kLanes + first, lanes, f[corner]);
    }
  }
  return critical;
}

template <class Formulation, class Law>
BlockEnergy energy(const BlockInput& block) {
  const PartConstants part = *block.part;
  BlockEnergy sum;
  for (int first = 0; first < block.count; first += kWidth) {
    Pack x[8][3];
    gather_corners(block, first, x);
    const double* constants = &block.constants->value[first];
    const double* state = Law::kState ? &block.state->value[first] : nullptr;
    Pack strain_energy, hourglass_energy, dissipated(0.0);
    Formulation::energy(part, constants, x, strain_energy, hourglass_energy,
                        [&](const Symmetric<Pack>& strain, int point) {
                          return Law::energy(part.material, strain, state + point * Law::kState * kLanes);
                        });
    for (int point = 0; point < Formulation::kPoints; ++point) {
      dissipated += Formulation::template volume<Pack>(constants, point) *
                    Law::template dissipated<Pack>(state + point * Law::kState * kLanes);
    }
    for (int lane = 0; lane < kWidth && first + lane < block.count; ++lane) {
      sum.strain += strain_energy[lane];
      sum.hourglass += hourglass_energy[lane];
      sum.dissipated += dissipated[lane];
    }
  }
  return sum;
}

/// A stretch U raises what the undeformed element has by at most its greatest square, <= 1 + 2 |E|; a stress
/// adds at most its norm times `geometric`; hourglass amplitudes mix the two by their share of strain h.
template <class Formulation, class Law>
void step_bound(const BlockInput& block, const Lanes* terms, double* omega_squared) {
  const PartConstants part = *block.part;
  for (int first = 0; first < block.count; first += kWidth) {
    Pack x[8][3];
    gather_corners(block, first, x);
    const double* state = Law::kState ? &block.state->value[first] : nullptr;
    Pack strain_square, stress_square, hourglass_square, ratio(1.0);
    const auto at = [&](int point) { return state + point * Law::kState * kLanes; };
    Formulation::extremes(&block.constants->value[first], x, strain_square, stress_square, hourglass_square,
                          [&](const Symmetric<Pack>& strain, int point) {
                            return Law::stress(part.material, strain, at(point));
                          });
    for (int point = 0; point < Formulation::kPoints; ++point) {
      ratio = max(ratio, Law::template stiffness_ratio<Pack>(part.material, at(point)));
    }
    const Pack reference_material = load<Pack>(&terms[0].value[first]);
    const Pack reference_hourglass = load<Pack>(&terms[1].value[first]);
    const Pack coupling = load<Pack>(&terms[2].value[first]), geometric = load<Pack>(&terms[3].value[first]);
    const Pack stretch = Pack(1.0) + Pack(2.0) * square_root(strain_square);
    const Pack material = reference_material * ratio * stretch + geometric * square_root(stress_square);
    const Pack hourglass = reference_hourglass * stretch;
    const Pack h = square_root(hourglass_square * geometric * Pack(part.density / 64));
    const Pack bound = max(material, hourglass) + coupling * square_root(material * hourglass) +
                       hourglass * h * (Pack(4.0) + h);
    store(omega_squared + first, bound);
  }
}

template <class Formulation, class Law>
constexpr BlockKernel kernel() {
  return {Formulation::kConstants, Formulation::kPoints * Law::kState, &add_force<Formulation, Law>,
          &energy<Formulation, Law>, &step_bound<Formulation, Law>};
}

}  // namespace CDFP_ISA

const Kernels CDFP_KERNELS{
    CDFP_KERNELS_NAME,
    {{CDFP_ISA::kernel<CDFP_ISA::OnePoint<CDFP_ISA::Prism>, CDFP_ISA::Elastic>(),
      CDFP_ISA::kernel<CDFP_ISA::OnePoint<CDFP_ISA::Prism>, CDFP_ISA::RateDependent>(),
      CDFP_ISA::kernel<CDFP_ISA::OnePoint<CDFP_ISA::Hexahedron>, CDFP_ISA::Elastic>(),
      CDFP_ISA::kernel<CDFP_ISA::OnePoint<CDFP_ISA::Hexahedron>, CDFP_ISA::RateDependent>(),
      CDFP_ISA::kernel<CDFP_ISA::FullIntegration, CDFP_ISA::Elastic>(),
      CDFP_ISA::kernel<CDFP_ISA::FullIntegration, CDFP_ISA::RateDependent>()}}};

}  // namespace cdfp
