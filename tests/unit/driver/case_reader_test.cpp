#include "driver/case_reader.hpp"

#include <gtest/gtest.h>

#include "cdfp/error.hpp"
#include "driver/nearest_word.hpp"
#include "scene/scene.hpp"

namespace cdfp {
namespace {

const std::string kCase = R"(title = "small plate"
gravity = [0, 0, -9.81]

[mesh]
generator = "laminated_plate"
layout = "regular"
columns = 4
impactor_gap = 1e-4

[materials.glass]
law = "elastic"
density = 2500
youngs_modulus = 74e9
poissons_ratio = 0.2

[materials.interlayer]
law = "rate_dependent"
density = 1000.0
poissons_ratio = 0.49
static_modulus = 5.88e6
rate_modulus = 29.21e6
rate_exponent = 0.176
smoothing_time = 1e-6

[materials.steel]
law = "rigid"
density = 7850
youngs_modulus = 210e9
poissons_ratio = 0.27

[cohesive_laws.glass]
strength = 60e6
fracture_energy = 10
mode_ratio = 5

[parts.lower_glass]
material = "glass"
cohesive_law = "glass"

[parts.pvb]
material = "interlayer"
formulation = "full"

[parts.upper_glass]
material = "glass"

[parts.support]
material = "glass"
hourglass = 0.5

[parts.impactor]
material = "steel"

[rigid_bodies.impactor]
mass = 8.875e-3
velocity = [0, 0, -6.78]
translation_fixed = ["x", "y"]
rotation_fixed = ["x", "y", "z"]

[[symmetry_planes]]
axis = "x"
[[symmetry_planes]]
axis = "y"
coordinate = 0.5

[[prescribed_velocities]]
node_set = "support_bottom"
directions = ["x", "z"]
values = [0.0]

[initial_velocities.pvb]
velocity = [1, 2, 3]

[contact]
surfaces = ["support_top", "impactor_head"]
friction = 0.1
edge_edge = false

[time]
end = 0.6e-3
fixed_step = 6e-8

[output]
snapshot_times = [33e-6, 120e-6]
history_interval = 10
restart_interval = 400
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kCase;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

void expect_refused(const std::string& text, const std::string& message) {
  try {
    parse_case(text, "plate.toml");
    ADD_FAILURE() << "was not refused; expected " << message;
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), Status::bad_input);
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos)
        << "expected: " << message << "\n     got: " << error.what();
  }
}

std::size_t glass_law_of(const Model& m) {
  return m.cohesive_laws[0].name == "glass" ? 0 : 1;
}

TEST(CaseReader, ReadsEverySection) {
  const Model m = parse_case(kCase, "plate.toml");
  EXPECT_EQ(m.title, "small plate");
  EXPECT_EQ(m.gravity[2], -9.81);
  EXPECT_EQ(m.mesh.element_count(), 10 * 16 + 2198);
  ASSERT_EQ(m.materials.size(), 3u);
  EXPECT_EQ(m.materials[0].name, "glass");
  EXPECT_EQ(std::get<ElasticMaterial>(m.materials[0].law).youngs_modulus, 74e9);
  const auto& pvb = std::get<RateDependentMaterial>(m.materials[1].law);
  EXPECT_EQ(pvb.density, 1000);
  EXPECT_EQ(pvb.poissons_ratio, 0.49);
  EXPECT_EQ(pvb.static_modulus, 5.88e6);
  EXPECT_EQ(pvb.rate_modulus, 29.21e6);
  EXPECT_EQ(pvb.rate_exponent, 0.176);
  EXPECT_EQ(pvb.smoothing_time, 1e-6);
  EXPECT_EQ(std::get<RigidMaterial>(m.materials[2].law).density, 7850);
  ASSERT_EQ(m.cohesive_laws.size(), 1u);
  EXPECT_EQ(m.cohesive_laws[0].kind, CohesiveKind::linear);
  EXPECT_EQ(m.cohesive_laws[0].strength, 60e6);
  EXPECT_EQ(m.cohesive_laws[0].fracture_energy, 10);
  EXPECT_EQ(m.cohesive_laws[0].mode_ratio, 5);
  EXPECT_EQ(m.cohesive_laws[0].shear_ratio, 1);
  ASSERT_EQ(m.parts.size(), 5u);
  EXPECT_EQ(m.parts[0].name, "lower_glass");
  EXPECT_EQ(m.parts[0].cohesive_law, "glass");
  EXPECT_EQ(m.parts[1].formulation, Formulation::full);
  EXPECT_EQ(m.parts[2].formulation, Formulation::one_point);
  EXPECT_EQ(m.parts[3].hourglass, 0.5);
  ASSERT_EQ(m.rigid_bodies.size(), 1u);
  EXPECT_EQ(m.rigid_bodies[0].mass, 8.875e-3);
  EXPECT_EQ(m.rigid_bodies[0].velocity[2], -6.78);
  EXPECT_FALSE(m.rigid_bodies[0].inertia);
  EXPECT_EQ(m.rigid_bodies[0].translation_fixed, (std::array{true, true, false}));
  EXPECT_EQ(m.rigid_bodies[0].rotation_fixed, (std::array{true, true, true}));
  ASSERT_EQ(m.symmetry_planes.size(), 2u);
  EXPECT_EQ(m.symmetry_planes[1].axis, 1);
  EXPECT_EQ(m.symmetry_planes[1].coordinate, 0.5);
  ASSERT_EQ(m.prescribed_velocities.size(), 1u);
  EXPECT_EQ(m.prescribed_velocities[0].directions, (std::array{true, false, true}));
  EXPECT_EQ(m.initial_velocities[0].velocity, (std::array{1.0, 2.0, 3.0}));
  EXPECT_EQ(m.contact.surfaces, (std::vector<std::string>{"support_top", "impactor_head"}));
  EXPECT_EQ(m.contact.friction, 0.1);
  EXPECT_FALSE(m.contact.edge_edge);
  EXPECT_EQ(m.time.fixed_step, 6e-8);
  EXPECT_EQ(m.output.snapshot_times, (std::vector{33e-6, 120e-6}));
  EXPECT_EQ(m.output.history_interval, 10);
  EXPECT_EQ(m.output.restart_interval, 400);
  EXPECT_NO_THROW(check_model(m));
}

TEST(CaseReader, ReadsBondsScatterAndRecovery) {
  const std::string bond =
      "[cohesive_laws.bond]\nkind = \"bilinear\"\nstrength = 8e6\nfracture_energy = 200\nstiffness = 1e13\n"
      "[[bonds]]\nparts = [\"pvb\", \"lower_glass\"]\ncohesive_law = \"bond\"\n"
      "[[bonds]]\nfacet_set = \"support_top\"\ncohesive_law = \"bond\"\n[contact]";
  std::string text = with("[contact]", bond);
  text.replace(text.find("mode_ratio = 5"), 14,
               "kind = \"camacho_ortiz\"\nweibull_modulus = 7\nweibull_area = 1e-6\nseed = 3\n"
               "rate_sensitivity = 0.05\nreference_rate = 1e-3");
  text.insert(0, "stress_recovery = \"nodal\"\n");
  const Model m = parse_case(text, "plate.toml");
  ASSERT_EQ(m.cohesive_laws.size(), 2u);
  const CohesiveLaw& glass = m.cohesive_laws[glass_law_of(m)];
  EXPECT_EQ(glass.kind, CohesiveKind::camacho_ortiz);
  EXPECT_EQ(glass.weibull_modulus, 7);
  EXPECT_EQ(glass.weibull_area, 1e-6);
  EXPECT_EQ(glass.seed, 3);
  EXPECT_EQ(glass.rate_sensitivity, 0.05);
  EXPECT_EQ(glass.reference_rate, 1e-3);
  const CohesiveLaw& law = m.cohesive_laws[1 - glass_law_of(m)];
  EXPECT_EQ(law.kind, CohesiveKind::bilinear);
  EXPECT_EQ(law.stiffness, 1e13);
  ASSERT_EQ(m.bonds.size(), 2u);
  EXPECT_EQ(m.bonds[0].parts, (std::array<std::string, 2>{"pvb", "lower_glass"}));
  EXPECT_EQ(m.bonds[1].facet_set, "support_top");
  EXPECT_EQ(m.bonds[1].cohesive_law, "bond");
  EXPECT_EQ(m.stress_recovery, StressRecovery::nodal);

  expect_refused(with("[contact]", "[[bonds]]\ncohesive_law = \"glass\"\n[contact]"),
                 "a bond takes either 'parts' (two names) or 'facet_set'");
  expect_refused(with("[contact]", "[[bonds]]\nparts = [\"pvb\"]\ncohesive_law = \"glass\"\n[contact]"),
                 "'parts' must name two parts");
  expect_refused(with("mode_ratio = 5", "kind = \"bilinear\""), "the key 'stiffness' is missing");
  expect_refused(with("mode_ratio = 5", "kind = \"linnear\""), "'linear'");
  expect_refused(with("mode_ratio = 5", "rate_sensitivity = 0.05"), "the key 'reference_rate' is missing");
  expect_refused(with("gravity", "strength_shares = [1.0, 0.5]\ngravity"),
                 "'strength_shares' has 2 numbers; the mesh has 2358 elements");
}

TEST(CaseReader, NamesUnknownKeysWithPlaceAndNearestKey) {
  expect_refused(with("density = 2500", "densty = 2500"),
                 "plate.toml:12:1: unknown key 'densty' in [materials.glass]; did you mean 'density'?");
  expect_refused(with("columns = 4", "  colums = 4"),
                 "plate.toml:7:3: unknown key 'colums' in [mesh]; did you mean 'columns'?");
  expect_refused(with("[contact]", "[kontact]"),
                 "unknown key 'kontact' at the top of the file; did you mean 'contact'?");
  expect_refused(with("gravity", "weather"),
                 "plate.toml:2:1: unknown key 'weather' at the top of the file; the keys are "
                 "'bonds', 'cohesive_laws', 'contact', ");
  expect_refused(with("strength = 60e6", "strength = 60e6\nstatic_modulus = 1.0"),
                 "unknown key 'static_modulus' in [cohesive_laws.glass]");
}

TEST(CaseReader, NamesWrongTypesWithPlace) {
  expect_refused(with("density = 2500", "density = \"2500\""),
                 "plate.toml:12:11: 'density' in [materials.glass] must be a number, not a string");
  expect_refused(with("columns = 4", "columns = 4.5"),
                 "plate.toml:7:11: 'columns' in [mesh] must be an integer, not a number");
  expect_refused(with("edge_edge = false", "edge_edge = 0"), "must be true or false, not an integer");
  expect_refused(with("[0, 0, -9.81]", "-9.81"),
                 "plate.toml:2:11: 'gravity' at the top of the file must be an array of 3 numbers");
  expect_refused(with("[0, 0, -9.81]", "[0, -9.81]"),
                 "'gravity' has 2 values; it must be an array of 3 numbers");
  expect_refused(with("[0, 0, -9.81]", "[0, true, 0]"),
                 "plate.toml:2:15: 'gravity' at the top of the file must be a number, not true or false");
  expect_refused(with("[0, 0, -9.81]", "[0, inf, 0]"), "'gravity' is not a finite number");
  expect_refused(with("[\"x\", \"z\"]", "[\"x\", \"u\"]"),
                 "'directions' must be an array of 'x', 'y' and 'z'");
  expect_refused(with("[time]\nend", "[[time]]\nend"),
                 "'time' at the top of the file must be a table, not an array");
}

TEST(CaseReader, NamesValuesOutOfRangeWithPlace) {
  expect_refused(with("density = 2500", "density = 0"),
                 "plate.toml:12:11: 'density' is 0; it must be positive");
  expect_refused(with("poissons_ratio = 0.2\n", "poissons_ratio = 0.5\n"),
                 "'poissons_ratio' is 0.5; it must be above -1 and below 0.5");
  expect_refused(with("friction = 0.1", "friction = -0.1"), "'friction' is -0.1; it must be 0 or more");
  expect_refused(with("columns = 4", "columns = 1"),
                 "'columns' is 1; it must be at least 2 and at most 2000");
  expect_refused(with("columns = 4", "columns = 99999999999"), "'columns' is 1e+11");
  expect_refused(with("restart_interval = 400", "restart_interval = -1"),
                 "'restart_interval' is -1; it must be 0 or more");
  expect_refused(with("[33e-6, 120e-6]", "[33e-6, -1]"), "'snapshot_times' is -1; it must be 0 or more");
  expect_refused(with("values = [0.0]", "values = [0.0, 1.0]"),
                 "'values' must have as many entries as 'times'");
  expect_refused(with("values = [0.0]", "times = [1.0, 0.5]\nvalues = [0.0, 1.0]"), "'times' must ascend");
}

TEST(CaseReader, NamesWhatIsMissing) {
  expect_refused(with("density = 2500\n", ""),
                 "plate.toml:10:1: the key 'density' is missing in [materials.glass]");
  expect_refused(with("end = 0.6e-3\n", ""), "the key 'end' is missing in [time]");
  expect_refused(with("generator = \"laminated_plate\"\n", ""), "the key 'generator' is missing in [mesh]");
  expect_refused("title = 'x'\n", "the key 'mesh' is missing at the top of the file");
}

TEST(CaseReader, NamesReferencesThatDoNotExist) {
  expect_refused(with("material = \"interlayer\"", "material = \"inter_layer\""),
                 "there is no material 'inter_layer'; did you mean 'interlayer'?");
  expect_refused(with("cohesive_law = \"glass\"", "cohesive_law = \"ice\""),
                 "there is no cohesive law 'ice'; there are 'glass'");
  expect_refused(with("[parts.pvb]", "[parts.pvc]"),
                 "plate.toml:40:1: [parts.pvc]: the mesh has no part 'pvc'; it has 'lower_glass', 'pvb'");
  expect_refused(with("\"support_bottom\"", "\"support_botom\""),
                 "there is no node set 'support_botom'; did you mean 'support_bottom'?");
  expect_refused(with("\"support_top\"", "\"supporttop\""),
                 "there is no facet set 'supporttop'; did you mean 'support_top'?");
  expect_refused(with("\"regular\"", "\"regulr\""),
                 "plate.toml:6:10: 'layout' is 'regulr'; did you mean 'regular'? It may be 'regular', "
                 "'graded', 'o_grid', 'irregular'");
  expect_refused(with("\"elastic\"", "\"plastic\""), "'law' is 'plastic'; did you mean 'elastic'?");
}

TEST(CaseReader, PassesSyntaxErrorsOnWithPlace) {
  expect_refused(with("columns = 4", "columns = "), "plate.toml:7:11: ");
  expect_refused(with("[materials.steel]", "[materials.glass]"), "plate.toml:");
  expect_refused(with("density = 2500", "density = 2500\ndensity = 2600"), "plate.toml:13:");
}

TEST(CaseReader, ReadsTheExamples) {
  const Model full = read_case(CDFP_EXAMPLES "/laminated_glass/case.toml");
  EXPECT_TRUE(check_model(full).empty());
  EXPECT_NEAR(full.mesh.element_count(), 47088, 0.01 * 47088);
  EXPECT_EQ(full.time.end / full.time.fixed_step, 10000);
  EXPECT_EQ(full.rigid_bodies[0].mass, 35.5e-3 / 4);
  EXPECT_EQ(full.rigid_bodies[0].velocity, (std::array{0.0, 0.0, -6.78}));
  const Model quick = read_case(CDFP_EXAMPLES "/laminated_glass/case_quick.toml");
  EXPECT_TRUE(check_model(quick).empty());
  EXPECT_LT(quick.mesh.element_count(), 10000);
  ASSERT_EQ(quick.materials.size(), full.materials.size());
  EXPECT_EQ(quick.cohesive_laws[0].strength, full.cohesive_laws[0].strength);
}

TEST(CaseReader, SaysWhenTheFileCannotBeRead) {
  for (const char* path : {"/nowhere/case.toml", "/tmp"}) {
    try {
      read_case(path);
      ADD_FAILURE() << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.status(), Status::io);
      EXPECT_NE(std::string(error.what()).find(path), std::string::npos);
    }
  }
}

TEST(NearestWord, CountsLettersAndSwaps) {
  const std::vector<std::string> words{"density", "strength", "fixed_step"};
  EXPECT_EQ(nearest_word("denisty", words), "density");
  EXPECT_EQ(nearest_word("fixedstep", words), "fixed_step");
  EXPECT_EQ(nearest_word("stength", words), "strength");
  EXPECT_EQ(nearest_word("colour", words), "");
}

/// The case with another material for the interlayer.
std::string with_interlayer(const std::string& keys) {
  const std::string text = kCase;
  const std::size_t begin = text.find("[materials.interlayer]"), end = text.find("[materials.", begin + 1);
  return text.substr(0, begin) + "[materials.interlayer]\n" + keys + "\n" + text.substr(end);
}

TEST(CaseReader, TellsWhatIsWrongWithMaterialsFromOutside) {
  const std::string vumat = "law = \"vumat\"\ndensity = 1000\n";
  const std::string library = "law = \"library\"\ndensity = 1000\n";
  expect_refused(with_interlayer(vumat), "takes either 'source' or 'library'");
  expect_refused(with_interlayer(vumat + "source = \"a.f\"\nlibrary = \"a.so\""),
                 "takes either 'source' or 'library'");
  expect_refused(with_interlayer(vumat + "source = \"nowhere.f\""), "cannot read the source 'nowhere.f'");
  expect_refused(with_interlayer(vumat + "source = \"nowhere.f\""), "plate.toml:");
  expect_refused(with_interlayer(vumat + "library = \"nowhere.so\""), "there is no library 'nowhere.so'");
  expect_refused(with_interlayer(library + "library = \"nowhere.so\"\nfunction = \"law\""),
                 "there is no library 'nowhere.so'");
  expect_refused(with_interlayer(vumat + "states = 2\nstate_names = [\"a\", \"b\", \"c\"]"),
                 "'state_names' has 3 names; the law has 2 states");
  expect_refused(with_interlayer(vumat + "states = 2\nstate_names = [\"strain\"]\ndelete_by = \"stat_2\""),
                 "'state_2'");
  expect_refused(with_interlayer(vumat + "youngs_modulus = 1e6"), "the key 'poissons_ratio' is missing");
  expect_refused(with_interlayer("law = \"vumat\""), "the key 'density' is missing");
  expect_refused(with_interlayer("law = \"vumatt\"\ndensity = 1000"), "'vumat'");
}

}  // namespace
}  // namespace cdfp
