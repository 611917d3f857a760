// A grid of hexahedra made of springs between their corners: the smallest body that cracks.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <vector>

#include "cdfp/topology.hpp"
#include "cohesive/cohesive_zone.hpp"
#include "cohesive/criterion.hpp"
#include "state/nodes.hpp"

namespace cdfp {

struct BodySettings {
  std::array<int, 3> cells{40, 1, 1};
  std::array<double, 3> size{1e-3, 1e-3, 1e-3};  ///< m, of a cell
  /// false: cells carry sigma = E * strain along x and tau = G * shear over their section and nothing else,
  /// as a bar in one dimension; true: springs between all corners, a solid.
  bool solid = false;
  double youngs_modulus = 74e9;
  double shear_modulus = 31e9;
  double density = 2500;
  double step = 6e-8;
  CohesiveLaw law{"glass", 60e6, 10, 1, 1, 0, 1};
  CohesiveScheme scheme = CohesiveScheme::mean_traction;
  int threads = 1;
};

inline Mesh grid_mesh(const BodySettings& s) {
  Mesh mesh;
  const auto [nx, ny, nz] = s.cells;
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i)
        mesh.coordinates.insert(mesh.coordinates.end(), {i * s.size[0], j * s.size[1], k * s.size[2]});
    }
  }
  const auto node = [nx = nx, ny = ny](int i, int j, int k) {
    return static_cast<Index>((k * (ny + 1) + j) * (nx + 1) + i);
  };
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        mesh.types.push_back(ElementType::hexahedron);
        mesh.parts.push_back(0);
        // The bottom of a cell looks along -x, so that corner c + 4 follows corner c along x.
        for (const int d : {0, 1}) {
          for (const Index n :
               {node(i + d, j, k), node(i + d, j + 1, k), node(i + d, j + 1, k + 1), node(i + d, j, k + 1)})
            mesh.connectivity.push_back(n);
        }
      }
    }
  }
  mesh.part_names = {"body"};
  return mesh;
}

inline Model grid_model(const BodySettings& s) {
  Model model;
  model.mesh = grid_mesh(s);
  model.materials = {{"glass", ElasticMaterial{s.density, s.youngs_modulus, 0.2}}};
  model.cohesive_laws = {s.law};
  Part part;
  part.name = "body";
  part.material = "glass";
  part.cohesive_law = s.law.name;
  model.parts = {part};
  return model;
}

class SpringBody {
 public:
  explicit SpringBody(const BodySettings& given)
      : s(given),
        model(grid_model(given)),
        nodes(model.mesh.coordinates),
        topology(model.mesh.node_count(), model.mesh.types, model.mesh.connectivity),
        criterion(model),
        zone(model, given.scheme),
        threads(given.threads) {
    for (Index e = 0; e < topology.bulk_count(); ++e) {
      for (const Index n : topology.nodes(e)) nodes.mass[n] += corner_mass();
      all.push_back(e);
    }
    const auto corners = topology.nodes(0);
    for (int a = 0; a < 8; ++a) corner_[a] = nodes.x0(corners[a]) - nodes.x0(corners[0]);
  }

  double volume() const { return s.size[0] * s.size[1] * s.size[2]; }
  double section() const { return s.size[1] * s.size[2]; }  ///< m2, of a cell
  double corner_mass() const { return s.density * volume() / 8; }

  /// One step. `load` may add forces; facets of the elements in `cracking` open.
  void step(const std::function<void(Nodes&)>& load = {}, std::span<const Index> cracking = {}) {
    for (std::size_t i = 0; i < nodes.position.size(); ++i) nodes.position[i] += s.step * nodes.velocity[i];
    std::fill(nodes.force.begin(), nodes.force.end(), 0.0);
    for (Index e = 0; e < topology.bulk_count(); ++e) add_springs(e, nodes.force);
    if (!cracking.empty()) {
      criterion.find(
          cracking, {}, topology, nodes.position, [this](Index e) { return stress(e); }, open);
      std::erase_if(open, [this](const OpenFacet& f) { return accept && !accept(f); });
      if (reversed) std::reverse(open.begin(), open.end());
      for (const OpenFacet& facet : open) insert(facet);
    }
    if (load) load(nodes);
    zone.add_force(nodes, s.step, time, threads);
    kinetic = 0;
    for (Index n = 0; n < nodes.count(); ++n) {
      Vec3 v = nodes.v(n);
      for (int d = 0; d < 3; ++d) {
        if (nodes.fixed[n] >> d & 1) continue;
        const double before = v[d];
        v[d] += s.step * nodes.f(n)[d] / nodes.mass[n];
        kinetic += 0.5 * nodes.mass[n] * before * v[d];
      }
      v.store(&nodes.velocity[3 * static_cast<std::size_t>(n)]);
    }
    time += s.step;
  }

  void insert(const OpenFacet& facet) {
    topology.insert_cohesive(facet.lower, report);
    for (const auto& [node, mother] : report.new_nodes) nodes.clone(mother, model.mesh.coordinates);
    std::fill(nodes.mass.begin(), nodes.mass.end(), 0.0);
    std::fill(nodes.force.begin(), nodes.force.end(), 0.0);
    for (Index e = 0; e < topology.bulk_count(); ++e) {
      for (const Index n : topology.nodes(e)) nodes.mass[n] += corner_mass();
      add_springs(e, nodes.force);
    }
    zone.insert(topology, report, facet, nodes, time);
  }

  /// Calls `spring(a, b, pull)` for each spring: `pull` is the force on corner a towards what b does to it.
  template <class Spring>
  double for_springs(Index e, Spring&& spring) const {
    const auto c = topology.nodes(e);
    double energy = 0;
    if (!s.solid) {
      const double share = section() / 4 / s.size[0];
      for (int i = 0; i < 4; ++i) {
        const Vec3 d = nodes.x(c[i + 4]) - nodes.x(c[i]) - Vec3{s.size[0], 0, 0};
        spring(i, i + 4, share * Vec3{s.youngs_modulus * d.x, s.shear_modulus * d.y, s.shear_modulus * d.z});
        energy += 0.5 * share * (s.youngs_modulus * d.x * d.x + s.shear_modulus * (d.y * d.y + d.z * d.z));
      }
      return energy;
    }
    for (int a = 0; a < 8; ++a) {
      for (int b = a + 1; b < 8; ++b) {
        const double rest = norm(corner_[b] - corner_[a]);
        const Vec3 d = nodes.x(c[b]) - nodes.x(c[a]);
        const double length = norm(d);
        const double k = 0.35 * s.youngs_modulus * volume() / (8 * rest * rest);
        spring(a, b, (k * (length - rest) / length) * d);
        energy += 0.5 * k * (length - rest) * (length - rest);
      }
    }
    return energy;
  }
  void add_springs(Index e, std::vector<double>& force) const {
    const auto c = topology.nodes(e);
    for_springs(e, [&](int a, int b, Vec3 pull) {
      pull.add_to(&force[3 * static_cast<std::size_t>(c[a])]);
      (-pull).add_to(&force[3 * static_cast<std::size_t>(c[b])]);
    });
  }
  /// Virial of the springs over the volume.
  Mat3 stress(Index e) const {
    Mat3 out;
    for_springs(e, [&](int a, int b, Vec3 pull) {
      const Vec3 d = corner_[b] - corner_[a];
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) out(i, j) += 0.5 * (pull[i] * d[j] + pull[j] * d[i]) / volume();
      }
    });
    if (!s.solid) out(0, 1) *= 2, out(1, 0) *= 2, out(0, 2) *= 2, out(2, 0) *= 2;
    return out;
  }
  /// Of the springs, at the positions of the last step.
  double strain_energy() const {
    double sum = 0;
    for (Index e = 0; e < topology.bulk_count(); ++e) sum += for_springs(e, [](int, int, Vec3) {});
    return sum;
  }
  Vec3 momentum() const {
    Vec3 sum;
    for (Index n = 0; n < nodes.count(); ++n) sum += nodes.mass[n] * nodes.v(n);
    return sum;
  }
  void set_velocity(const std::function<Vec3(Vec3)>& of) {
    for (Index n = 0; n < nodes.count(); ++n) {
      of(nodes.x0(n)).store(&nodes.velocity[3 * static_cast<std::size_t>(n)]);
    }
  }

  BodySettings s;
  Model model;
  Nodes nodes;
  Topology topology;
  Criterion criterion;
  CohesiveZone zone;
  Threads threads;
  double time = 0;
  double kinetic = 0;  ///< J, at the last step: 1/2 m v(n-1/2) . v(n+1/2)
  Insertion report;
  std::vector<OpenFacet> open;
  std::vector<Index> all;                        ///< elements
  std::function<bool(const OpenFacet&)> accept;  ///< facets that may open; all if empty
  bool reversed = false;  ///< facets of one step are inserted from the last to the first

 private:
  std::array<Vec3, 8> corner_;
};

}  // namespace cdfp
