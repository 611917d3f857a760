// The insertion criterion against a search over all facets.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "cohesive/criterion.hpp"
#include "spring_body.hpp"

namespace cdfp {
namespace {

struct Scene {
  explicit Scene(unsigned seed) : random(seed) {
    BodySettings s;
    s.cells = {5, 4, 3};
    s.law.shear_ratio = 1.7;
    s.law.strength = 35e6;
    s.law.internal_friction = 0.4;
    model = grid_model(s);
    model.mesh.part_names = {"body", "soft", "other"};
    // A slab of a part that does not crack, and one with the same law but another name.
    for (Index e = 0; e < model.mesh.element_count(); ++e)
      model.mesh.parts[e] = e % 5 == 2 ? 1 : e % 5 > 2 ? 2 : 0;
    Part other = model.parts[0];
    other.name = "other";
    model.parts.push_back(other);
    std::uniform_real_distribution<double> pick(-1, 1);
    for (double& x : model.mesh.coordinates) x += 1e-4 * pick(random);
    for (Index e = 0; e < model.mesh.element_count(); ++e) {
      Mat3 sigma;
      for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) sigma(i, j) = sigma(j, i) = 60e6 * pick(random);
      }
      stress.push_back(sigma);
    }
  }
  Topology topology() const {
    return Topology(model.mesh.node_count(), model.mesh.types, model.mesh.connectivity);
  }
  std::mt19937 random;
  Model model;
  std::vector<Mat3> stress;
};

std::vector<OpenFacet> by_force(const Scene& scene, const Topology& topology,
                                const std::vector<Index>& candidates) {
  std::vector<OpenFacet> open;
  const auto chosen = [&](Index e) {
    return std::find(candidates.begin(), candidates.end(), e) != candidates.end();
  };
  const CohesiveLaw& law = scene.model.cohesive_laws[0];
  for (Index a = 0; a < topology.bulk_count(); ++a) {
    for (Index f = 0; f < 6; ++f) {
      const FacetUse mate = topology.mate({a, f});
      if (mate.element == kNone || mate.element >= topology.bulk_count() || mate.element < a) continue;
      if (scene.model.mesh.parts[a] != scene.model.mesh.parts[mate.element] || scene.model.mesh.parts[a] == 1)
        continue;
      if (!chosen(a) && !chosen(mate.element)) continue;
      const FacetNodes c = topology.facet_nodes({a, f});
      const auto x = [&](int i) { return Vec3::load(&scene.model.mesh.coordinates[3 * c.nodes[i]]); };
      const Vec3 n = normalized(cross(x(2) - x(0), x(3) - x(1)));
      Vec3 t;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
          t[i] += 0.5 * (scene.stress[a](i, j) + scene.stress[mate.element](i, j)) * n[j];
      }
      const double tn = dot(t, n);
      const double shear = norm(t - tn * n) / law.shear_ratio;
      const double held = law.internal_friction * std::max(0.0, -tn) / law.shear_ratio;
      const double te = tn > 0 ? std::hypot(tn, shear) : shear - held;
      if (te >= law.strength) open.push_back({{a, f}, t});
    }
  }
  return open;
}

TEST(Criterion, FindsWhatASearchOverAllFacetsFinds) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE(seed);
    Scene scene(seed);
    Topology topology = scene.topology();
    const Criterion criterion(scene.model);
    const auto stress = [&](Index e) { return scene.stress[e]; };
    std::vector<OpenFacet> open;
    std::size_t found = 0;
    for (int round = 0; round < 4; ++round) {
      std::vector<Index> candidates;
      for (Index e = 0; e < topology.bulk_count(); ++e) {
        if (round == 0 || scene.random() % 2 == 0) candidates.push_back(e);
      }
      criterion.find(candidates, topology, scene.model.mesh.coordinates, stress, open);
      const std::vector<OpenFacet> expected = by_force(scene, topology, candidates);
      ASSERT_EQ(open.size(), expected.size());
      for (std::size_t i = 0; i < open.size(); ++i) {
        EXPECT_EQ(open[i].lower, expected[i].lower);
        EXPECT_LT(norm(open[i].traction - expected[i].traction), 1e-6);
      }
      found += open.size();
      // A facet that has opened is not found again.
      if (!open.empty()) {
        Insertion report;
        topology.insert_cohesive(open[open.size() / 2].lower, report);
      }
    }
    EXPECT_GT(found, 10u);
  }
}

TEST(Criterion, MirroredFacetsCarryTheSameTraction) {
  BodySettings s;
  s.cells = {6, 4, 4};
  s.solid = true;
  s.law.strength = 10e6;
  SpringBody body(s);
  const Vec3 middle{3e-3, 2e-3, 2e-3};
  for (Index n = 0; n < body.nodes.count(); ++n) {
    const Vec3 d = body.nodes.x0(n) - middle;
    const Vec3 u{1e-3 * d.x * (1 - 0.1 * d.y * d.y / 4e-6), 4e-4 * d.y, -2e-4 * d.z};
    u.add_to(&body.nodes.position[3 * static_cast<std::size_t>(n)]);
  }
  std::vector<OpenFacet> open;
  body.criterion.find(
      body.all, body.topology, body.nodes.position, [&](Index e) { return body.stress(e); }, open);
  ASSERT_GT(open.size(), 8u);
  const auto centre = [&](const OpenFacet& f) {
    Vec3 sum;
    const auto corners = body.topology.facet_nodes(f.lower);
    for (const Index n : corners.view()) sum += body.nodes.x0(n);
    return 0.25 * sum;
  };
  for (const OpenFacet& f : open) {
    const Vec3 c = centre(f);
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 image = c;
      image[axis] = 2 * middle[axis] - c[axis];
      const auto mate = std::find_if(open.begin(), open.end(),
                                     [&](const OpenFacet& g) { return norm(centre(g) - image) < 1e-9; });
      ASSERT_NE(mate, open.end());
      EXPECT_NEAR(norm(mate->traction), norm(f.traction), 1e-12 * s.law.strength);
    }
  }
}

}  // namespace
}  // namespace cdfp
