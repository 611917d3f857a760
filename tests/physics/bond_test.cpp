// Bonds that stand from the start: between the parts of a bar, and between glass and PVB.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>

#include "cdfp/error.hpp"
#include "cdfp/simulation.hpp"
#include "driver/case_reader.hpp"
#include "scenes.hpp"

namespace cdfp {
namespace {

CohesiveLaw bond_law() {
  CohesiveLaw law;
  law.name = "bond";
  law.kind = CohesiveKind::bilinear;
  law.strength = 8e6;
  law.fracture_energy = 200;
  law.stiffness = 1e13;
  return law;
}

/// A bar of two parts; its right end is pulled away.
Model bonded_bar() {
  Model model;
  const double h = 1e-3;
  scenes::add_box(model.mesh, "left", {20, 2, 2}, {20 * h, 2 * h, 2 * h});
  model.mesh.part_names.push_back("right");
  for (Index e = 0; e < model.mesh.element_count(); ++e) model.mesh.parts[e] = e % 20 < 10 ? 0 : 1;
  model = scenes::with_part(std::move(model), "left", {2500, 74e9, 0});
  model = scenes::with_part(std::move(model), "right", {1100, 5e9, 0});
  model.cohesive_laws = {bond_law()};
  model.bonds = {{"", {"left", "right"}, "bond"}};
  model.prescribed_velocities = {{"left_low_x", {true, false, false}, {}, {0}},
                                 {"left_high_x", {true, false, false}, {0, 10e-6}, {0, 2}}};
  model.time.end = 120e-6;
  return model;
}

std::string refusal(Model model) {
  try {
    Simulation s(std::move(model));
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Bond, PartsInPiecesTakeTheBondsEnergy) {
  Simulation s(bonded_bar());
  EXPECT_EQ(s.cohesive_count(), 4);
  double mass = 0;
  for (const double m : s.masses()) mass += m;
  EXPECT_NEAR(mass, 10e-3 * 4e-6 * (2500 + 1100), 1e-12 * mass);
  s.advance(1000000);
  EXPECT_EQ(s.broken_count(), 4);
  const Summary summary = s.summary();
  EXPECT_NEAR(s.energies().cohesive_dissipated, 200 * 4e-6, 1e-3 * 200 * 4e-6);
  EXPECT_NEAR(summary.cohesive_dissipated_over_ga, 1, 1e-3);
  EXPECT_NEAR(s.energies().balance(), 1, 0.005);
  EXPECT_EQ(summary.cohesive_slope_cost_j, 0);
}

TEST(Bond, FacetSetsBondAsPartsDo) {
  Model model = bonded_bar();
  FacetSet set{"middle", {}};
  for (Index e = 0; e < model.mesh.element_count(); ++e) {
    if (e % 20 == 9) set.facets.push_back({e, 3});
  }
  model.mesh.facet_sets.push_back(set);
  model.bonds = {{"middle", {}, "bond"}};
  Simulation by_set(std::move(model));
  Simulation by_parts(bonded_bar());
  by_set.advance(300);
  by_parts.advance(300);
  ASSERT_EQ(by_set.positions().size(), by_parts.positions().size());
  EXPECT_TRUE(std::equal(by_set.positions().begin(), by_set.positions().end(), by_parts.positions().begin()));
}

TEST(Bond, RefusesWhatCannotBe) {
  Model model = bonded_bar();
  model.bonds[0].parts[1] = "rigth";
  EXPECT_NE(refusal(model).find("'rigth'"), std::string::npos);
  model = bonded_bar();
  model.bonds[0].parts[1] = "left";
  EXPECT_NE(refusal(model).find("the same"), std::string::npos);
  model = bonded_bar();
  model.cohesive_laws[0].kind = CohesiveKind::linear;
  model.cohesive_laws[0].stiffness = 0;
  EXPECT_NE(refusal(model).find("extrinsic"), std::string::npos);
  model = bonded_bar();
  model.cohesive_laws[0].stiffness = 1e11;
  EXPECT_NE(refusal(model).find("stiffness"), std::string::npos);
  model = bonded_bar();
  model.parts[0].cohesive_law = "bond";
  EXPECT_NE(refusal(model).find("bilinear"), std::string::npos);
  model = bonded_bar();
  model.cohesive_laws[0].kind = CohesiveKind::user;
  EXPECT_NE(refusal(model).find("callback"), std::string::npos);
  model = bonded_bar();
  model.cohesive_laws[0].kind = CohesiveKind::camacho_ortiz;
  model.cohesive_laws[0].stiffness = 0;
  model.cohesive_laws[0].mode_ratio = 5;
  EXPECT_NE(refusal(model).find("mode_ratio 1"), std::string::npos);
  model = bonded_bar();
  model.bonds.push_back(model.bonds[0]);
  EXPECT_NE(refusal(model).find("share no facet"), std::string::npos);
  model = bonded_bar();
  model.strength_shares = {1, 1};
  EXPECT_NE(refusal(model).find("strength_shares"), std::string::npos);
  model = bonded_bar();
  model.cohesive_laws[0].weibull_area = 1e-6;
  EXPECT_NE(refusal(model).find("weibull_area"), std::string::npos);
  model = bonded_bar();
  model.cohesive_laws[0].rate_sensitivity = 0.1;
  EXPECT_NE(refusal(model).find("reference_rate"), std::string::npos);
}

/// Linear, but it breaks at a tenth of a micrometre.
void stiff_bond(const CohesivePoints& p) {
  for (std::int64_t i = 0; i < p.count; ++i) {
    double dn = 0;
    for (int k = 0; k < 3; ++k) dn += p.opening[3 * i + k] * p.normal[3 * i + k];
    const double t = 1e15 * std::max(0.0, dn);
    for (int k = 0; k < 3; ++k) p.traction[3 * i + k] = t * p.normal[3 * i + k];
    p.stored[i] = 0.5 * t * std::max(0.0, dn);
    if (dn > 1e-7) p.damage[i] = 1;
  }
}

TEST(Bond, TheStepKnowsTheStiffnessOfAUsersLaw) {
  const auto run = [](double stiffness, double fixed_step) {
    Model model = bonded_bar();
    CohesiveLaw& law = model.cohesive_laws[0];
    law.kind = CohesiveKind::user;
    law.stiffness = stiffness;
    law.callback = stiff_bond;
    model.time.fixed_step = fixed_step;
    model.time.end = 20e-6;
    return Simulation(std::move(model));
  };
  Simulation automatic = run(1e15, 0);
  automatic.advance(1000000);
  EXPECT_EQ(automatic.summary().cohesive_slope_cost_j, 0);
  EXPECT_NEAR(automatic.energies().balance(), 1, 0.01);
  const double stable = run(0, 0).stable_step();
  EXPECT_LT(automatic.stable_step(), 0.2 * stable);
  Simulation beyond = run(1e15, 0.9 * stable);
  beyond.advance(1000000);
  EXPECT_GT(beyond.summary().cohesive_slope_cost_j, 0);
  EXPECT_LT(beyond.energies().balance(), 1.05) << "bounded, it stays stable";
}

TEST(Bond, LaminatedGlassDelaminatesWhereTheBondIsWeak) {
  const auto run = [](double strength, double energy) {
    std::ifstream file(CDFP_SOURCE_DIR "/examples/laminated_glass/case_quick.toml");
    std::ostringstream text;
    text << file.rdbuf();
    // Few columns: what is looked at is the bond.
    Model model = parse_case(
        std::regex_replace(text.str(), std::regex("\ncolumns = [0-9]+"), "\ncolumns = 8"), "case_quick.toml");
    model.threads = 1;
    CohesiveLaw law = bond_law();
    law.strength = strength;
    law.fracture_energy = energy;
    law.stiffness = 1e15;
    model.cohesive_laws.push_back(law);
    model.bonds = {{"", {"lower_glass", "pvb"}, "bond"}, {"", {"pvb", "upper_glass"}, "bond"}};
    for (Part& part : model.parts) part.cohesive_law.clear();
    model.time.end = 20e-6;
    Simulation s(std::move(model));
    s.advance(1000000);
    EXPECT_NEAR(s.summary().energy_balance_min, 1, 0.02);
    EXPECT_NEAR(s.summary().energy_balance_max, 1, 0.02);
    return s.broken_count();
  };
  EXPECT_EQ(run(100e6, 2000), 0);
  EXPECT_GT(run(0.2e6, 0.1), 0);
}

}  // namespace
}  // namespace cdfp
