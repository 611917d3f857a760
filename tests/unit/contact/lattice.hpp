// Blocks of bricks for contact tests: corners joined by springs, or moved as rigid bodies without rotation.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <span>
#include <vector>

#include "cdfp/contact.hpp"
#include "core/vec3.hpp"

namespace cdfp::test {

inline constexpr Index kFacets[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                        {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

inline Mat3 rotation(Vec3 axis, double angle) {
  const Vec3 a = normalized(axis);
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 r;
  const Mat3 cross_a{{Vec3{0, -a.z, a.y}, Vec3{a.z, 0, -a.x}, Vec3{-a.y, a.x, 0}}};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) r(i, j) = c * (i == j) + s * cross_a(i, j) + (1 - c) * a[i] * a[j];
  }
  return r;
}

struct Block {
  std::array<int, 3> bricks{1, 1, 1};
  Vec3 size{1e-3, 1e-3, 1e-3};
  Vec3 centre{};
  Mat3 turn = Mat3::identity();
  Vec3 velocity{};
  double density = 2500, youngs_modulus = 70e9;
  bool loose = false;  // every brick on its own, faces lying on each other
  bool rigid = false;  // moves as one, without rotation
  bool held = false;   // does not move
};

class Scene {
 public:
  explicit Scene(const ContactSettings& settings = {}) : contact(settings) {}

  std::vector<double> x, v, f, m;
  std::vector<Index> body;
  SurfaceContact contact;
  Vec3 gravity;
  double time = 0;
  int threads = 1;
  long regular_searches = 0;

  SurfaceContact::Arrays arrays() { return {x, v, m, {}, f}; }
  Index node_count() const { return static_cast<Index>(m.size()); }
  Vec3 position(Index n) const { return Vec3::load(&x[3 * n]); }

  /// Returns the block's number.
  Index add(const Block& b) {
    const Index number = static_cast<Index>(blocks_.size());
    blocks_.push_back(b);
    const Vec3 h{b.size.x / b.bricks[0], b.size.y / b.bricks[1], b.size.z / b.bricks[2]};
    const double volume = h.x * h.y * h.z, bulk_modulus = b.youngs_modulus / 1.8;
    std::map<std::array<int, 3>, Index> shared;
    std::set<std::array<Index, 2>> joined;
    std::map<std::array<Index, 4>, int> uses;
    std::vector<std::array<Index, 8>> bricks;
    for (int k = 0; k < b.bricks[2]; ++k) {
      for (int j = 0; j < b.bricks[1]; ++j) {
        for (int i = 0; i < b.bricks[0]; ++i) {
          const int at[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
          std::array<Index, 8> brick{};
          if (b.loose) shared.clear();
          for (int c = 0; c < 8; ++c) {
            const std::array<int, 3> place{i + at[c][0], j + at[c][1], k + at[c][2]};
            const auto [entry, fresh] = shared.try_emplace(place, node_count());
            if (fresh) {
              const Vec3 local{place[0] * h.x - 0.5 * b.size.x, place[1] * h.y - 0.5 * b.size.y,
                               place[2] * h.z - 0.5 * b.size.z};
              const Vec3 p = b.centre + b.turn * local;
              x.insert(x.end(), {p.x, p.y, p.z});
              v.insert(v.end(), {b.velocity.x, b.velocity.y, b.velocity.z});
              f.insert(f.end(), {0, 0, 0});
              m.push_back(0);
              body.push_back(number);
            }
            brick[c] = entry->second;
            m[brick[c]] += b.density * volume / 8;
          }
          bricks.push_back(brick);
          // Stiffness in the right order of magnitude; elasticity itself is not what is tested.
          for (int c = 0; c < 8; ++c) {
            for (int d = c + 1; d < 8; ++d) {
              const std::array<Index, 2> ends{std::min(brick[c], brick[d]), std::max(brick[c], brick[d])};
              const double length = norm(position(ends[0]) - position(ends[1]));
              springs_.push_back({ends, length, b.youngs_modulus * std::cbrt(volume) / 16});
            }
          }
          for (const auto& facet : kFacets) ++uses[sorted(brick, facet)];
        }
      }
    }
    for (const auto& brick : bricks) {
      for (const auto& facet : kFacets) {
        if (uses[sorted(brick, facet)] > 1) continue;
        const Vec3 a = position(brick[facet[0]]), c = position(brick[facet[1]]),
                   d = position(brick[facet[3]]);
        const double area = norm(cross(c - a, d - a));
        contact.add_segment({{brick[facet[0]], brick[facet[1]], brick[facet[2]], brick[facet[3]]},
                             element_,
                             number,
                             bulk_modulus,
                             area,
                             volume});
      }
      ++element_;
    }
    return number;
  }

  /// One step of central differences; `v` are half-step velocities.
  void step(double dt) {
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += dt * v[i];
    std::fill(f.begin(), f.end(), 0.0);
    switch (contact.due(arrays(), dt, threads)) {
      case SurfaceContact::Search::regular:
        contact.regular_search(arrays());
        ++regular_searches;
        break;
      case SurfaceContact::Search::adaptive:
        contact.adaptive_search(arrays());
        break;
      case SurfaceContact::Search::none:
        break;
    }
    contact.local_search(arrays(), threads);
    contact.add_force(arrays(), dt, threads);
    contact_force = f;
    for (const Spring& s : springs_) {
      if (blocks_[body[s.ends[0]]].rigid || blocks_[body[s.ends[0]]].held) continue;
      const Vec3 along = position(s.ends[1]) - position(s.ends[0]);
      const double length = norm(along);
      const Vec3 pull = s.stiffness * (length - s.length) / length * along;
      pull.add_to(&f[3 * s.ends[0]]);
      (-pull).add_to(&f[3 * s.ends[1]]);
    }
    for (Index n = 0; n < node_count(); ++n) (m[n] * gravity).add_to(&f[3 * n]);
    old_v = v;
    for (Index number = 0; number < static_cast<Index>(blocks_.size()); ++number) {
      if (!blocks_[number].rigid) continue;
      const Vec3 change = dt / mass(number) * force(number);
      for (Index n = 0; n < node_count(); ++n) {
        if (body[n] == number) change.add_to(&v[3 * n]);
      }
    }
    for (Index n = 0; n < node_count(); ++n) {
      const Block& b = blocks_[body[n]];
      if (!b.rigid && !b.held) (dt / m[n] * Vec3::load(&f[3 * n])).add_to(&v[3 * n]);
    }
    time += dt;
  }
  /// Below the limit of a brick's springs.
  double stable_step(double share = 0.5) const {
    std::vector<double> stiffness(m.size(), 0);
    for (const Spring& s : springs_) {
      for (const Index end : s.ends) stiffness[end] += s.stiffness;
    }
    double step = 1;
    for (Index n = 0; n < node_count(); ++n) step = std::min(step, std::sqrt(2 * m[n] / stiffness[n]));
    return share * step;
  }

  double mass(Index number) const {
    double sum = 0;
    for (Index n = 0; n < node_count(); ++n) sum += body[n] == number ? m[n] : 0;
    return sum;
  }
  Vec3 force(Index number) const {
    Vec3 sum;
    for (Index n = 0; n < node_count(); ++n) {
      if (body[n] == number) sum += Vec3::load(&f[3 * n]);
    }
    return sum;
  }
  Vec3 momentum() const {
    Vec3 sum;
    for (Index n = 0; n < node_count(); ++n) sum += m[n] * Vec3::load(&v[3 * n]);
    return sum;
  }
  Vec3 velocity(Index number) const {
    Vec3 sum;
    for (Index n = 0; n < node_count(); ++n) {
      if (body[n] == number) sum += m[n] * Vec3::load(&v[3 * n]);
    }
    return sum / mass(number);
  }
  /// Kinetic energy at the end of the last step: mean of the products of both half steps.
  double kinetic() const {
    double sum = 0;
    for (Index n = 0; n < node_count(); ++n) {
      const Vec3 now = Vec3::load(&v[3 * n]);
      const Vec3 before = old_v.empty() ? now : Vec3::load(&old_v[3 * n]);
      const Vec3 mean = 0.5 * (now + before);
      sum += 0.5 * m[n] * dot(mean, mean);
    }
    return sum;
  }
  double strain() const {
    double sum = 0;
    for (const Spring& s : springs_) {
      const double stretch = norm(position(s.ends[1]) - position(s.ends[0])) - s.length;
      sum += 0.5 * s.stiffness * stretch * stretch;
    }
    return sum;
  }
  double energy() const { return kinetic() + strain() + contact.stored_energy() + contact.friction_heat(); }

  std::vector<double> contact_force, old_v;

 private:
  struct Spring {
    std::array<Index, 2> ends;
    double length, stiffness;
  };
  static std::array<Index, 4> sorted(const std::array<Index, 8>& brick, const Index (&facet)[4]) {
    std::array<Index, 4> nodes{brick[facet[0]], brick[facet[1]], brick[facet[2]], brick[facet[3]]};
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }
  std::vector<Block> blocks_;
  std::vector<Spring> springs_;
  Index element_ = 0;
};

}  // namespace cdfp::test
