// Users' materials in whole simulations: motion, output, deletion, failure.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "../physics/scenes.hpp"
#include "cdfp/recorder.hpp"
#include "cdfp/simulation.hpp"
#include "outside_law.hpp"

namespace cdfp::test {
namespace {

std::string contents(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A plate that starts to bend, of any material.
Model plate(const decltype(Material::law)& law, Formulation formulation) {
  Model model;
  scenes::add_box(model.mesh, "plate", {12, 8, 2}, {0.12, 0.08, 0.01});
  Part part;
  part.name = "plate";
  part.material = "metal";
  part.formulation = formulation;
  model.parts = {part};
  model.materials = {{"metal", law}};
  InitialVelocity start;
  start.part = "plate";
  start.gradient = {0, 0, 0, 0, 0, 0, 30, 20, 0};  // the held edge makes a wave of it
  model.initial_velocities = {start};
  model.prescribed_velocities = {{"plate_low_x", {true, true, true}, {}, {0}}};
  model.time.end = 2e-4;
  model.time.fixed_step = 4e-7;
  model.threads = 1;
  return model;
}

UserMaterial elastic_vumat() {
  VumatCase c{"tests/material/vumat/old_habits.f", {200e9, 0.3}, 4};
  c.options.name = "hard";
  c.options.fields = {0, 0};
  c.density = 7850;
  return vumat_material(c);
}

TEST(UserMaterialSimulation, ElasticVumatMovesAPlateAsTheBuiltInLaw) {
  for (const Formulation formulation : {Formulation::one_point, Formulation::full}) {
    Simulation built_in(plate(ElasticMaterial{7850, 200e9, 0.3}, formulation));
    Simulation user(plate(elastic_vumat(), formulation));
    built_in.advance(1000);
    user.advance(1000);
    double most = 0, difference = 0;
    for (std::size_t i = 0; i < user.positions().size(); ++i) {
      const double x0 = user.model().mesh.coordinates[i];
      most = std::max(most, std::abs(built_in.positions()[i] - x0));
      difference = std::max(difference, std::abs(built_in.positions()[i] - user.positions()[i]));
    }
    EXPECT_GT(most, 1e-4);
    EXPECT_LT(difference, 2e-3 * most) << "strains are about 1e-3";
    EXPECT_NEAR(user.energies().balance(), 1, 1e-3);
    EXPECT_NEAR(user.stable_step(), built_in.stable_step(), 0.01 * built_in.stable_step());
    const auto& shown = std::get<UserMaterial>(user.model().materials[0].law);
    EXPECT_NEAR(shown.youngs_modulus, 200e9, 1e6);
    EXPECT_NEAR(shown.poissons_ratio, 0.3, 1e-5);
  }
}

TEST(UserMaterialSimulation, SameBitsForAnyNumberOfThreads) {
  std::vector<double> first;
  for (const int threads : {1, 2, 3}) {
    Model model = plate(elastic_vumat(), Formulation::full);
    model.threads = threads;
    Simulation simulation(std::move(model));
    simulation.advance(50);
    const std::vector<double> x(simulation.positions().begin(), simulation.positions().end());
    if (first.empty()) first = x;
    EXPECT_EQ(x, first) << threads;
  }
}

/// A bar torn by its ends: the elements that fail are deleted, listed and shown, and the energy stays
/// accounted for.
TEST(UserMaterialSimulation, TornBarInOutput) {
  VumatCase c{"tests/material/vumat/newer.f", {200e9, 0.3, 500e6}, 4};
  c.deletion_state = 0;
  c.density = 7850;
  UserMaterial material = vumat_material(c);
  material.state_names = {"active", "number"};
  Model model;
  scenes::add_box(model.mesh, "bar", {10, 1, 1}, {0.1, 0.01, 0.01});
  Part part;
  part.name = "bar";
  part.material = "brittle";
  part.formulation = Formulation::full;
  model.parts = {part};
  model.materials = {{"brittle", material}};
  model.prescribed_velocities = {{"bar_low_x", {true, false, false}, {}, {-10}},
                                 {"bar_high_x", {true, false, false}, {}, {10}}};
  model.time.end = 4e-5;
  model.threads = 1;
  Simulation simulation(std::move(model));
  simulation.advance(100000);
  EXPECT_TRUE(simulation.finished());
  const Summary summary = simulation.summary();
  ASSERT_FALSE(summary.deleted.empty());
  EXPECT_EQ(summary.deleted.front().part, "bar");
  EXPECT_GT(summary.deleted.front().time_s, 5e-6);
  const Frame frame = simulation.frame();
  std::vector<std::string> names;
  for (const ElementField& field : frame.fields) names.push_back(field.name);
  EXPECT_EQ(names,
            (std::vector<std::string>{"active", "number", "state_3", "state_4", "stress_xx", "stress_yy",
                                      "stress_zz", "stress_xy", "stress_yz", "stress_zx", "deleted"}));
  double gone = 0;
  for (std::size_t e = 0; e < 10; ++e) {
    gone += frame.fields[10].values[e];
    EXPECT_EQ(frame.fields[1].values[e], double(e) + 1);
    EXPECT_EQ(frame.fields[10].values[e] == 1, frame.fields[4].values[e] == 0) << e;
  }
  EXPECT_EQ(gone, double(summary.deleted.size()));
  EXPECT_NEAR(simulation.energies().balance(), 1, 0.02);

  const std::string folder = scratch_folder() + "/bar";
  Recorder recorder(folder, {});
  recorder.finish(frame, simulation.history(), summary);
  const std::string vtu = contents(folder + "/snapshots/0000.vtu"), json = contents(folder + "/summary.json");
  for (const char* name : {"\"active\"", "\"state_4\"", "\"stress_zx\"", "\"deleted\""}) {
    EXPECT_NE(vtu.find(name), std::string::npos) << name;
  }
  EXPECT_NE(json.find("\"deleted_elements\""), std::string::npos);
  EXPECT_NE(json.find("\"part\": \"bar\""), std::string::npos);
  EXPECT_NE(contents(folder + "/results.h5").find("state_4"), std::string::npos);
}

/// State variables, what has been deleted and the hidden memory of the law's host are in a saved run.
TEST(UserMaterialSimulation, GoesOnFromAFileInTheMiddleOfTearing) {
  VumatCase c{"tests/material/vumat/newer.f", {200e9, 0.3, 500e6}, 4};
  c.deletion_state = 0;
  c.density = 7850;
  for (const Formulation formulation : {Formulation::one_point, Formulation::full}) {
    Model model;
    scenes::add_box(model.mesh, "bar", {10, 2, 1}, {0.1, 0.02, 0.01});
    Part part;
    part.name = "bar";
    part.material = "brittle";
    part.formulation = formulation;
    model.parts = {part};
    model.materials = {{"brittle", vumat_material(c)}};
    model.prescribed_velocities = {{"bar_low_x", {true, false, false}, {}, {-10}},
                                   {"bar_high_x", {true, false, false}, {}, {10}}};
    model.time.end = 4e-5;
    model.threads = 1;
    Simulation whole(model), rest(model);
    while (whole.summary().deleted.empty()) whole.step();
    const std::string file = scratch_folder() + "/tearing.cdfp";
    whole.save(file);
    rest.restore(file);
    whole.advance(100000);
    rest.advance(100000);
    EXPECT_TRUE(rest.history().values == whole.history().values);
    const Frame f = whole.frame(), g = rest.frame();
    ASSERT_EQ(f.fields.size(), g.fields.size());
    for (std::size_t i = 0; i < f.fields.size(); ++i)
      EXPECT_TRUE(f.fields[i].values == g.fields[i].values) << i;
  }
}

/// A plate of elastic VUMAT that is torn cracks where and when the built-in law lets it.
TEST(UserMaterialSimulation, CracksAsTheBuiltInLaw) {
  std::vector<Index> counts;
  std::vector<double> times;
  for (const bool user : {false, true}) {
    Model model = plate(ElasticMaterial{7850, 200e9, 0.3}, Formulation::full);
    if (user) model.materials[0].law = elastic_vumat();
    CohesiveLaw law;
    law.name = "brittle";
    law.strength = 150e6;
    law.fracture_energy = 100;
    model.cohesive_laws = {law};
    model.parts[0].cohesive_law = "brittle";
    model.prescribed_velocities.push_back({"plate_high_x", {true, false, false}, {}, {8}});
    model.initial_velocities.clear();
    Simulation simulation(std::move(model));
    simulation.advance(250);
    counts.push_back(simulation.cohesive_count());
    times.push_back(simulation.summary().first_cracks.at(0).time_s);
    EXPECT_NEAR(simulation.energies().balance(), 1, 2e-3);
  }
  EXPECT_GT(counts[0], 10);
  EXPECT_NEAR(counts[1], counts[0], 0.1 * counts[0]);
  EXPECT_NEAR(times[1], times[0], 0.02 * times[0]);
}

TEST(UserMaterialSimulation, AfterAFailureTheStateIsReadable) {
  UserMaterial material = elastic_vumat();
  const auto law = material.callback;
  material.callback = [law](const MaterialPoints& p) {
    law(p);
    if (p.time > 1e-5) p.stress[0] = NAN;
  };
  Simulation simulation(plate(material, Formulation::one_point));
  try {
    simulation.advance(1000);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::diverged);
    EXPECT_NE(std::string(error.what()).find("material 'metal', element "), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("at time 10.4 us"), std::string::npos) << error.what();
  }
  EXPECT_EQ(simulation.step_count(), 25);
  for (const double x : simulation.positions()) EXPECT_TRUE(std::isfinite(x));
  EXPECT_TRUE(std::isfinite(simulation.energies().balance()));
  EXPECT_EQ(simulation.frame().von_mises.size(), 192U);
  EXPECT_NEAR(simulation.summary().simulated_time_s, 1e-5, 1e-9);
}

TEST(UserMaterialSimulation, BadMaterialsAreRefused) {
  const auto message = [](const std::function<void(UserMaterial&)>& spoil) {
    UserMaterial material = elastic_vumat();
    spoil(material);
    try {
      Simulation simulation(plate(material, Formulation::one_point));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::pair<std::function<void(UserMaterial&)>, const char*> cases[] = {
      {[](UserMaterial& m) { m.callback = nullptr; }, "needs a callback"},
      {[](UserMaterial& m) { m.density = 0; }, "density is 0"},
      {[](UserMaterial& m) { m.states = -1; }, "states must not be negative"},
      {[](UserMaterial& m) { m.deletion_state = 4; }, "deletion_state is 4; the law has states 0 to 3"},
      {[](UserMaterial& m) {
         m.state_names = {"a", "a"};
       },
       "two states are named 'a'"},
      {[](UserMaterial& m) { m.state_names = {"a<b"}; }, "may hold letters, digits"},
      {[](UserMaterial& m) { m.state_names = {"von_mises"}; }, "is an output's already"},
      {[](UserMaterial& m) { m.states = 2; }, "wrote past its 2 state variables"},
      {[](UserMaterial& m) { m.callback = [](const MaterialPoints&) {}; },
       "gave no stress like an elastic solid's"}};
  for (const auto& [spoil, text] : cases) {
    EXPECT_NE(message(spoil).find(text), std::string::npos) << message(spoil);
  }
}

}  // namespace
}  // namespace cdfp::test
