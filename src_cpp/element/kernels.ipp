// The kernels, compiled once for each instruction set: the including file sets CDFP_ISA and CDFP_KERNELS.
// Only headers whose functions live in namespace CDFP_ISA, or that hold none, may be included here.
#include <cstddef>
#include <cstring>

#include "element/full_integration.hpp"
#include "element/kernels.hpp"
#include "element/one_point.hpp"
#include "element/tetrahedron.hpp"
#include "element/wedge.hpp"
#include "material/elastic.hpp"
#include "material/polar.hpp"
#include "material/rate_dependent.hpp"
#include "material/stored.hpp"

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
  alignas(Lanes) double of_element[3][kBlock];
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
    store(of_element[0] + first, strain_energy);
    store(of_element[1] + first, hourglass_energy);
    store(of_element[2] + first, dissipated);
  }
  BlockEnergy sum;
  for (int l = 0; l < block.count; ++l) {
    sum.strain += of_element[0][l];
    sum.hourglass += of_element[1][l];
    sum.dissipated += of_element[2][l];
  }
  return sum;
}

/// A stretch U raises what the undeformed element has by at most its greatest square, <= 1 + 2 |E|; a stress
/// adds at most its norm times `geometric`; hourglass amplitudes mix the two by their share of strain h.
template <class Formulation, class Law>
void step_bound(const BlockInput& block, const SingleLanes* terms, double* omega_squared) {
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
    const float* term = &terms[4 * (first / kLanes)].value[first % kLanes];
    const Pack reference_material = load_single(term), reference_hourglass = load_single(term + kLanes);
    const Pack coupling = load_single(term + 2 * kLanes), geometric = load_single(term + 3 * kLanes);
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

/// Some lanes of arrays of `count` points that need not be aligned.
struct SomePoints {
  std::ptrdiff_t count, first;
  std::size_t bytes;

  SomePoints(int points, int start)
      : count(points),
        first(start),
        bytes(sizeof(double) * static_cast<std::size_t>(points - start < kWidth ? points - start : kWidth)) {}
  CDFP_INLINE Pack load(const double* array, int component) const {
    Pack a(1.0);
    const double* from = array + component * count + first;
    if (bytes == sizeof a) [[likely]] {
      std::memcpy(&a, from, sizeof a);
    } else {
      std::memcpy(&a, from, bytes);
    }
    return a;
  }
  CDFP_INLINE void store(double* array, int component, Pack a) const {
    double* to = array + component * count + first;
    if (bytes == sizeof a) [[likely]] {
      std::memcpy(to, &a, sizeof a);
    } else {
      std::memcpy(to, &a, bytes);
    }
  }
  /// In the order 11 22 33 12 23 31.
  CDFP_INLINE Symmetric<Pack> load_symmetric(const double* array) const {
    return {load(array, 0), load(array, 1), load(array, 2), load(array, 3), load(array, 4), load(array, 5)};
  }
  CDFP_INLINE void store_symmetric(double* array, const Symmetric<Pack>& a) const {
    store(array, 0, a.xx), store(array, 1, a.yy), store(array, 2, a.zz);
    store(array, 3, a.xy), store(array, 4, a.yz), store(array, 5, a.xz);
  }
  /// In the order 11 22 33 12 23 31 21 32 13.
  CDFP_INLINE void store_full(double* array, const Pack (&a)[3][3]) const {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      store(array, i, a[i][i]), store(array, 3 + i, a[i][j]), store(array, 6 + i, a[j][i]);
    }
  }
};

CDFP_INLINE void load_frame(const Lanes* frames, int first, Pack (&q)[3][3]) {
  const double* lane = &frames[first / kLanes * 9].value[first % kLanes];
  for (int i = 0; i < 9; ++i) q[i / 3][i % 3] = load<Pack>(lane + i * kLanes);
}

/// Where a formulation's strain is not that of its F (full integration), F is changed to fit it: U becomes
/// the root of I + 2 Ebar, R stays.
template <class Formulation>
void deform(const BlockInput& block, const Lanes* frames, const UserPointArrays* points) {
  const Pack density(block.part->density);
  for (int first = 0; first < block.count; first += kWidth) {
    const PackOfBlock<Formulation, Stored> pack(block, first);
    const SomePoints some(block.count, first);
    Pack x[Formulation::kCorners][3], q[3][3];
    pack.gather(block.position, x);
    load_frame(frames, first, q);
    Formulation::each_point(
        pack.constants, x, [&](const Pack(&grad)[3][3], const Symmetric<Pack>& strain, int p) {
          const UserPointArrays& out = points[p];
          Pack f[3][3], r[3][3];
          for (int d = 0; d < 3; ++d) {
            for (int j = 0; j < 3; ++j)
              f[d][j] = grad[0][d] * q[0][j] + grad[1][d] * q[1][j] + grad[2][d] * q[2][j];
          }
          Pack volume_ratio = determinant_of(f);
          rotation_of(f, r);
          Symmetric<Pack> stretch = stretch_of(r, f);
          if constexpr (Formulation::kPoints > 1) {
            Pack back[3][3];
            for (int i = 0; i < 3; ++i) {
              for (int j = 0; j < 3; ++j) back[i][j] = q[j][i];
            }
            const Pack two(2.0), one(1.0);
            const Symmetric<Pack> e = turned(back, strain);
            stretch = root_of(Symmetric<Pack>{one + two * e.xx, one + two * e.yy, one + two * e.zz,
                                              two * e.xy, two * e.yz, two * e.xz});
            const Pack inverted = min(volume_ratio, Pack(0.0));  // the root does not show it
            volume_ratio = determinant_of(stretch) + Pack(1e300) * inverted;
            Pack u[3][3];
            full_of(stretch, u);
            for (int d = 0; d < 3; ++d) {
              for (int j = 0; j < 3; ++j) f[d][j] = r[d][0] * u[0][j] + r[d][1] * u[1][j] + r[d][2] * u[2][j];
            }
          }
          const Symmetric<Pack> before = some.load_symmetric(out.stretch_old);
          Pack rate[3][3];
          product_of(stretch - before, inverse_of(Pack(0.5) * (stretch + before)), rate);
          const Pack half(0.5);
          some.store_symmetric(out.stretch, stretch);
          some.store_full(out.gradient, f);
          some.store_full(out.rotation, r);
          some.store(out.density, 0, density / volume_ratio);
          for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            some.store(out.strain_increment, i, rate[i][i]);
            some.store(out.strain_increment, 3 + i, half * (rate[i][j] + rate[j][i]));
            some.store(out.spin_increment, i, half * (rate[j][i] - rate[i][j]));
          }
        });
  }
}

/// S = J U^-1 s U^-1 of the corotated stress s, in the element's axes. The work of a step is
/// (S_old + S_new) / 2 : (E_new - E_old), as of the forces at its two ends.
template <class Formulation>
void take_stress(const BlockInput& block, const Lanes* frames, const UserPointArrays* points, Lanes* state) {
  const PartConstants part = *block.part;
  const Pack plane_wave(part.material.lambda + 2 * part.material.mu);
  for (int first = 0; first < block.count; first += kWidth) {
    const PackOfBlock<Formulation, Stored> pack(block, first);
    const SomePoints some(block.count, first);
    Pack q[3][3];
    load_frame(frames, first, q);
    for (int p = 0; p < Formulation::kPoints; ++p) {
      const UserPointArrays& in = points[p];
      double* here = pack.point(reinterpret_cast<double*>(state), p);
      const auto strain = [](const Symmetric<Pack>& u) {
        Pack square[3][3];
        product_of(u, u, square);
        const Pack half(0.5);
        return half * Symmetric<Pack>{square[0][0], square[1][1], square[2][2],
                                      square[0][1], square[1][2], square[0][2]};
      };
      const Symmetric<Pack> stretch = some.load_symmetric(in.stretch);
      const Symmetric<Pack> change = strain(stretch) - strain(some.load_symmetric(in.stretch_old));
      const Symmetric<Pack> inverse = inverse_of(stretch);
      Pack to_reference[3][3];
      full_of(inverse, to_reference);
      const Symmetric<Pack> s =
          turned(q, determinant_of(stretch) * turned(to_reference, some.load_symmetric(in.stress)));
      const Symmetric<Pack> before = load_symmetric<Pack>(here + Stored::kStress * kLanes, kLanes);
      const Pack work = Pack(0.5) * double_dot(s + before, turned(q, change));
      double* energy = here + Stored::kWork * kLanes;
      store(energy, load<Pack>(energy) + work);
      store(here + Stored::kDissipated * kLanes, Pack(part.density) * some.load(in.dissipated, 0));
      store(here + Stored::kRatio * kLanes, some.load(in.stiffness, 0) / plane_wave);
      store_symmetric(here + Stored::kStress * kLanes, kLanes, s);
    }
  }
}

template <class Formulation, class Law>
void stress(const BlockInput& block, std::uint64_t elements, Lanes* mean) {
  const PartConstants part = *block.part;
  const auto* block_state = reinterpret_cast<const double*>(block.state);
  for (int first = 0; first < block.count; first += kWidth) {
    if ((elements >> first & (~std::uint64_t{0} >> (64 - kWidth))) == 0) continue;
    const PackOfBlock<Formulation, Law> pack(block, first);
    Pack x[Formulation::kCorners][3], sum[3][3];
    pack.gather(block.position, x);
    const Pack volume =
        Formulation::kirchhoff_stress(pack.constants, x, sum, [&](const Symmetric<Pack>& strain, int point) {
          return Law::stress(part.material, strain, pack.point(block_state, point));
        });
    double* out = &mean[6 * (first / kLanes)].value[first % kLanes];
    for (int i = 0; i < 3; ++i) {
      store(out + i * kLanes, sum[i][i] / volume);
      store(out + (3 + i) * kLanes, sum[i == 2 ? 0 : i][i == 0 ? 1 : 2] / volume);
    }
  }
}

template <class Formulation, class Law>
constexpr BlockKernel kernel() {
  BlockKernel k;
  k.corners = Formulation::kCorners;
  k.constants = Formulation::kConstants;
  k.state = Formulation::kPoints * Law::kState;
  k.add_force = &add_force<Formulation, Law>;
  k.energy = &energy<Formulation, Law>;
  k.step_bound = &step_bound<Formulation, Law>;
  k.stress = &stress<Formulation, Law>;
  return k;
}

template <class Formulation>
constexpr BlockKernel stored_kernel() {
  BlockKernel k = kernel<Formulation, Stored>();
  k.points = Formulation::kPoints;
  k.deform = &deform<Formulation>;
  k.take_stress = &take_stress<Formulation>;
  return k;
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
      CDFP_ISA::kernel<CDFP_ISA::Tetrahedron, CDFP_ISA::RateDependent>(),
      CDFP_ISA::stored_kernel<CDFP_ISA::OnePoint<CDFP_ISA::Prism>>(),
      CDFP_ISA::stored_kernel<CDFP_ISA::OnePoint<CDFP_ISA::Hexahedron>>(),
      CDFP_ISA::stored_kernel<CDFP_ISA::FullIntegration<CDFP_ISA::PrismPoints>>(),
      CDFP_ISA::stored_kernel<CDFP_ISA::FullIntegration<CDFP_ISA::HexahedronPoints>>(),
      CDFP_ISA::stored_kernel<CDFP_ISA::Tetrahedron>(),
      CDFP_ISA::kernel<CDFP_ISA::Wedge, CDFP_ISA::Elastic>(),
      CDFP_ISA::kernel<CDFP_ISA::Wedge, CDFP_ISA::RateDependent>(),
      CDFP_ISA::stored_kernel<CDFP_ISA::Wedge>()}}};

}  // namespace cdfp
