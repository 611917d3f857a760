#include "sample_run.hpp"

#include <algorithm>
#include <cmath>

namespace cdfp::sample {
namespace {

constexpr double pi = 3.141592653589793;
const std::vector<std::string> part_names = {"lower_glass", "pvb", "upper_glass", "impactor"};

/// A number in [0, 1) that depends on the arguments alone.
double noise(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  std::uint64_t x = a * 0x9e3779b97f4a7c15ULL + b * 0xc2b2ae3d27d4eb4fULL + c * 0x165667b19e3779f9ULL;
  x ^= x >> 29;
  x *= 0xbf58476d1ce4e5b9ULL;
  x ^= x >> 32;
  return static_cast<double>(x % 1000003) / 1000003;
}

struct Plate {
  Run run;
  int levels() const { return 2 * run.layers + 1; }
  std::size_t column(int ray, int ring) const {
    return static_cast<std::size_t>(ray * (run.rings + 1) + ring);
  }
  std::size_t columns() const { return static_cast<std::size_t>((run.rays + 1) * (run.rings + 1)); }
  Index node(int ray, int ring, int level) const {
    return static_cast<Index>(static_cast<std::size_t>(level) * columns() + column(ray, ring));
  }
  int part_of(int level) const { return level < run.layers ? 0 : level == run.layers ? 1 : 2; }
  int layer_of(int level) const {
    return level < run.layers ? level : level == run.layers ? 0 : level - run.layers - 1;
  }

  /// Circles near the centre that turn into the square rim.
  void place(int ray, int ring, int level, double* x) const {
    const double angle = 0.5 * pi * ray / run.rays, share = std::pow(double(ring) / run.rings, 1.3);
    const double square = 1 / std::max(std::cos(angle), std::sin(angle));
    const double radius = run.half_width * (0.02 + 0.98 * share) * (1 + (square - 1) * share * share);
    const bool inner = ray > 0 && ray < run.rays && ring > 0 && ring < run.rings;
    const double wiggle = inner ? 0.25 * run.half_width / run.rings : 0;
    x[0] = ray == run.rays ? 0 : radius * std::cos(angle) + wiggle * (noise(ray, ring, 1) - 0.5);
    x[1] = ray == 0 ? 0 : radius * std::sin(angle) + wiggle * (noise(ray, ring, 2) - 0.5);
    x[2] = run.layer_height * (level - levels());
  }
};

void end_element(State& state, Index part) {
  state.first_corner.push_back(static_cast<Index>(state.connectivity.size()));
  state.parts.push_back(part);
}

void add_impactor(State& state) {
  const double size = 4e-3;
  const Index first = static_cast<Index>(state.positions.size() / 3);
  for (int corner = 0; corner < 8; ++corner) {
    const bool x = (corner & 3) == 1 || (corner & 3) == 2, y = (corner & 3) >= 2;
    const double at[3] = {x ? size : 0, y ? size : 0, corner >= 4 ? 2 * size : 0.1e-3 * (x || y)};
    state.positions.insert(state.positions.end(), at, at + 3);
    state.connectivity.push_back(first + corner);
  }
  end_element(state, 3);
  const double tip[3] = {0, 0, 3 * size};
  state.positions.insert(state.positions.end(), tip, tip + 3);
  for (const Index corner : {4, 5, 7, 8}) state.connectivity.push_back(first + corner);
  end_element(state, 3);
}

/// Splits by a face between two columns of nodes through one level; the lower side gets nodes of its own.
void crack(State& state, const Plate& plate, int ray_a, int ring_a, int ray_b, int ring_b, int level,
           double damage, double time) {
  CrackFacet facet;
  facet.upper = {plate.node(ray_a, ring_a, level), plate.node(ray_b, ring_b, level),
                 plate.node(ray_b, ring_b, level + 1), plate.node(ray_a, ring_a, level + 1)};
  for (std::size_t c = 0; c < 4; ++c) {
    facet.lower[c] = static_cast<Index>(state.positions.size() / 3);
    for (std::size_t i = 0; i < 3; ++i)
      state.positions.push_back(state.positions[3 * static_cast<std::size_t>(facet.upper[c]) + i]);
  }
  facet.part = plate.part_of(level);
  facet.layer = plate.layer_of(level);
  facet.damage = damage;
  facet.insertion_time = time;
  if (damage >= 1) facet.broken_time = time + 1e-6;
  state.frame.cracks.push_back(facet);
}

/// Damage of a face at radius r (m) whose front passes at `front` (m): broken well behind, a haze ahead.
double damage_behind(double behind, double chance) {
  if (behind > 4e-3) return 1;
  return behind > 0 ? 0.3 + 0.7 * behind / 4e-3 * chance : 0;
}

void add_cracks(State& state, const Plate& plate, double time) {
  const Run& run = plate.run;
  const double front = std::min(1.2 * run.half_width, 1500 * std::max(0.0, time - 15e-6));
  for (int level = 0; level < plate.levels(); ++level) {
    if (plate.part_of(level) == 1) continue;
    const double delay = plate.part_of(level) == 0 ? 6e-3 : 0;
    for (int ray = 0; ray <= run.rays; ++ray)
      for (int ring = 0; ring < run.rings; ++ring) {
        const double share = std::pow((ring + 0.5) / run.rings, 1.3), radius = share * run.half_width;
        const double chance = noise(ray, ring, 10 + level);
        const bool radial = noise(ray, 0, 3) < 0.2 + 0.2 * share && ray > 0 && ray < run.rays;
        const bool haze = chance < 0.2 && radius < front && ray > 0 && ray < run.rays;
        const double done = radial ? damage_behind(front - delay - radius, chance) : 0;
        if (done > 0 || haze)
          crack(state, plate, ray, ring, ray, ring + 1, level, done > 0 ? done : 0.3 * chance, radius / 1500);
        const bool circle = ring > 0 && ray < run.rays && ring % 6 == 5 && chance < 0.85;
        const double back = front - delay - radius - 25e-3;
        if (circle && back > 0)
          crack(state, plate, ray, ring, ray + 1, ring, level, damage_behind(back, chance), radius / 1500);
      }
  }
}

}  // namespace

State state(const Run& run, double time) {
  const Plate plate{run};
  State state;
  for (int level = 0; level <= plate.levels(); ++level)
    for (int ray = 0; ray <= run.rays; ++ray)
      for (int ring = 0; ring <= run.rings; ++ring) {
        double x[3];
        plate.place(ray, ring, level, x);
        state.positions.insert(state.positions.end(), x, x + 3);
      }
  for (int level = 0; level < plate.levels(); ++level)
    for (int ray = 0; ray < run.rays; ++ray)
      for (int ring = 0; ring < run.rings; ++ring) {
        for (int up = 0; up < 2; ++up)
          for (const auto& [b, a] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
            state.connectivity.push_back(plate.node(ray + a, ring + b, level + up));
        end_element(state, plate.part_of(level));
      }
  add_impactor(state);
  add_cracks(state, plate, time);
  state.reference = state.positions;
  // Bending, so that the state differs from the undeformed one.
  for (std::size_t node = 0; node < state.positions.size() / 3; ++node) {
    double* x = &state.positions[3 * node];
    const double depth = 2 * time * std::exp(-std::hypot(x[0], x[1]) / 20e-3);
    x[2] -= depth;
    for (const double v : {0.0, 0.0, -depth / std::max(time, 1e-9)}) state.velocities.push_back(v);
  }
  Frame& frame = state.frame;
  frame.time = time;
  frame.step = std::llround(time / 6e-8);
  frame.reference = state.reference;
  frame.positions = state.positions;
  frame.velocities = state.velocities;
  frame.connectivity = state.connectivity;
  frame.first_corner = state.first_corner;
  frame.parts = state.parts;
  for (std::size_t e = 0; e < state.parts.size(); ++e) {
    frame.von_mises.push_back(60e6 * noise(e, 1, 7));
    frame.max_principal.push_back(60e6 * noise(e, 2, 7));
  }
  frame.part_names = part_names;
  frame.symmetry_planes = {{0, 0.0}, {1, 0.0}};
  return state;
}

History history(int rows, double end_time) {
  History history;
  history.columns = {"time_s",
                     "step",
                     "dt_s",
                     "kinetic_j",
                     "strain_j",
                     "hourglass_j",
                     "material_dissipated_j",
                     "cohesive_stored_j",
                     "cohesive_dissipated_j",
                     "cohesive_friction_j",
                     "contact_stored_j",
                     "contact_friction_j",
                     "external_work_j",
                     "energy_balance",
                     "cohesive_inserted",
                     "cohesive_broken",
                     "impactor_force_z_n",
                     "impactor_velocity_z_mps",
                     "impactor_position_z_m"};
  for (int row = 0; row < rows; ++row) {
    const double t = end_time * row / std::max(1, rows - 1), s = t / 600e-6;
    const double ring = std::exp(-6 * s) * std::cos(2 * pi * t / 23e-6);
    const double force = s > 0 ? 2300 * std::pow(s * 25, 1.5) * std::exp(-s * 9) * (1 + 0.35 * ring) / 30 : 0;
    const double fracture = 0.035 * (1 - std::exp(-5 * s)),
                 strain = 0.09 * s * 6 * std::exp(-4 * s) * (1 + 0.2 * ring);
    const double hourglass = 0.02 * strain, damped = 0.012 * s, friction = 0.006 * s * s,
                 contact = 0.003 * std::exp(-3 * s) * s;
    const double kinetic = 0.204 - fracture - strain - hourglass - damped - friction - contact;
    const double balance = 1 + 0.004 * s * std::sin(30 * s);
    const double values[] = {t,         double(row) * 20, 6e-8,  kinetic,       strain,   hourglass, damped,
                             0.001 * s, fracture,         0,     contact,       friction, 0,         balance,
                             5000 * s,  2000 * s,         force, -6.78 + 9 * s, -1e-3 * s};
    history.values.insert(history.values.end(), std::begin(values), std::end(values));
  }
  return history;
}

Summary summary() {
  Summary summary;
  summary.title = "sample";
  summary.elements = 47088;
  summary.steps = 10000;
  summary.threads = 2;
  summary.first_contact_s = 1e-6;
  summary.first_cracks = {{"lower_glass", 30.2e-6, 0, "lower face (layer 1 of 5)", {0, 0, -5.76e-3}},
                          {"upper_glass", 20.4e-6, 0, "lower face (layer 1 of 3)", {0, 0, -2.5e-3}}};
  summary.peak_force_n = 1500;
  summary.peak_force_time_s = 85e-6;
  summary.stages = {{"internal_force", 12.5, 10000}, {"traction", 1.25, 10000}};
  summary.warnings = {"fixed step above the limit of element 7"};
  return summary;
}

}  // namespace cdfp::sample
