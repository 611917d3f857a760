// A run that is saved and continued is the run that was never stopped, to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "cdfp/error.hpp"
#include "cdfp/simulation.hpp"
#include "driver/case_reader.hpp"
#include "scenes.hpp"

namespace cdfp {
namespace {

std::string scratch(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "cdfp_restart_test";
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

std::string contents(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}
void write(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

template <class T>
std::vector<T> copy(std::span<const T> values) {
  return {values.begin(), values.end()};
}

void expect_same(const Simulation& a, const Simulation& b) {
  EXPECT_EQ(a.time(), b.time());
  EXPECT_EQ(a.step_count(), b.step_count());
  EXPECT_EQ(a.step_size(), b.step_size());
  EXPECT_TRUE(copy(a.positions()) == copy(b.positions()));
  EXPECT_TRUE(copy(a.velocities()) == copy(b.velocities()));
  EXPECT_TRUE(copy(a.forces()) == copy(b.forces()));
  EXPECT_TRUE(copy(a.masses()) == copy(b.masses()));
  EXPECT_TRUE(a.stresses() == b.stresses());
  EXPECT_EQ(a.history().columns, b.history().columns);
  EXPECT_TRUE(a.history().values == b.history().values);
  const Frame f = a.frame(), g = b.frame();
  EXPECT_TRUE(copy(f.connectivity) == copy(g.connectivity));
  ASSERT_EQ(f.cracks.size(), g.cracks.size());
  for (std::size_t i = 0; i < f.cracks.size(); ++i) {
    EXPECT_EQ(f.cracks[i].upper, g.cracks[i].upper);
    EXPECT_EQ(f.cracks[i].damage, g.cracks[i].damage);
    EXPECT_EQ(f.cracks[i].broken_time, g.cracks[i].broken_time);
  }
  const Summary s = a.summary(), t = b.summary();
  EXPECT_EQ(s.segments_initial, t.segments_initial);
  EXPECT_EQ(s.segments_final, t.segments_final);
  EXPECT_EQ(s.cohesive_broken, t.cohesive_broken);
  EXPECT_EQ(s.energy_balance_min, t.energy_balance_min);
  EXPECT_EQ(s.peak_force_n, t.peak_force_n);
  EXPECT_EQ(s.deepest_penetration_m, t.deepest_penetration_m);
  EXPECT_EQ(s.warnings, t.warnings);
  ASSERT_EQ(s.contact_pairs.size(), t.contact_pairs.size());
  for (std::size_t i = 0; i < s.contact_pairs.size(); ++i) {
    EXPECT_EQ(s.contact_pairs[i].parts, t.contact_pairs[i].parts);
    EXPECT_EQ(s.contact_pairs[i].peak_force_n, t.contact_pairs[i].peak_force_n);
    EXPECT_EQ(s.contact_pairs[i].friction_heat_j, t.contact_pairs[i].friction_heat_j);
  }
  ASSERT_EQ(s.first_cracks.size(), t.first_cracks.size());
  for (std::size_t i = 0; i < s.first_cracks.size(); ++i) {
    EXPECT_EQ(s.first_cracks[i].layer_face, t.first_cracks[i].layer_face);
    EXPECT_EQ(s.first_cracks[i].position, t.first_cracks[i].position);
  }
  ASSERT_EQ(s.deleted.size(), t.deleted.size());
  for (std::size_t i = 0; i < s.deleted.size(); ++i) {
    EXPECT_EQ(s.deleted[i].element, t.deleted[i].element);
    EXPECT_EQ(s.deleted[i].part, t.deleted[i].part);
    EXPECT_EQ(s.deleted[i].time_s, t.deleted[i].time_s);
  }
}

/// Steps to the end, saves at some steps on the way, and continues from each save with other threads.
void stop_and_go_on(const Model& model, const std::vector<std::int64_t>& stops,
                    const std::function<void(const Simulation&)>& look) {
  Simulation whole(model);
  std::vector<std::string> files;
  for (const std::int64_t stop : stops) {
    whole.advance(stop - whole.step_count());
    ASSERT_EQ(whole.step_count(), stop);
    look(whole);
    files.push_back(scratch("at_" + std::to_string(stop)));
    whole.save(files.back());
  }
  whole.advance(1000000);
  for (std::size_t i = 0; i < files.size(); ++i) {
    Model again = model;
    again.threads = 3 - model.threads;
    again.title = "continued";
    Simulation rest(std::move(again));
    rest.restore(files[i]);
    EXPECT_EQ(rest.step_count(), stops[i]);
    const std::string copy_of_file = scratch("again");
    rest.save(copy_of_file);
    EXPECT_TRUE(contents(copy_of_file) == contents(files[i])) << "what is restored is what was saved";
    rest.advance(1000000);
    expect_same(whole, rest);
  }
}

TEST(Restart, LaminatedGlassInTheMiddleOfCracking) {
  Model model = read_case(CDFP_SOURCE_DIR "/examples/laminated_glass/case_quick.toml");
  model.threads = 1;
  for (double& v : model.rigid_bodies.at(0).velocity) v *= 4;  // for more cracks in less time
  model.time.end = 36e-6;
  stop_and_go_on(model, {1, 300, 450}, [](const Simulation& s) {
    if (s.step_count() == 1) return;
    EXPECT_GT(s.cohesive_count(), 100);
    EXPECT_GT(s.broken_count(), 1);
  });
}

/// Two blocks of a user's material with memory fall on one another and wear: one loses elements, both slide.
Model wearing() {
  Model model;
  scenes::add_box(model.mesh, "lower", {6, 6, 3}, {6e-3, 6e-3, 3e-3});
  scenes::add_box(model.mesh, "upper", {3, 3, 3}, {2.1e-3, 2.1e-3, 2.1e-3}, {1.87e-3, 1.93e-3, 3.05e-3});
  model = scenes::with_part(std::move(model), "lower", {});
  model = scenes::with_part(std::move(model), "upper", {8000, 200e9, 0.3});
  UserMaterial m;
  m.density = 1000;
  m.states = 3;
  m.deletion_state = 2;
  m.callback = [](const MaterialPoints& p) {
    const double young = 20e9, nu = 0.2;
    const double mu = young / (2 * (1 + nu)), lambda = young * nu / ((1 + nu) * (1 - 2 * nu));
    for (std::int64_t i = 0; i < p.count; ++i) {
      const double* d = p.strain_increment + i;
      const double volume = d[0] + d[p.count] + d[2 * p.count];
      for (int k = 0; k < 6; ++k)
        p.stress[k * p.count + i] += (k < 3 ? lambda * volume : 0) + 2 * mu * d[k * p.count];
      p.state[i] += volume;                                               // memory
      p.state[p.count + i] = std::min(p.state[p.count + i], p.state[i]);  // the most that it was pressed
      p.state[2 * p.count + i] = p.state[p.count + i] > -4e-3 ? 1 : 0;
    }
  };
  model.materials[0].law = m;
  model.prescribed_velocities = {{"lower_low_x", {true, true, true}, {0, 1e-5}, {0, 5}}};
  InitialVelocity flight;
  flight.part = "upper";
  flight.velocity = {40, 10, -60};
  model.initial_velocities = {flight};
  model.contact.surfaces = {"lower_faces", "upper_faces"};
  model.contact.friction = 0.3;
  model.gravity = {0, 0, -1e6};
  model.time.end = 3e-5;
  model.output.history_interval = 3;
  return model;
}

TEST(Restart, UsersMaterialThatDeletesAndFriction) {
  std::size_t deleted = 0;
  stop_and_go_on(wearing(), {20, 60, 150}, [&](const Simulation& s) {
    deleted = s.summary().deleted.size();
    EXPECT_GT(s.energies().contact_friction, 0);
  });
  EXPECT_GT(deleted, 0U);
}

/// Two wedges a brick: glass that is torn, and PVB behind it.
TEST(Restart, WedgesThatCrackAndFlow) {
  Model model;
  scenes::add_box(model.mesh, "glass", {12, 2, 2}, {12e-3, 2e-3, 2e-3});
  model.mesh.part_names.emplace_back("pvb");
  for (std::size_t e = 0; e < model.mesh.parts.size(); ++e) model.mesh.parts[e] = e % 12 < 8 ? 0 : 1;
  scenes::cut_into_wedges(model.mesh, 2);
  model = scenes::with_part(std::move(model), "glass", {2500, 70e9, 0.2});
  model = scenes::with_part(std::move(model), "pvb", {});
  model.materials[1].law = RateDependentMaterial{1000, 0.49, 5.88e6, 29.21e6, 0.176, 1e-6};
  CohesiveLaw law;
  law.name = "glass";
  law.strength = 60e6;
  law.fracture_energy = 10;
  model.cohesive_laws = {law};
  model.parts[0].cohesive_law = "glass";
  model.initial_velocities = {{"glass", {}, {3000, 0, 0, 0, 0, 0, 0, 0, 0}}};
  model.time.end = 6e-6;
  int broken = 0;
  stop_and_go_on(model, {2, 30, 50}, [&](const Simulation& s) { broken = s.broken_count(); });
  EXPECT_GT(broken, 0);
}

/// A bar that is torn by a user's cohesive law, with a bond, a load and a moving end.
TEST(Restart, UsersCohesiveLawBondAndLoad) {
  Model model;
  scenes::add_box(model.mesh, "bar", {12, 2, 2}, {12e-3, 2e-3, 2e-3});
  model = scenes::with_part(std::move(model), "bar", {2500, 70e9, 0.2});
  CohesiveLaw law;
  law.name = "users";
  law.kind = CohesiveKind::user;
  law.strength = 40e6;
  law.fracture_energy = 10;
  law.stiffness = 1e14;
  law.states = 1;
  law.callback = [](const CohesivePoints& p) {
    const double reach = 5e-7;
    for (std::int64_t i = 0; i < p.count; ++i) {
      const double opening =
          std::sqrt(p.opening[3 * i] * p.opening[3 * i] + p.opening[3 * i + 1] * p.opening[3 * i + 1] +
                    p.opening[3 * i + 2] * p.opening[3 * i + 2]);
      p.state[i] = std::max(p.state[i], opening);
      const double left = std::max(0.0, 1 - p.state[i] / reach);
      for (int d = 0; d < 3; ++d) p.traction[3 * i + d] = left * p.insertion_traction[3 * i + d];
      p.damage[i] = 1 - left;
    }
  };
  model.cohesive_laws = {law};
  model.parts[0].cohesive_law = "users";
  CohesiveLaw glue;
  glue.name = "glue";
  glue.kind = CohesiveKind::bilinear;
  glue.strength = 60e6;
  glue.fracture_energy = 20;
  glue.stiffness = 1e15;
  model.cohesive_laws.push_back(glue);
  FacetSet middle{"middle", {}};
  for (Index row = 0; row < 4; ++row) middle.facets.push_back({12 * row + 5, 3});
  model.mesh.facet_sets.push_back(middle);
  model.bonds = {{"middle", {}, "glue"}};
  model.prescribed_velocities = {{"bar_low_x", {true, true, true}, {}, {0}},
                                 {"bar_high_x", {true, false, false}, {0, 1e-5}, {0, 3}}};
  model.load = [](const NodalLoad& load) {
    for (std::int64_t n = 0; n < load.nodes; ++n) load.force[3 * n + 2] += 1e-3;
  };
  model.time.end = 4e-5;
  stop_and_go_on(model, {100, 300},
                 [](const Simulation& s) { EXPECT_GE(s.cohesive_count(), s.step_count() > 100 ? 5 : 4); });
}

std::string refused(const Model& model, const std::string& path, Status status) {
  Simulation s(model);
  const std::vector<double> before = copy(s.positions());
  std::string message = "no error";
  try {
    s.restore(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), status) << error.what();
    message = error.what();
  }
  EXPECT_EQ(s.step_count(), 0);
  EXPECT_TRUE(copy(s.positions()) == before);
  s.advance(3);
  EXPECT_EQ(s.step_count(), 3) << "it may start anew";
  return message;
}
#define EXPECT_TOLD(text, part) EXPECT_NE(std::string(text).find(part), std::string::npos) << (text)

TEST(Restart, WhatDoesNotFitIsRefusedAndChangesNothing) {
  const Model model = wearing();
  Simulation saved(model);
  saved.advance(10);
  const std::string good = scratch("good"), bad = scratch("bad");
  saved.save(good);
  const std::string bytes = contents(good);

  EXPECT_TOLD(refused(model, scratch("nothing"), Status::io), "cannot read the restart file");
  write(bad, "");
  EXPECT_TOLD(refused(model, bad, Status::io), "it is empty");
  write(bad, "title = \"a case file\"\n");
  EXPECT_TOLD(refused(model, bad, Status::bad_input), "it is no restart file");
  for (const std::size_t length : {std::size_t{8}, std::size_t{41}, bytes.size() / 2, bytes.size() - 1}) {
    write(bad, bytes.substr(0, length));
    EXPECT_TOLD(refused(model, bad, Status::bad_input), "cannot continue from '" + bad + "'");
  }
  EXPECT_TOLD(refused(model, bad, Status::bad_input), "cut short");
  for (const std::size_t at : {std::size_t{45}, std::size_t{100}, bytes.size() / 2, bytes.size() - 1}) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 4);
    write(bad, damaged);
    EXPECT_TOLD(refused(model, bad, Status::bad_input), "damaged");
  }
  std::string older = bytes;
  older[16] = 77;
  write(bad, older);
  EXPECT_TOLD(refused(model, bad, Status::bad_input), "another version of cdfp has written it (format 77");

  const std::pair<const char*, std::function<void(Model&)>> others[] = {
      {"mesh", [](Model& m) { m.mesh.coordinates[0] += 1e-9; }},
      {"materials", [](Model& m) { std::get<UserMaterial>(m.materials[0].law).density = 1001; }},
      {"parts", [](Model& m) { m.parts[1].formulation = Formulation::full; }},
      {"contact", [](Model& m) { m.contact.friction = 0.2; }},
      {"gravity", [](Model& m) { m.gravity[0] = 1; }},
      {"initial velocities", [](Model& m) { m.initial_velocities[0].velocity[1] = 11; }},
      {"prescribed velocities", [](Model& m) { m.prescribed_velocities[0].values[1] = 6; }}};
  for (const auto& [what, change] : others) {
    Model other = model;
    change(other);
    EXPECT_TOLD(refused(other, good, Status::bad_input),
                "saved by another model, whose " + std::string(what) + " is not");
  }

  try {
    saved.restore(good);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::bad_state);
    EXPECT_TOLD(error.what(), "10 steps");
  }
  try {
    saved.save(scratch("no such folder/file"));
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::io);
  }
  EXPECT_TRUE(contents(good) == bytes);
}

TEST(Restart, GoesOnPastTheFirstEnd) {
  Model model = wearing();
  model.time.end = 1e-5;
  Simulation first(model);
  first.advance(1000000);
  EXPECT_TRUE(first.finished());
  const std::string file = scratch("end");
  first.save(file);
  model.time.end = 2e-5;
  Simulation second(model);
  second.restore(file);
  EXPECT_FALSE(second.finished());
  second.advance(1000000);
  EXPECT_NEAR(second.time(), 2e-5, second.step_size());
  Simulation whole(model);
  whole.advance(1000000);
  EXPECT_TRUE(copy(whole.positions()) == copy(second.positions()));
}

}  // namespace
}  // namespace cdfp
