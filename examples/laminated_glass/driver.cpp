/// Impact on a laminated glass plate from a C++ program: the case of case_quick.toml, to the same bits.
///
///     laminated_glass_cpp [columns] [end time in s] [folder]
///
/// Besides the usual results the folder gets final_state.bin: positions, velocities and forces, (nodes, 3)
/// each.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <span>
#include <string>

#include "cdfp/error.hpp"
#include "cdfp/laminated_plate.hpp"
#include "cdfp/recorder.hpp"
#include "cdfp/simulation.hpp"

namespace {

cdfp::Model laminated_glass(cdfp::Index columns, double end) {
  cdfp::Model model;
  model.title = "Impact on a laminated glass plate, coarse and short";

  cdfp::LaminatedPlate plate;
  plate.columns = columns;
  plate.layout = cdfp::PlateColumns::regular;
  model.mesh = cdfp::laminated_plate_mesh(plate);

  model.materials = {
      {"glass", cdfp::ElasticMaterial{.density = 2500, .youngs_modulus = 74e9, .poissons_ratio = 0.20}},
      {"pvb", cdfp::RateDependentMaterial{.density = 1000,
                                          .poissons_ratio = 0.49,
                                          .static_modulus = 5.88e6,
                                          .rate_modulus = 29.21e6,
                                          .rate_exponent = 0.176,
                                          .smoothing_time = 1e-6}},
      {"rubber", cdfp::ElasticMaterial{.density = 1200, .youngs_modulus = 0.042e9, .poissons_ratio = 0.49}},
      {"steel", cdfp::RigidMaterial{.density = 7850, .youngs_modulus = 210e9, .poissons_ratio = 0.27}}};
  model.cohesive_laws = {{.name = "glass",
                          .strength = 60e6,
                          .fracture_energy = 10,
                          .mode_ratio = 5,
                          .shear_ratio = 1,
                          .friction = 0.1,
                          .internal_friction = 4.1}};
  model.parts = {
      {.name = "lower_glass",
       .material = "glass",
       .formulation = cdfp::Formulation::full,
       .cohesive_law = "glass"},
      {.name = "pvb", .material = "pvb", .formulation = cdfp::Formulation::full, .cohesive_law = {}},
      {.name = "upper_glass",
       .material = "glass",
       .formulation = cdfp::Formulation::full,
       .cohesive_law = "glass"},
      {.name = "support", .material = "rubber", .formulation = cdfp::Formulation::full, .cohesive_law = {}},
      {.name = "impactor", .material = "steel", .cohesive_law = {}}};

  model.rigid_bodies = {{.part = "impactor",
                         .mass = 8.875e-3,
                         .inertia = {},
                         .velocity = {0, 0, -6.78},
                         .translation_fixed = {true, true, false},
                         .rotation_fixed = {true, true, true}}};
  model.symmetry_planes = {{.axis = 0}, {.axis = 1}};
  model.prescribed_velocities = {
      {.node_set = "support_bottom", .directions = {true, true, true}, .times = {}, .values = {0.0}}};

  model.contact.surfaces = {"lower_glass_faces", "upper_glass_faces", "support_top", "impactor_head"};
  model.contact.cell_factor = 1.0;
  model.contact.buffer_factor = 0.4;
  model.contact.friction = 0.1;

  model.time.end = end;
  model.time.fixed_step = 6e-8;
  model.output.snapshot_times = {20e-6, 33e-6, 80e-6};
  return model;
}

void advance_to(cdfp::Simulation& simulation, double time) {
  while (!simulation.finished() && simulation.time() + 0.5 * simulation.step_size() < time) simulation.step();
}

void show(const cdfp::Simulation& simulation) {
  const cdfp::Simulation::BodyState impactor = simulation.body(0);
  std::printf("%10.3f%9.1f%14.4f%9.5f%9d%9d\n", 1e6 * simulation.time(), 4 * impactor.contact_force[2],
              impactor.velocity[2], simulation.energies().balance(), simulation.cohesive_count(),
              simulation.broken_count());
}

void run(cdfp::Index columns, double end, const std::string& folder) {
  cdfp::Simulation simulation(laminated_glass(columns, end));
  cdfp::Recorder recorder(folder, {"lower_glass", "upper_glass"});

  std::printf("   time us  force N  impactor m/s  balance  inserted   broken\n");
  for (const double time : simulation.model().output.snapshot_times) {
    if (time > end) break;
    advance_to(simulation, time);
    recorder.snapshot(simulation.frame());
    show(simulation);
  }
  if (!simulation.finished()) {
    advance_to(simulation, end);
    show(simulation);
  }
  recorder.finish(simulation.frame(), simulation.history(), simulation.summary());

  std::ofstream file(folder + "/final_state.bin", std::ios::binary);
  for (const std::span<const double> field :
       {simulation.positions(), simulation.velocities(), simulation.forces()}) {
    file.write(reinterpret_cast<const char*>(field.data()), static_cast<std::streamsize>(field.size_bytes()));
  }
}

}  // namespace

int main(int count, char** arguments) {
  try {
    run(count > 1 ? std::atoi(arguments[1]) : 25, count > 2 ? std::atof(arguments[2]) : 80e-6,
        count > 3 ? arguments[3] : "out/laminated_glass_cpp");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
