/// What a simulation shows of itself: frames (states in time), histories and the summary.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cdfp/types.hpp"

namespace cdfp {

/// Energies in J. `balance` = (kinetic + strain + hourglass + contact + cohesive_stored + all dissipated) /
/// (initial + external work).
struct Energies {
  double kinetic = 0;
  double strain = 0;  ///< without hourglass
  double hourglass = 0;
  double material_dissipated = 0;
  double cohesive_stored = 0;
  double cohesive_dissipated = 0;
  double cohesive_friction = 0;  ///< heat between the closed faces of cohesive elements
  double contact_stored = 0;
  double contact_friction = 0;  ///< heat
  double external_work = 0;
  double initial = 0;
  double balance() const {
    const double in = initial + external_work;
    const double all = kinetic + strain + hourglass + material_dissipated + cohesive_stored +
                       cohesive_dissipated + cohesive_friction + contact_stored + contact_friction;
    return in != 0 ? all / in : 1.0;
  }
};

/// A cohesive element as it is now.
struct CrackFacet {
  std::array<Index, 4> upper{kNone, kNone, kNone, kNone};
  std::array<Index, 4> lower{kNone, kNone, kNone, kNone};
  Index corners = 4;
  Index part = 0;
  Index layer = 0;
  double damage = 0;          ///< 0 just inserted, 1 broken: mean of its points
  double insertion_time = 0;  ///< s
  double broken_time = std::numeric_limits<double>::infinity();
};

/// A number of each element; NaN where it has none.
struct ElementField {
  std::string name;
  std::vector<double> values;
};

/// One state. The spans belong to the simulation and hold until it steps on.
struct Frame {
  double time = 0;
  std::int64_t step = 0;
  std::span<const double> reference;    ///< (nodes, 3) undeformed; copies of a split node lie where it lay
  std::span<const double> positions;    ///< (nodes, 3)
  std::span<const double> velocities;   ///< (nodes, 3)
  std::span<const Index> connectivity;  ///< corners of all elements, one element after the other
  std::span<const Index> first_corner;  ///< (elements + 1) of each element in `connectivity`, and its end
  std::span<const Index> parts;         ///< one an element
  std::vector<double> von_mises;        ///< Pa, one an element
  std::vector<double> max_principal;    ///< Pa, one an element
  /// With users' materials: their states by name (means over an element's points), the Cauchy stress
  /// (stress_xx ...), and `deleted`, 1 where a state has deleted the element.
  std::vector<ElementField> fields;
  std::vector<CrackFacet> cracks;
  std::vector<std::string> part_names;
  std::vector<std::pair<int, double>> symmetry_planes;  ///< axis and coordinate
};

/// Rows of equal length, one every few steps.
struct History {
  std::vector<std::string> columns;  ///< name_unit, such as "time_s"
  std::vector<double> values;        ///< row after row
  std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
};

struct StageSeconds {
  std::string name;
  double seconds = 0;
  std::int64_t calls = 0;
};

/// What `summary.json` holds. Times and forces that never came about are NaN (null in the file).
struct Summary {
  std::string title;
  Index elements = 0;
  Index nodes_initial = 0;
  Index nodes_final = 0;
  Index segments_initial = 0;
  Index segments_final = 0;
  std::int64_t steps = 0;
  double simulated_time_s = 0;
  double dt_s = 0;
  double dt_stable_s = 0;
  Index dt_element = kNone;
  double wall_s = 0;
  int threads = 1;
  double peak_rss_mb = 0;
  double energy_balance_min = 1;
  double energy_balance_max = 1;
  double hourglass_over_strain_max = 0;  ///< over parts, each against its own largest strain energy
  std::vector<std::pair<std::string, double>> hourglass_over_strain;  ///< each part's
  Index cohesive_inserted = 0;                                        ///< bonds included
  Index cohesive_broken = 0;
  double cohesive_dissipated_over_ga = 0;
  double cohesive_slope_cost_j = 0;  ///< |work| by which users' laws too steep for the step were bounded
  double first_contact_s = std::numeric_limits<double>::quiet_NaN();
  struct FirstCrack {
    std::string part;
    double time_s = std::numeric_limits<double>::quiet_NaN();
    Index layer = kNone;               ///< from the bottom of the part, 0 first
    std::string layer_face;            ///< such as "lower face (layer 1 of 3)"
    std::array<double, 3> position{};  ///< m, centre of the facet in the undeformed plate
  };
  std::vector<FirstCrack> first_cracks;  ///< one for each part that may crack
  double peak_force_n = 0;               ///< of the whole, symmetric copies included
  double peak_force_time_s = 0;
  double impactor_rebound_mps = std::numeric_limits<double>::quiet_NaN();
  double deepest_penetration_m = 0;
  struct ContactPair {
    std::array<std::string, 2> parts;  ///< that have touched; twice the same one: itself
    double peak_force_n = 0;           ///< on what is modelled
    double stored_j = 0;               ///< in contact springs at the end
    double friction_heat_j = 0;
    double deepest_penetration_m = 0;
  };
  std::vector<ContactPair> contact_pairs;
  struct Deleted {
    Index element = kNone;
    std::string part;
    double time_s = 0;
  };
  std::vector<Deleted> deleted;  ///< elements that users' laws deleted, in order
  std::vector<std::string> warnings;
  std::vector<StageSeconds> stages;
};

}  // namespace cdfp
