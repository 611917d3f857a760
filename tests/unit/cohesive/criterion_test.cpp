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

/// The mean stress of the elements of one part that name a node.
Mat3 stress_at(const Scene& scene, const Topology& topology, Index node, Index part) {
  Mat3 sum;
  int count = 0;
  for (Index e = 0; e < topology.bulk_count(); ++e) {
    const auto corners = topology.nodes(e);
    if (scene.model.mesh.parts[e] != part || std::find(corners.begin(), corners.end(), node) == corners.end())
      continue;
    sum = sum + scene.stress[e];
    ++count;
  }
  return 1.0 / count * sum;
}

std::vector<OpenFacet> by_force(const Scene& scene, const Topology& topology) {
  std::vector<OpenFacet> open;
  const CohesiveLaw& law = scene.model.cohesive_laws[0];
  const FacetStrength strength(scene.model);
  for (Index a = 0; a < topology.bulk_count(); ++a) {
    for (Index f = 0; f < 6; ++f) {
      const FacetUse mate = topology.mate({a, f});
      if (mate.element == kNone || mate.element >= topology.bulk_count() || mate.element < a) continue;
      const Index part = scene.model.mesh.parts[a];
      if (part != scene.model.mesh.parts[mate.element] || part == 1) continue;
      const FacetNodes c = topology.facet_nodes({a, f});
      const auto x = [&](int i) { return Vec3::load(&scene.model.mesh.coordinates[3 * c.nodes[i]]); };
      const Vec3 n = normalized(cross(x(2) - x(0), x(3) - x(1)));
      Mat3 sigma = 0.5 * (scene.stress[a] + scene.stress[mate.element]);
      if (scene.model.stress_recovery == StressRecovery::nodal) {
        sigma = {};
        for (int i = 0; i < 4; ++i) sigma = sigma + 0.25 * stress_at(scene, topology, c.nodes[i], part);
      }
      const Vec3 t = sigma * n;
      const double tn = dot(t, n);
      const double shear = norm(t - tn * n) / law.shear_ratio;
      const double held = law.internal_friction * std::max(0.0, -tn) / law.shear_ratio;
      const double te = tn > 0 ? std::hypot(tn, shear) : shear - held;
      if (te >= strength.of({a, f}, mate.element)) open.push_back({{a, f}, t});
    }
  }
  return open;
}

/// Elements that the bound of `ElementForce` would list: those whose stress reaches the least strength of the
/// part.
std::vector<Index> critical(const Scene& scene) {
  const FacetStrength strength(scene.model);
  std::vector<Index> list;
  for (Index e = 0; e < scene.model.mesh.element_count(); ++e) {
    const Mat3& s = scene.stress[e];
    const double size = std::sqrt(dot(s.r[0], s.r[0]) + dot(s.r[1], s.r[1]) + dot(s.r[2], s.r[2]));
    if (size >= strength.least_of_part(scene.model.mesh.parts[e])) list.push_back(e);
  }
  return list;
}

/// The meshes' nodes stand still in these scenes, so that facets of copies lie where those of the mesh did.
void compare_with_force(Scene& scene, std::size_t least_found) {
  Topology topology = scene.topology();
  Criterion criterion(scene.model);
  const auto stress = [&](Index e) { return scene.stress[e]; };
  std::vector<OpenFacet> open;
  std::size_t found = 0;
  for (int round = 0; round < 4; ++round) {
    criterion.find(critical(scene), {}, topology, scene.model.mesh.coordinates, stress, open);
    const std::vector<OpenFacet> expected = by_force(scene, topology);
    ASSERT_EQ(open.size(), expected.size());
    for (std::size_t i = 0; i < open.size(); ++i) {
      EXPECT_EQ(open[i].lower, expected[i].lower);
      EXPECT_LT(norm(open[i].traction - expected[i].traction), 1e-6);
    }
    found += open.size();
    // A facet that has opened is not found again.
    if (open.empty()) break;
    Insertion report;
    topology.insert_cohesive(open[open.size() / 2].lower, report);
    std::vector<double>& x = scene.model.mesh.coordinates;
    for (const auto& [node, mother] : report.new_nodes)
      for (int d = 0; d < 3; ++d) x.push_back(x[3 * static_cast<std::size_t>(mother) + d]);
  }
  EXPECT_GE(found, least_found);
}

TEST(Criterion, FindsWhatASearchOverAllFacetsFinds) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    for (const StressRecovery recovery : {StressRecovery::element_mean, StressRecovery::nodal}) {
      for (const double modulus : {0.0, 3.0}) {
        for (const bool field : {false, true}) {
          SCOPED_TRACE(testing::Message()
                       << seed << ' ' << static_cast<int>(recovery) << ' ' << modulus << ' ' << field);
          Scene scene(seed);
          scene.model.stress_recovery = recovery;
          CohesiveLaw& law = scene.model.cohesive_laws[0];
          if (recovery == StressRecovery::nodal) law.strength = 12e6;
          law.weibull_modulus = modulus;
          law.weibull_area = modulus > 0 ? 0.8e-6 : 0.0;
          law.seed = seed;
          std::uniform_real_distribution<double> share(0.5, 1.5);
          if (field) {
            for (Index e = 0; e < scene.model.mesh.element_count(); ++e)
              scene.model.strength_shares.push_back(share(scene.random));
          }
          compare_with_force(scene, 10);
        }
      }
    }
  }
}

TEST(Criterion, StrengthsFollowWeibullsDistribution) {
  BodySettings s;
  s.cells = {24, 24, 24};
  s.law.weibull_modulus = 5;
  s.law.weibull_area = 2e-6;
  s.law.seed = 11;
  const Model model = grid_model(s);
  const Topology topology(model.mesh.node_count(), model.mesh.types, model.mesh.connectivity);
  const auto draw = [&](std::int64_t seed) {
    Model seeded = model;
    seeded.cohesive_laws[0].seed = seed;
    const FacetStrength strength(seeded);
    std::vector<double> all;
    topology.for_each_facet([&](FacetUse use) {
      const FacetUse mate = topology.mate(use);
      if (mate.element == kNone) return;
      all.push_back(strength.of(use, mate.element));
      EXPECT_GE(all.back(), strength.least_of_element(use.element));
      EXPECT_GE(all.back(), strength.least_of_element(mate.element));
    });
    return all;
  };
  std::vector<double> strengths = draw(11);
  EXPECT_EQ(strengths, draw(11)) << "the same seed gives the same strengths";
  EXPECT_NE(strengths, draw(12));
  std::sort(strengths.begin(), strengths.end());
  // Kolmogorov's distance from 1 - exp(-A/A0 (s/S)^m), with facets of 1 mm2; 1.95/sqrt(n) at 0.1 %.
  const double n = static_cast<double>(strengths.size());
  double distance = 0;
  for (std::size_t i = 0; i < strengths.size(); ++i) {
    const double exact = -std::expm1(-0.5 * std::pow(strengths[i] / s.law.strength, 5));
    distance = std::max({distance, std::abs(exact - static_cast<double>(i) / n),
                         std::abs(exact - static_cast<double>(i + 1) / n)});
  }
  EXPECT_LT(distance, 1.95 / std::sqrt(n));
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
  for (const StressRecovery recovery : {StressRecovery::element_mean, StressRecovery::nodal}) {
    Model model = body.model;
    model.stress_recovery = recovery;
    std::vector<OpenFacet> open;
    Criterion(model).find(
        body.all, {}, body.topology, body.nodes.position, [&](Index e) { return body.stress(e); }, open);
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
}

}  // namespace
}  // namespace cdfp
