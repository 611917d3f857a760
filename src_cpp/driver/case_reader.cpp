#include "driver/case_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>
#include <vector>

#include "cdfp/error.hpp"
#include "cdfp/laminated_plate.hpp"
#include "cdfp/material_library.hpp"
#include "driver/toml_table.hpp"
#include "model/lookup.hpp"

namespace cdfp {

namespace {

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

LaminatedPlate read_laminated_plate(TomlTable& t) {
  static constexpr std::pair<const char*, PlateColumns> layouts[] = {{"regular", PlateColumns::regular},
                                                                     {"graded", PlateColumns::graded},
                                                                     {"o_grid", PlateColumns::o_grid},
                                                                     {"irregular", PlateColumns::irregular}};
  constexpr Range layer_count{.least = 1, .most = 1000};
  LaminatedPlate p;
  t.read("half_width", p.half_width, kPositive);
  t.read("lower_glass", p.lower_glass, kPositive);
  t.read("pvb", p.pvb, kPositive);
  t.read("upper_glass", p.upper_glass, kPositive);
  t.read("support", p.support, kPositive);
  t.read("lower_layers", p.lower_layers, layer_count);
  t.read("pvb_layers", p.pvb_layers, layer_count);
  t.read("upper_layers", p.upper_layers, layer_count);
  t.read("support_layers", p.support_layers, layer_count);
  t.read("columns", p.columns, {.least = 2, .most = 2000});
  t.choose<PlateColumns>("layout", p.layout, layouts);
  t.read("impactor_radius", p.impactor_radius, kPositive);
  t.read("impactor_shaft", p.impactor_shaft, kPositive);
  t.read("impactor_gap", p.impactor_gap, kNotNegative);
  t.read("impactor_refinement", p.impactor_refinement, {.least = 0, .most = 20, .least_excluded = true});
  return p;
}

Mesh read_mesh(TomlTable& top) {
  enum class Generator { laminated_plate };
  static constexpr std::pair<const char*, Generator> generators[] = {
      {"laminated_plate", Generator::laminated_plate}};
  top.require("mesh");
  TomlTable t = *top.table("mesh");
  t.require("generator");
  Generator generator{};
  t.choose<Generator>("generator", generator, generators);
  const LaminatedPlate plate = read_laminated_plate(t);
  t.finish();
  return laminated_plate_mesh(plate);
}

/// A path in a case file is meant from the file's folder.
std::string path_from(const std::string& case_file, const std::string& path) {
  return (std::filesystem::path(case_file).parent_path() / path).lexically_normal().string();
}

/// The library under `library`, or that of the source under `source`, compiled if need be.
std::string read_library(TomlTable& t, const std::string& case_file, const BuildOptions& build) {
  std::string library, source;
  t.read("library", library);
  t.read("source", source);
  if (library.empty() == source.empty()) {
    t.refuse(source.empty() ? "law" : "source", "a law from outside takes either 'source' or 'library'");
  }
  if (!library.empty()) return path_from(case_file, library);
  try {
    return built_material(path_from(case_file, source), build);
  } catch (const Error& error) {
    t.refuse("source", error.what());
  }
}

/// The number of the state under `delete_by`: its name, or what it would be called without one.
int read_deletion_state(TomlTable& t, const UserMaterial& material) {
  std::string name;
  t.read("delete_by", name);
  if (!t.has("delete_by")) return -1;
  std::vector<std::string> names;
  names.reserve(static_cast<std::size_t>(material.states));
  for (int k = 0; k < material.states; ++k) names.push_back(state_name(material, k));
  t.check_name("delete_by", name, names, "state");
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

UserMaterial read_user_law(TomlTable& t, const std::string& name, const std::string& case_file, bool vumat) {
  constexpr Range poisson{.least = -1, .most = 0.5, .least_excluded = true, .most_excluded = true};
  UserMaterial material;
  t.need("density", material.density, kPositive);
  t.read("youngs_modulus", material.youngs_modulus, kPositive);
  if (t.has("youngs_modulus")) t.require("poissons_ratio");
  t.read("poissons_ratio", material.poissons_ratio, poisson);
  t.read("properties", material.properties);
  t.read("states", material.states, {.least = 0, .most = 100000});
  t.read("state_names", material.state_names);
  if (material.state_names.size() > static_cast<std::size_t>(material.states)) {
    t.refuse("state_names", "'state_names' has " + std::to_string(material.state_names.size()) +
                                " names; the law has " + std::to_string(material.states) + " states");
  }
  material.deletion_state = read_deletion_state(t, material);
  t.read("thread_safe", material.thread_safe);
  VumatOptions options;
  BuildOptions build;
  std::string symbol = "cdfp_material";
  if (vumat) {
    options.name = name;
    options.job = std::filesystem::path(case_file).stem().string();
    options.folder = std::filesystem::absolute(case_file).parent_path().string();
    t.read("name", options.name);
    t.read("single_precision", options.single_precision);
    t.read("temperature", options.temperature);
    t.read("fields", options.fields);
    build.single_precision = options.single_precision;
  } else {
    t.read("function", symbol);
  }
  const std::string library = read_library(t, case_file, build);
  try {
    if (vumat) {
      load_vumat(library, options, material);
    } else {
      load_material(library, symbol, material);
    }
  } catch (const Error& error) {
    t.refuse(t.has("library") ? "library" : "source", error.what());
  }
  return material;
}

decltype(Material::law) read_law(TomlTable& t, const std::string& name, const std::string& case_file) {
  enum class Law { elastic, rate_dependent, rigid, vumat, library };
  static constexpr std::pair<const char*, Law> laws[] = {{"elastic", Law::elastic},
                                                         {"rate_dependent", Law::rate_dependent},
                                                         {"rigid", Law::rigid},
                                                         {"vumat", Law::vumat},
                                                         {"library", Law::library}};
  constexpr Range poisson{.least = -1, .most = 0.5, .least_excluded = true, .most_excluded = true};
  t.require("law");
  Law law{};
  t.choose<Law>("law", law, laws);
  const auto constants = [&](auto material) {
    t.need("density", material.density, kPositive);
    t.need("youngs_modulus", material.youngs_modulus, kPositive);
    t.need("poissons_ratio", material.poissons_ratio, poisson);
    return material;
  };
  if (law == Law::elastic) return constants(ElasticMaterial{});
  if (law == Law::rigid) return constants(RigidMaterial{});
  if (law == Law::vumat || law == Law::library) return read_user_law(t, name, case_file, law == Law::vumat);
  RateDependentMaterial material;
  t.need("density", material.density, kPositive);
  t.need("poissons_ratio", material.poissons_ratio, poisson);
  t.need("static_modulus", material.static_modulus, kPositive);
  t.need("rate_modulus", material.rate_modulus, kNotNegative);
  t.need("rate_exponent", material.rate_exponent, kNotNegative);
  t.need("smoothing_time", material.smoothing_time, kPositive);
  return material;
}

void read_materials(TomlTable& top, Model& model, const std::string& case_file) {
  top.require("materials");
  for (auto& [name, t] : top.named_tables("materials")) {
    model.materials.push_back({name, read_law(t, name, case_file)});
    t.finish();
  }
}

void read_cohesive_laws(TomlTable& top, Model& model) {
  static constexpr std::pair<const char*, CohesiveKind> kinds[] = {
      {"linear", CohesiveKind::linear},
      {"camacho_ortiz", CohesiveKind::camacho_ortiz},
      {"bilinear", CohesiveKind::bilinear}};
  for (auto& [name, t] : top.named_tables("cohesive_laws")) {
    CohesiveLaw law;
    law.name = name;
    t.need("strength", law.strength, kPositive);
    t.need("fracture_energy", law.fracture_energy, kPositive);
    t.read("mode_ratio", law.mode_ratio, kPositive);
    t.read("shear_ratio", law.shear_ratio, kPositive);
    t.read("friction", law.friction, kNotNegative);
    t.read("friction_exponent", law.friction_exponent, kPositive);
    t.read("internal_friction", law.internal_friction, kNotNegative);
    t.choose<CohesiveKind>("kind", law.kind, kinds);
    if (law.kind == CohesiveKind::bilinear) t.require("stiffness");
    t.read("stiffness", law.stiffness, kPositive);
    t.read("weibull_modulus", law.weibull_modulus, kPositive);
    t.read("weibull_area", law.weibull_area, kPositive);
    t.read("seed", law.seed);
    t.read("rate_sensitivity", law.rate_sensitivity, kPositive);
    if (law.rate_sensitivity > 0) t.require("reference_rate");
    t.read("reference_rate", law.reference_rate, kPositive);
    t.finish();
    model.cohesive_laws.push_back(std::move(law));
  }
}

/// The name of a table in `section` must be a part's.
void check_part(const TomlTable& t, const std::string& section, const std::string& name, const Mesh& mesh) {
  std::string names;
  for (const std::string& part : mesh.part_names) {
    if (part == name) return;
    names += (names.empty() ? "'" : ", '") + part + "'";
  }
  t.refuse_table("[" + section + "." + name + "]: the mesh has no part '" + name + "'; it has " + names);
}

void read_parts(TomlTable& top, Model& model) {
  static constexpr std::pair<const char*, Formulation> formulations[] = {
      {"one_point", Formulation::one_point}, {"full", Formulation::full}};
  top.require("parts");
  for (auto& [name, t] : top.named_tables("parts")) {
    check_part(t, "parts", name, model.mesh);
    Part part;
    part.name = name;
    t.need("material", part.material);
    t.check_name("material", part.material, names_of(model.materials), "material");
    t.choose<Formulation>("formulation", part.formulation, formulations);
    t.read("hourglass", part.hourglass, kPositive);
    t.read("cohesive_law", part.cohesive_law);
    if (t.has("cohesive_law")) {
      t.check_name("cohesive_law", part.cohesive_law, names_of(model.cohesive_laws), "cohesive law");
    }
    t.finish();
    model.parts.push_back(std::move(part));
  }
}

void read_bonds(TomlTable& top, Model& model) {
  for (TomlTable& t : top.table_array("bonds")) {
    Bond bond;
    t.need("cohesive_law", bond.cohesive_law);
    t.check_name("cohesive_law", bond.cohesive_law, names_of(model.cohesive_laws), "cohesive law");
    if (t.has("parts") == t.has("facet_set")) {
      t.refuse("cohesive_law", "a bond takes either 'parts' (two names) or 'facet_set'");
    }
    std::vector<std::string> parts;
    t.read("parts", parts);
    if (t.has("parts")) {
      if (parts.size() != 2) t.refuse("parts", "'parts' must name two parts");
      for (const std::string& part : parts) t.check_name("parts", part, model.mesh.part_names, "part");
      bond.parts = {parts[0], parts[1]};
    }
    t.read("facet_set", bond.facet_set);
    if (t.has("facet_set")) {
      t.check_name("facet_set", bond.facet_set, names_of(model.mesh.facet_sets), "facet set");
    }
    t.finish();
    model.bonds.push_back(std::move(bond));
  }
}

void read_fracture(TomlTable& top, Model& model) {
  static constexpr std::pair<const char*, StressRecovery> recoveries[] = {
      {"element_mean", StressRecovery::element_mean}, {"nodal", StressRecovery::nodal}};
  top.choose<StressRecovery>("stress_recovery", model.stress_recovery, recoveries);
  top.read("strength_shares", model.strength_shares, kPositive);
  if (top.has("strength_shares") && model.strength_shares.size() != model.mesh.types.size()) {
    top.refuse("strength_shares", "'strength_shares' has " + std::to_string(model.strength_shares.size()) +
                                      " numbers; the mesh has " + std::to_string(model.mesh.types.size()) +
                                      " elements");
  }
}

void read_rigid_bodies(TomlTable& top, Model& model) {
  for (auto& [name, t] : top.named_tables("rigid_bodies")) {
    check_part(t, "rigid_bodies", name, model.mesh);
    RigidBody body;
    body.part = name;
    t.need("mass", body.mass, kPositive);
    t.read("inertia", body.inertia);
    t.read("velocity", body.velocity);
    t.read("angular_velocity", body.angular_velocity);
    t.read("translation_fixed", body.translation_fixed);
    t.read("rotation_fixed", body.rotation_fixed);
    t.finish();
    model.rigid_bodies.push_back(std::move(body));
  }
}

void read_symmetry_planes(TomlTable& top, Model& model) {
  static constexpr std::pair<const char*, int> axes[] = {{"x", 0}, {"y", 1}, {"z", 2}};
  for (TomlTable& t : top.table_array("symmetry_planes")) {
    SymmetryPlane plane;
    t.require("axis");
    t.choose<int>("axis", plane.axis, axes);
    t.read("coordinate", plane.coordinate);
    t.finish();
    model.symmetry_planes.push_back(plane);
  }
}

void read_prescribed_velocities(TomlTable& top, Model& model) {
  for (TomlTable& t : top.table_array("prescribed_velocities")) {
    PrescribedVelocity p;
    t.need("node_set", p.node_set);
    t.check_name("node_set", p.node_set, names_of(model.mesh.node_sets), "node set");
    t.need("directions", p.directions);
    t.read("times", p.times, kNotNegative);
    t.need("values", p.values);
    if (p.times.empty() ? p.values.size() != 1 : p.values.size() != p.times.size()) {
      t.refuse("values", "'values' must have as many entries as 'times' (one if there are no times)");
    }
    for (std::size_t i = 1; i < p.times.size(); ++i) {
      if (p.times[i] <= p.times[i - 1]) t.refuse("times", "'times' must ascend");
    }
    t.finish();
    model.prescribed_velocities.push_back(std::move(p));
  }
}

void read_initial_velocities(TomlTable& top, Model& model) {
  for (auto& [name, t] : top.named_tables("initial_velocities")) {
    check_part(t, "initial_velocities", name, model.mesh);
    InitialVelocity v;
    v.part = name;
    t.need("velocity", v.velocity);
    std::optional<std::array<double, 9>> gradient;
    t.read("gradient", gradient);
    v.gradient = gradient.value_or(v.gradient);
    t.finish();
    model.initial_velocities.push_back(std::move(v));
  }
}

void read_contact(TomlTable& top, Model& model) {
  std::optional<TomlTable> t = top.table("contact");
  if (!t) return;
  ContactSettings& c = model.contact;
  t->need("surfaces", c.surfaces);
  for (const std::string& name : c.surfaces) {
    t->check_name("surfaces", name, names_of(model.mesh.facet_sets), "facet set");
  }
  t->read("cell_factor", c.cell_factor, kPositive);
  t->read("buffer_factor", c.buffer_factor, kPositive);
  t->read("penalty_factor", c.penalty_factor, kPositive);
  t->read("friction", c.friction, kNotNegative);
  t->read("depth_limit", c.depth_limit, kPositive);
  t->read("penetration_warning", c.penetration_warning, kPositive);
  t->read("edge_edge", c.edge_edge);
  t->read("adaptive", c.adaptive);
  t->finish();
}

void read_time(TomlTable& top, Model& model) {
  top.require("time");
  TomlTable t = *top.table("time");
  t.need("end", model.time.end, kPositive);
  t.read("fixed_step", model.time.fixed_step, kNotNegative);
  t.read("step_factor", model.time.step_factor, {.least = 0, .most = 1, .least_excluded = true});
  t.finish();
}

void read_output(TomlTable& top, Model& model) {
  std::optional<TomlTable> t = top.table("output");
  if (!t) return;
  t->read("snapshot_times", model.output.snapshot_times, kNotNegative);
  t->read("history_interval", model.output.history_interval, {.least = 1});
  t->read("restart_interval", model.output.restart_interval, {.least = 0});
  t->finish();
}

Model read_model(TomlTable& top, const std::string& case_file) {
  Model model;
  top.read("title", model.title);
  top.read("threads", model.threads, {.least = 0, .most = 1024});
  model.mesh = read_mesh(top);
  read_materials(top, model, case_file);
  read_cohesive_laws(top, model);
  read_parts(top, model);
  read_bonds(top, model);
  read_fracture(top, model);
  read_rigid_bodies(top, model);
  read_symmetry_planes(top, model);
  read_prescribed_velocities(top, model);
  read_initial_velocities(top, model);
  top.read("gravity", model.gravity);
  read_contact(top, model);
  read_time(top, model);
  read_output(top, model);
  top.finish();
  return model;
}

}  // namespace

Model parse_case(std::string_view text, const std::string& file) {
  try {
    const toml::table table = toml::parse(text, file);
    TomlTable top(table, "", file);
    return read_model(top, file);
  } catch (const toml::parse_error& error) {
    const toml::source_position place = error.source().begin;
    throw Error(Status::bad_input, file + ":" + std::to_string(place.line) + ":" +
                                       std::to_string(place.column) + ": " +
                                       std::string(error.description()));
  }
}

Model read_case(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf())) {
    throw Error(Status::io,
                "cannot read the case file '" + path + "'; check that it exists and is no folder");
  }
  return parse_case(text.view(), path);
}

}  // namespace cdfp
