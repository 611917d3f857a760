// Two blocks under pressure are sheared until their interface has broken, and on, back and apart: friction in
// every case of eq. 31, and the hand-over from the cohesive element to the contact between free faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "cdfp/simulation.hpp"
#include "scenes.hpp"

namespace cdfp {
namespace {

constexpr double kPressure = 60e6, kStrength = 60e6, kEnergy = 1600, kKappa = 5, kEta = 1.5, kMu = 0.4;
constexpr double kReach = 2 * kKappa * kEnergy / (kEta * kStrength);  ///< 2 G_II / peak, m
constexpr double kPressed = 200e-6;                                   ///< s, from here on the pressure stands
constexpr double kSpeed = 1;
constexpr Index kColumns = 16;
constexpr double kArea = kColumns * 1e-6;

/// Columns of 1 mm along x; along z two rows of 0.5 mm below the interface at z = 0, two above, and a soft
/// pad of 4 mm that keeps the pressure whatever the faces do. Only facets at the interface can open.
Model blocks() {
  Model model;
  Mesh& mesh = model.mesh;
  const std::vector<double> z{-1e-3, -0.5e-3, 0, 0.5e-3, 1e-3, 2e-3, 3e-3, 4e-3, 5e-3};
  const auto rows = static_cast<Index>(z.size()) - 1;
  mesh.part_names = {"lower", "weak_a", "weak_b", "upper", "pad"};
  const auto node = [](Index i, Index j, Index k) { return i + (kColumns + 1) * (j + 2 * k); };
  NodeSet all{"all", {}}, bottom{"bottom", {}}, below{"below", {}}, above{"above", {}}, top{"top", {}};
  for (Index k = 0; k <= rows; ++k) {
    for (Index j = 0; j <= 1; ++j) {
      for (Index i = 0; i <= kColumns; ++i) {
        const Index n = mesh.node_count();
        mesh.coordinates.insert(mesh.coordinates.end(), {1e-3 * i, 1e-3 * j, z[k]});
        all.nodes.push_back(n);
        if (k == 0) bottom.nodes.push_back(n);
        if (k <= 1) below.nodes.push_back(n);
        if (k >= 3) above.nodes.push_back(n);
        if (k == rows) top.nodes.push_back(n);
      }
    }
  }
  FacetSet ends{"ends", {}};
  for (Index k = 0; k < rows; ++k) {
    for (Index i = 0; i < kColumns; ++i) {
      mesh.types.push_back(ElementType::hexahedron);
      mesh.parts.push_back(k == 0 ? 0 : k <= 2 ? 1 + i % 2 : k == 3 ? 3 : 4);
      for (const Index up : {k, k + 1}) {
        for (const Index n : {node(i, 0, up), node(i + 1, 0, up), node(i + 1, 1, up), node(i, 1, up)})
          mesh.connectivity.push_back(n);
      }
      if (i == 0) ends.facets.push_back({k * kColumns, 5});
    }
  }
  mesh.node_sets = {all, bottom, below, above, top};
  mesh.facet_sets = {ends};
  // Friction excites waves along the faces (Adams 1995), which grow from rounding and carry a tenth of the
  // pressure: the glass is viscous enough to damp them.
  model.materials = {{"glass", RateDependentMaterial{2500, 0, 40e9, 5e9, 0.3, 1e-7}},
                     {"rubber", ElasticMaterial{1000, 1e9, 0}}};
  CohesiveLaw law;
  law.name = "interface";
  law.strength = kStrength;
  law.fracture_energy = kEnergy;
  law.mode_ratio = kKappa;
  law.shear_ratio = kEta;
  law.friction = kMu;
  model.cohesive_laws = {law};
  for (const std::string& name : mesh.part_names) {
    Part part;
    part.name = name;
    part.material = name == "pad" ? "rubber" : "glass";
    part.formulation = Formulation::full;
    if (name.starts_with("weak")) part.cohesive_law = "interface";
    model.parts.push_back(part);
  }
  model.contact.surfaces = {"ends"};
  model.contact.friction = kMu;
  model.threads = 1;
  return model;
}

PrescribedVelocity move(const std::string& set, int direction, std::vector<double> times,
                        std::vector<double> values) {
  PrescribedVelocity v{set, {}, std::move(times), std::move(values)};
  v.directions[direction] = true;
  return v;
}

/// What the bottom and the row above it, held, feel.
struct Load {
  double shear, pressure;  ///< Pa
};
Load load_on(const Simulation& s) {
  Load load{0, 0};
  for (const Index n : s.model().mesh.node_sets[2].nodes)
    load.shear += s.forces()[3 * static_cast<std::size_t>(n)];
  for (const Index n : s.model().mesh.node_sets[1].nodes)
    load.pressure -= s.forces()[3 * static_cast<std::size_t>(n) + 2];
  return {load.shear / kArea, load.pressure / kArea};
}

/// m, mean over the corners of all cohesive elements.
double slip_of(const Simulation& s) {
  const Frame frame = s.frame();
  double sum = 0;
  int corners = 0;
  for (const CrackFacet& f : frame.cracks) {
    for (int c = 0; c < f.corners; ++c) {
      sum += frame.positions[3 * static_cast<std::size_t>(f.upper[c])] -
             frame.positions[3 * static_cast<std::size_t>(f.lower[c])];
      ++corners;
    }
  }
  return corners > 0 ? std::abs(sum) / corners : 0;
}

/// What a stretch of the run showed.
struct Stretch {
  double shear = 0, pressure = 0;  ///< Pa, means
  double least = 1e30, most = 0;   ///< Pa, of the pressure
  int count = 0;
  void add(const Load& load) {
    ++count;
    shear += (load.shear - shear) / count;
    pressure += (load.pressure - pressure) / count;
    least = std::min(least, load.pressure);
    most = std::max(most, load.pressure);
  }
  double ratio() const { return shear / pressure; }
};

TEST(Sliding, ShearUnderPressureBreaksSlidesReversesAndOpens) {
  Model model = blocks();
  const double shorter = kPressure * (4e-3 / 1e9 + 2e-3 / 74e9);  // of the pad and the blocks, m
  const double way = 1.5 * kReach, ramp = 20e-6;
  const double turns = kPressed + way / kSpeed, rests = turns + 0.4 * way / kSpeed;
  const double v = 2 * shorter / kPressed;
  model.prescribed_velocities = {
      move("all", 1, {}, {0}), move("bottom", 2, {}, {0}), move("below", 0, {}, {0}),
      move("above", 0, {kPressed, kPressed + ramp, turns - ramp, turns + ramp, rests - ramp, rests},
           {0, kSpeed, kSpeed, -kSpeed, -kSpeed, 0}),
      move("top", 2, {0, 0.5 * kPressed, kPressed, rests, rests + ramp}, {0, -v, 0, 0, 8})};
  model.time.end = rests + 200e-6;
  Simulation s(std::move(model));
  Stretch peak, softens, slides, comes_back, apart, before_break, after_break;
  double slip = 0, broken_at = 0, expected_heat = 0, misses = 0;
  while (!s.finished()) {
    s.advance(10);
    const Load load = load_on(s);
    const double last = std::exchange(slip, slip_of(s));
    const double t = s.time(), x = std::min(1.0, slip / kReach);
    if (s.cohesive_count() > 0 && t < rests)
      expected_heat += kMu * load.pressure * x * std::abs(slip - last) * kArea;
    if (s.broken_count() == 0) {
      broken_at = slip;
      if (x > 0.01 && x < 0.06) peak.add(load);
      if (x > 0.1 && x < 0.9) {
        softens.add(load);
        misses += load.shear - kEta * kStrength * (1 - x) - kMu * load.pressure * x;
      }
      if (x > 0.7) before_break.add(load);
    } else if (t < turns - ramp) {
      (slip < 1.15 * kReach ? after_break : slides).add(load);
    } else if (t > turns + 2 * ramp && t < rests - ramp) {
      comes_back.add(load);
    } else if (t > rests + 100e-6) {
      apart.add(load);
    }
  }
  const double strength = kEta * kStrength;
  EXPECT_NEAR(peak.shear, strength, 0.025 * strength);
  EXPECT_NEAR(misses / softens.count, 0, 0.01 * strength) << "cohesion and friction on the way, the mean";
  EXPECT_NEAR(broken_at, 2 * kKappa * kEnergy / peak.shear, 0.02 * kReach) << "2 G_II / peak";
  EXPECT_GT(before_break.least, 0.98 * before_break.pressure);
  EXPECT_LT(before_break.most, 1.02 * before_break.pressure);
  EXPECT_NEAR(after_break.pressure, before_break.pressure, 0.01 * before_break.pressure);
  EXPECT_GT(after_break.least, 0.94 * before_break.pressure) << "the hand-over is no jump";
  EXPECT_LT(after_break.most, 1.05 * before_break.pressure);
  EXPECT_NEAR(slides.ratio(), kMu, 0.02 * kMu) << "residual";
  EXPECT_NEAR(comes_back.ratio(), -kMu, 0.03 * kMu);
  EXPECT_NEAR(apart.shear, 0, 0.002 * kPressure);
  EXPECT_NEAR(apart.pressure, 0, 0.002 * kPressure);
  const Energies energies = s.energies();
  EXPECT_EQ(s.broken_count(), kColumns);
  EXPECT_NEAR(energies.cohesive_dissipated, kKappa * kEnergy * kArea, 1e-3 * kKappa * kEnergy * kArea);
  EXPECT_NEAR(energies.cohesive_friction + energies.contact_friction, expected_heat, 0.02 * expected_heat);
  EXPECT_GT(energies.contact_friction, 0.3 * expected_heat);
  EXPECT_NEAR(energies.balance(), 1, 1e-3);
}

}  // namespace
}  // namespace cdfp
