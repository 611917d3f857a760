// The kernels, compiled once for each instruction set: the including file sets CDFP_ISA and CDFP_KERNELS.
// Only headers whose functions live in namespace CDFP_ISA, or that hold none, may be included here.
#include <cstddef>

#include "element/full_integration.hpp"
#include "element/kernels.hpp"
#include "element/one_point.hpp"
#include "element/tetrahedron.hpp"
#include "material/elastic.hpp"
#include "material/rate_dependent.hpp"

namespace cdfp {

namespace CDFP_ISA {

/// A pack of a block: where its data start.
template <class Formulation, class Law>
struct PackOfBlock {
  const double* constants;
  static constexpr int kCorners = Formulation::kCorners;
  const std::int32_t* offsets;
  std::ptrdiff_t state;

  CDFP_INLINE PackOfBlock(const BlockInput& block, int first) {
    const int row = first / kLanes, lane = first % kLanes;
    constants = &block.constants[row * Formulation::kConstants].value[lane];
    offsets = block.offsets + row * kCorners * kLanes + lane;
    state = Law::kState ? row * Formulation::kPoints * Law::kState * kLanes + lane : 0;
  }
  /// Asks for the constants of the rows to come, which the hardware loses sight of at the end of each page.
  CDFP_INLINE void prefetch() const {
    constexpr int kRowsAhead = 4, kPerLine = 16;
    const double* row = constants + kRowsAhead * Formulation::kConstants * kLanes;
    for (int k = 0; k < Formulation::kConstants; ++k) __builtin_prefetch(row + k * kLanes);
    const std::int32_t* corners = offsets + kRowsAhead * kCorners * kLanes;
    for (int k = 0; k < kCorners * kLanes; k += kPerLine) __builtin_prefetch(corners + k);
  }
  /// Asks for every other corner's position and force two rows on: nodes of a large mesh lie far apart, and
  /// the rest are corners of neighbours. (Rows past the end repeat the last one's memory at worst.)
  CDFP_INLINE void prefetch_nodes(const double* position, const double* force, int rows_left) const {
    constexpr int kRowsAhead = 2;
    if (rows_left <= kRowsAhead) return;
    const std::int32_t* corners = offsets + kRowsAhead * kCorners * kLanes;
    for (int corner = 0; corner < kCorners; corner += 2) {
      for (int lane = 0; lane < kLanes; ++lane) {
        __builtin_prefetch(position + corners[corner * kLanes + lane]);
        __builtin_prefetch(force + corners[corner * kLanes + lane], 1);
      }
    }
  }
  CDFP_INLINE void gather(const double* position, Pack (&x)[kCorners][3]) const {
    for (int corner = 0; corner < kCorners; ++corner) gather3(position, offsets + corner * kLanes, x[corner]);
  }
  /// State of a point in the block's `first`.
  template <class Double>
  CDFP_INLINE Double* point(Double* first, int p) const {
    return first + (state + p * Law::kState * kLanes);
  }
};

template <class Formulation, class Law>
std::uint64_t add_force(const BlockInput& block, const StepConstants& step, Lanes* state, double* force) {
  const PartConstants part = *block.part;
  double* block_state = reinterpret_cast<double*>(state);
  std::uint64_t critical = 0;
  for (int first = 0; first < block.count; first += kWidth) {
    const PackOfBlock<Formulation, Law> pack(block, first);
    if (first % kLanes == 0) {
      pack.prefetch();
      pack.prefetch_nodes(block.position, force, (block.count - first) / kLanes);
    }
    Pack x[Formulation::kCorners][3], f[Formulation::kCorners][3];
    pack.gather(block.position, x);
    const Pack norm =
        Formulation::force(part, pack.constants, x, f, [&](const Symmetric<Pack>& strain, int point) {
          double* here = pack.point(block_state, point);
          for (int k = 0; k < Law::kState; ++k) {  // of the same point in the next row
            __builtin_prefetch(here + (Formulation::kPoints * Law::kState + k) * kLanes, 1);
          }
          return Law::advance(part.material, step, strain, here);
        });
    critical |= lanes_at_least(norm, Pack(part.critical_norm_squared)) << first;
    const int left = block.count - first;
    const int lanes = left < kWidth ? left : kWidth;
    for (int corner = 0; corner < Formulation::kCorners; ++corner) {
      scatter_subtract3(force, pack.offsets + corner * kLanes, lanes, f[corner]);
    }
  }
  return critical & (~std::uint64_t{0} >> (kBlock - block.count));  // not of idle lanes
}

template <class Formulation, class Law>
BlockEnergy energy(const BlockInput& block) {
  const PartConstants part = *block.part;
  const auto* block_state = reinterpret_cast<const double*>(block.state);
  BlockEnergy sum;
  for (int first = 0; first < block.count; first += kWidth) {
    const PackOfBlock<Formulation, Law> pack(block, first);
    Pack x[Formulation::kCorners][3];
    pack.gather(block.position, x);
    Pack strain_energy, hourglass_energy, dissipated(0.0);
    Formulation::energy(part, pack.constants, x, strain_energy, hourglass_energy,
                        [&](const Symmetric<Pack>& strain, int point) {
                          return Law::energy(part.material, strain, pack.point(block_state, point));
                        });
    for (int point = 0; point < Formulation::kPoints; ++point) {
      dissipated += Formulation::template volume<Pack>(pack.constants, point) *
                    Law::template dissipated<Pack>(pack.point(block_state, point));
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
  const auto* block_state = reinterpret_cast<const double*>(block.state);
  for (int first = 0; first < block.count; first += kWidth) {
    const PackOfBlock<Formulation, Law> pack(block, first);
    Pack x[Formulation::kCorners][3];
    pack.gather(block.position, x);
    Pack strain_square, stress_square, hourglass_square, ratio(1.0);
    Formulation::extremes(pack.constants, x, strain_square, stress_square, hourglass_square,
                          [&](const Symmetric<Pack>& strain, int point) {
                            return Law::stress(part.material, strain, pack.point(block_state, point));
                          });
    for (int point = 0; point < Formulation::kPoints; ++point) {
      ratio = max(ratio, Law::template stiffness_ratio<Pack>(part.material, pack.point(block_state, point)));
    }
    const double* term = &terms[4 * (first / kLanes)].value[first % kLanes];
    const Pack reference_material = load<Pack>(term), reference_hourglass = load<Pack>(term + kLanes);
    const Pack coupling = load<Pack>(term + 2 * kLanes), geometric = load<Pack>(term + 3 * kLanes);
    const Pack stretch = Pack(1.0) + Pack(2.0) * square_root(strain_square);
    const Pack material = reference_material * ratio * stretch + geometric * square_root(stress_square);
    const Pack hourglass =
        reference_hourglass * (Formulation::kHourglassFollowsLaw ? ratio : Pack(1.0)) * stretch;
    const Pack h = square_root(hourglass_square * geometric * Pack(part.density / 64));
    const Pack bound = max(material, hourglass) + coupling * square_root(material * hourglass) +
                       hourglass * h * (Pack(4.0) + h);
    store(omega_squared + first, bound);
  }
}

template <class Formulation, class Law>
constexpr BlockKernel kernel() {
  return {Formulation::kCorners,        Formulation::kConstants,   Formulation::kPoints * Law::kState,
          &add_force<Formulation, Law>, &energy<Formulation, Law>, &step_bound<Formulation, Law>};
}

}  // namespace CDFP_ISA

const Kernels CDFP_KERNELS{
    CDFP_KERNELS_NAME,
    {{CDFP_ISA::kernel<CDFP_ISA::OnePoint<CDFP_ISA::Prism>, CDFP_ISA::Elastic>(),
      CDFP_ISA::kernel<CDFP_ISA::OnePoint<CDFP_ISA::Prism>, CDFP_ISA::RateDependent>(),
      CDFP_ISA::kernel<CDFP_ISA::OnePoint<CDFP_ISA::Hexahedron>, CDFP_ISA::Elastic>(),
      CDFP_ISA::kernel<CDFP_ISA::OnePoint<CDFP_ISA::Hexahedron>, CDFP_ISA::RateDependent>(),
      CDFP_ISA::kernel<CDFP_ISA::FullIntegration<CDFP_ISA::PrismPoints>, CDFP_ISA::Elastic>(),
      CDFP_ISA::kernel<CDFP_ISA::FullIntegration<CDFP_ISA::PrismPoints>, CDFP_ISA::RateDependent>(),
      CDFP_ISA::kernel<CDFP_ISA::FullIntegration<CDFP_ISA::HexahedronPoints>, CDFP_ISA::Elastic>(),
      CDFP_ISA::kernel<CDFP_ISA::FullIntegration<CDFP_ISA::HexahedronPoints>, CDFP_ISA::RateDependent>(),
      CDFP_ISA::kernel<CDFP_ISA::Tetrahedron, CDFP_ISA::Elastic>(),
      CDFP_ISA::kernel<CDFP_ISA::Tetrahedron, CDFP_ISA::RateDependent>()}}};

}  // namespace cdfp
