/// Impact of a steel ball (R 10 mm) on glass, and Hertz's formulas for it. A quarter of ball and glass; the
/// glass is a block with a half side and a height of 15 contact radii, at least of 10 mm, held at its bottom.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "cdfp/simulation.hpp"
#include "support/stop_watch.hpp"

namespace hertz {

using namespace cdfp;

inline constexpr double kRadius = 10e-3;
inline constexpr ElasticMaterial kSteel{7850, 210e9, 0.3}, kGlass{2500, 74e9, 0.2};

inline double ball_mass() {
  return kSteel.density * 4.0 / 3 * std::numbers::pi * std::pow(kRadius, 3);
}

/// Force, time, indentation and contact radius at the deepest.
struct Exact {
  double force, time, depth, radius;
};
inline Exact exact_values(double speed) {
  const auto plane_modulus = [](const ElasticMaterial& m) {
    return m.youngs_modulus / (1 - m.poissons_ratio * m.poissons_ratio);
  };
  const double e = 1 / (1 / plane_modulus(kSteel) + 1 / plane_modulus(kGlass));
  const double k = 4.0 / 3 * e * std::sqrt(kRadius);
  const double mass = ball_mass();
  const double depth = std::pow(5 * mass * speed * speed / (4 * k), 0.4);
  return {k * std::pow(depth, 1.5), 2.943 * depth / speed, depth, std::sqrt(kRadius * depth)};
}

/// From 0 to `length`, each step `growth` times the one before.
inline std::vector<double> graded(double length, double first, double growth) {
  std::vector<double> x{0};
  for (double step = first; x.back() < length; step *= growth) x.push_back(x.back() + step);
  for (double& value : x) value *= length / x.back();
  return x;
}

/// Lattice of hexahedra, placed by `place(x, y, z)`. Facet set: its faces of least or greatest z.
template <class Place>
void add_part(Model& model, const std::string& name, const ElasticMaterial& law, const std::vector<double>& x,
              const std::vector<double>& z, bool contact_below, const Place& place) {
  Mesh& mesh = model.mesh;
  const auto nx = static_cast<Index>(x.size()), nz = static_cast<Index>(z.size());
  const Index first = mesh.node_count();
  const auto node = [&](Index i, Index j, Index k) { return first + (k * nx + j) * nx + i; };
  FacetSet faces{name + "_face", {}};
  NodeSet low{name + "_low", {}};
  for (Index k = 0; k < nz; ++k) {
    for (Index j = 0; j < nx; ++j) {
      for (Index i = 0; i < nx; ++i) {
        const std::array<double, 3> p = place(x[i], x[j], z[k]);
        mesh.coordinates.insert(mesh.coordinates.end(), p.begin(), p.end());
        if (k == 0) low.nodes.push_back(node(i, j, k));
      }
    }
  }
  for (Index k = 0; k + 1 < nz; ++k) {
    for (Index j = 0; j + 1 < nx; ++j) {
      for (Index i = 0; i + 1 < nx; ++i) {
        if (k == (contact_below ? 0 : nz - 2))
          faces.facets.push_back({mesh.element_count(), contact_below ? 0 : 1});
        mesh.types.push_back(ElementType::hexahedron);
        mesh.parts.push_back(static_cast<Index>(mesh.part_names.size()));
        mesh.layers.push_back(k);
        for (const Index up : {k, k + 1}) {
          mesh.connectivity.insert(mesh.connectivity.end(), {node(i, j, up), node(i + 1, j, up),
                                                             node(i + 1, j + 1, up), node(i, j + 1, up)});
        }
      }
    }
  }
  mesh.part_names.push_back(name);
  mesh.facet_sets.push_back(faces);
  mesh.node_sets.push_back(low);
  model.materials.push_back({name, law});
  Part part;
  part.name = name;
  part.material = name;
  model.parts.push_back(part);
  model.contact.surfaces.push_back(faces.name);
}

/// From the cube [-1, 1]^3: a ball about its lowest point, rounded off less and less aside, where a cube bent
/// to a ball would have flat elements along its edges.
inline std::array<double, 3> ball(double x, double y, double z) {
  const auto bent = [](double a, double b, double c) {
    return a * std::sqrt(1 - b * b / 2 - c * c / 2 + b * b * c * c / 3);
  };
  const double t = std::clamp((std::sqrt(x * x + y * y) - 0.35) / 0.55, 0.0, 1.0);
  const double below = std::clamp(-z, 0.0, 1.0);
  const double cube = 0.6 * (1 - (1 - t * t * (3 - 2 * t)) * below), side = 0.85;
  const double round = 1 - cube;
  return {kRadius * (round * bent(x, y, z) + cube * side * x),
          kRadius * (round * bent(y, z, x) + cube * side * y),
          kRadius * (round * bent(z, x, y) + cube * side * z)};
}

/// `density_factor`: on the steel, so that the body has the mass of a whole ball.
inline Model make_model(double speed, double elements_a_radius, double density_factor) {
  const Exact exact = exact_values(speed);
  const double h = exact.radius / elements_a_radius, growth = 1 + 1.2 / elements_a_radius;
  Model model;
  const double side = std::max(15 * exact.radius, kRadius);
  const std::vector<double> x = graded(side, h, growth);
  std::vector<double> z(x.rbegin(), x.rend());
  for (double& value : z) value = -value;
  add_part(model, "glass", kGlass, x, z, false, [](double px, double py, double pz) {
    return std::array{px, py, pz};
  });
  // A lattice line at the ball's lowest point is shorter by sqrt(1/2) there.
  const std::vector<double> u = graded(1, h / kRadius * std::sqrt(2.0), growth);
  std::vector<double> w = graded(2, h / kRadius, growth);
  for (double& value : w) value -= 1;
  const double gap = 0.01 * exact.depth;
  const ElasticMaterial steel{kSteel.density * density_factor, kSteel.youngs_modulus, kSteel.poissons_ratio};
  add_part(model, "sphere", steel, u, w, true, [&](double px, double py, double pz) {
    std::array<double, 3> p = ball(px, py, pz);
    p[2] += kRadius + gap;
    return p;
  });
  model.symmetry_planes = {{0, 0}, {1, 0}};
  model.prescribed_velocities = {{"glass_low", {true, true, true}, {}, {0}}};
  model.initial_velocities = {{"sphere", {0, 0, -speed}}};
  model.contact.penalty_factor = 4;
  model.time = {1.3 * exact.time, 0, 0.6};
  model.output.history_interval = 1;
  model.threads = 1;  // some thousand elements
  return model;
}

inline double mass_of_last_part(const Model& model) {
  const Simulation s(model);
  const Index first = *std::min_element(
      model.mesh.connectivity.end() - 8 * std::count(model.mesh.parts.begin(), model.mesh.parts.end(), 1),
      model.mesh.connectivity.end());
  return std::accumulate(s.masses().begin() + first, s.masses().end(), 0.0);
}

struct Result {
  double force = 0, time = 0, balance = 0, wall = 0;
  Index elements = 0;
  long long steps = 0;
};
inline Result impact(double speed, double elements_a_radius) {
  const auto start = bench::Clock::now();
  // A quarter of the ball's mass, from a first look at what the mesh holds.
  const Model plain = make_model(speed, elements_a_radius, 1);
  Simulation s(make_model(speed, elements_a_radius, ball_mass() / 4 / mass_of_last_part(plain)));
  s.advance(100000000);
  const History& history = s.history();
  const auto column = static_cast<std::size_t>(
      std::find(history.columns.begin(), history.columns.end(), "contact_glass_sphere_force_z_n") -
      history.columns.begin());
  Result result;
  double begin = -1, end = 0;
  for (std::size_t row = 0; row < history.rows(); ++row) {
    const double force = std::abs(history.values[row * history.columns.size() + column]);
    const double time = history.values[row * history.columns.size()];
    result.force = std::max(result.force, force);
    if (force > 0) {
      if (begin < 0) begin = time;
      end = time;
    }
  }
  const Summary summary = s.summary();
  result.time = end - begin;
  result.balance = summary.energy_balance_min;
  result.elements = summary.elements;
  result.steps = summary.steps;
  result.wall = bench::seconds_since(start);
  return result;
}

}  // namespace hertz
