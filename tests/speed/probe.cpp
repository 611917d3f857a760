// Does one kind of work again and again, for callgrind to count: probe WORK ROUNDS.
// The difference of two runs with unlike ROUNDS is free of set-up.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "cdfp/laminated_plate.hpp"
#include "cdfp/simulation.hpp"
#include "element/element_force.hpp"
#include "integrator/central_difference.hpp"
#include "support/plate.hpp"

namespace {

using namespace cdfp;
using bench::Shape;

/// 256 elements, or twice as many wedges: whole blocks.
Model box(Shape shape, Formulation formulation, bool rate_dependent) {
  constexpr Index kColumns = 8;
  Model model = bench::plate(shape, formulation, rate_dependent, kColumns);
  model.threads = 1;  // threads that wait would count too
  return model;
}

/// Instructions are reported for this many updates a round.
int forces(const Model& model, int rounds) {
  ElementForce elements(model);
  std::vector<double> x = model.mesh.coordinates, force(x.size());
  for (int round = 0; round < rounds; ++round) {
    for (double& c : x) c += round % 2 ? 1e-9 : -1e-9;
    elements.add_force(x, force, 6e-8, Threads(1));
  }
  return model.mesh.element_count();
}

int advance(int rounds) {
  const Model model = box(Shape::extruded, Formulation::one_point, false);
  Nodes nodes(model.mesh.coordinates);
  for (double& m : nodes.mass) m = 1;
  for (int round = 0; round < rounds; ++round) {
    drift(6e-8, nodes, Threads(1));
    accelerate(6e-8, nodes, Threads(1));
  }
  return nodes.count();
}

/// Panes on a support: elements, contact at rest, criterion, history.
int plate_steps(int rounds) {
  LaminatedPlate plate;
  plate.columns = 10;
  plate.layout = PlateColumns::regular;
  Model model;
  model.mesh = laminated_plate_mesh(plate);
  model.materials = {{"glass", ElasticMaterial{2500, 74e9, 0.20}},
                     {"pvb", RateDependentMaterial{1000, 0.49, 5.88e6, 29.21e6, 0.176, 1e-6}},
                     {"rubber", ElasticMaterial{1200, 0.042e9, 0.49}},
                     {"steel", RigidMaterial{7850, 210e9, 0.27}}};
  CohesiveLaw law;
  law.name = "glass";
  law.strength = 60e6;
  law.fracture_energy = 10;
  model.cohesive_laws = {law};
  const auto part = [&](const char* name, const char* material, const char* cohesive_law) {
    Part p;
    p.name = name;
    p.material = material;
    p.formulation = Formulation::full;
    p.cohesive_law = cohesive_law;
    model.parts.push_back(p);
  };
  part("lower_glass", "glass", "glass");
  part("pvb", "pvb", "");
  part("upper_glass", "glass", "glass");
  part("support", "rubber", "");
  part("impactor", "steel", "");
  RigidBody impactor;
  impactor.part = "impactor";
  impactor.mass = 8.875e-3;
  impactor.velocity = {0, 0, -1};
  model.rigid_bodies = {impactor};
  model.symmetry_planes = {{0, 0.0}, {1, 0.0}};
  model.contact.surfaces = {"lower_glass_faces", "upper_glass_faces", "support_top", "impactor_head"};
  model.contact.friction = 0.1;
  model.threads = 1;
  model.time.end = 1e-3;
  model.time.fixed_step = 6e-8;
  Simulation simulation(model);
  simulation.advance(rounds);
  return model.mesh.element_count();
}

int run(const std::string& work, int rounds) {
  if (work == "one_point_extruded")
    return forces(box(Shape::extruded, Formulation::one_point, false), rounds);
  if (work == "one_point_distorted")
    return forces(box(Shape::distorted, Formulation::one_point, false), rounds);
  if (work == "one_point_pvb") return forces(box(Shape::extruded, Formulation::one_point, true), rounds);
  if (work == "full_extruded") return forces(box(Shape::extruded, Formulation::full, false), rounds);
  if (work == "full_distorted") return forces(box(Shape::distorted, Formulation::full, false), rounds);
  if (work == "full_pvb") return forces(box(Shape::extruded, Formulation::full, true), rounds);
  if (work == "wedge") return forces(box(Shape::wedges, Formulation::one_point, false), rounds);
  if (work == "advance_node") return advance(rounds);
  if (work == "plate_step") return plate_steps(rounds);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const int updates = argc == 3 ? run(argv[1], std::atoi(argv[2])) : 0;
  if (updates == 0) {
    std::fprintf(stderr, "usage: probe WORK ROUNDS\n");
    return 2;
  }
  std::printf("updates a round: %d\n", updates);
  return 0;
}
