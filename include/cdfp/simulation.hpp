/// A simulation built from a model: advance it, look at its state.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cdfp/model.hpp"
#include "cdfp/results.hpp"

namespace cdfp {

class Topology;

/// Not thread-safe by itself; different simulations may be used from different threads at once.
class Simulation {
 public:
  /// Resolves and checks the model, builds what the scene needs and nothing else.
  /// Throws `Error` naming the entry that is wrong and the cure.
  explicit Simulation(Model model);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// One step of central differences. Throws `Error(diverged)` naming element and time if the state is lost;
  /// the state stays readable.
  void step();
  /// As many steps as are left, at most `steps`; returns how many were done.
  std::int64_t advance(std::int64_t steps);

  bool finished() const;
  double time() const;
  double step_size() const;
  double stable_step() const;         ///< s, at the last estimate
  Index controlling_element() const;  ///< of the last estimate
  std::int64_t step_count() const;

  // Views (n, 3) or (n): valid until the next step (an insertion grows them).
  std::span<const double> positions() const;   ///< m
  std::span<const double> velocities() const;  ///< half a step ahead of the positions, m/s
  std::span<const double> forces() const;      ///< N, all nodal forces of the last step
  std::span<const double> masses() const;
  Index node_count() const;
  /// Cauchy stress of all elements, (elements, 6): xx yy zz xy yz zx, Pa, mean over the element.
  std::vector<double> stresses() const;

  // Changes of the state between steps, (n, 3). Nodes of rigid bodies and directions that are prescribed keep
  // what they have; the energy that a change brings is external work. Throw `Error(bad_argument)` for another
  // length and for what is not finite; nothing is changed then.
  void set_positions(std::span<const double> positions);    ///< m; contact is searched anew
  void set_velocities(std::span<const double> velocities);  ///< m/s, half a step ahead of the positions

  /// Writes all that the next step needs into a file, which takes its place when it is whole: a run that ends
  /// while it writes leaves the earlier one. Throws `Error(io)`.
  void save(const std::string& path) const;
  /// Goes on from there: this simulation, built from the same model and not stepped yet, is as the other one
  /// was when it was saved, and takes the same steps to the bit with any number of threads on the same
  /// processors. Title, threads, time and output of the model may be others; what callbacks keep for
  /// themselves is theirs to bring back. Throws `Error(io)`, `Error(bad_input)` for a file that is damaged,
  /// cut short, of another model or version, and `Error(bad_state)` after a step; nothing is changed then.
  void restore(const std::string& path);

  /// Its mesh is undeformed, with nodes and corners as cracks have split them so far.
  const Model& model() const;
  const Topology& topology() const;

  struct BodyState {
    std::array<double, 3> position{};
    std::array<double, 3> velocity{};
    std::array<double, 3> angular_velocity{};
    std::array<double, 3> contact_force{};  ///< N, on what is modelled
  };
  Index body_count() const;
  BodyState body(Index rigid_body) const;

  Index cohesive_count() const;
  Index broken_count() const;

  Energies energies() const;
  const History& history() const;
  Frame frame() const;
  Summary summary() const;

 private:
  struct Stages;
  std::unique_ptr<Stages> stages_;
};

}  // namespace cdfp
