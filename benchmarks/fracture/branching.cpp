#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "fracture/cases.hpp"
#include "fracture/report.hpp"
#include "fracture/scene.hpp"

namespace bench {

using namespace cdfp;

namespace {

constexpr double kE = 72e9, kRho = 2440, kNu = 0.22, kG = 3.8, kStress = 2e6, kRayleigh = 3100;
constexpr double kWidth = 100e-3, kHeight = 40e-3, kNotch = 50e-3;
/// The load comes in through soft, light pads above and below, whose grips move so far and stay: a stress
/// that hardly depends on what the plate does. P = E (e + 1.5 e^2 + 0.5 e^3) in the direction of the pull.
constexpr double kPad = 2e-3, kPadE = 5e6, kPadRho = 20, kStretch = 0.2768, kLoading = 4e-6;

struct Run {
  double forks = 0;             ///< m, where there first are two cracks
  double upper = 0, lower = 0;  ///< m, how far they are from the middle at last
  double speed = 0;             ///< m/s, from the notch to the fork
  double balance = 0;
  std::vector<CrackLine> cracks;
};

Run run(double h, double shift, double strength) {
  const double height = kHeight + 2 * kPad;
  Plate plate{.nx = static_cast<Index>(std::lround(kWidth / h)),
              .ny = static_cast<Index>(std::lround(height / h))};
  plate.width = kWidth, plate.height = height, plate.thickness = h;
  plate.y0 = -0.5 * height;
  plate.notch = kNotch;
  plate.part = [](double, double y) { return std::abs(y) > 0.5 * kHeight ? 1 : 0; };
  std::mt19937 random(1);
  plate.place = [&](double x, double y) {
    const auto draw = [&] { return shift * h * (2 * static_cast<double>(random()) / 0x1p32 - 1); };
    const bool inner = x > 0.5 * h && x < kWidth - 0.5 * h && std::abs(y) < 0.5 * kHeight - 0.5 * h;
    if (!inner || (std::abs(y) < 0.5 * h && x < kNotch + 0.5 * h)) return std::array<double, 2>{x, y};
    return std::array<double, 2>{x + draw(), y + draw()};
  };
  Mesh mesh = mesh_of(plate, {"plate", "pad"});
  Model model = model_of(std::move(mesh), {kRho, kE, kNu}, law_of(strength, kG), "plate");
  model.materials.push_back({"pad", ElasticMaterial{kPadRho, kPadE, 0}});
  model.parts[1].material = "pad";
  const double v = kStretch * kPad / kLoading;
  const double late = 1.0001 * kLoading;
  model.prescribed_velocities = {{"top", {false, true, false}, {0, kLoading, late}, {v, v, 0}},
                                 {"bottom", {false, true, false}, {0, kLoading, late}, {-v, -v, 0}},
                                 hold("all", {false, false, true})};
  model.time.end = 43e-6 + kLoading;
  Simulation s(std::move(model));
  s.advance(1000000);
  Run r;
  r.cracks = cracks_of(s);
  r.balance = s.energies().balance();
  fprintf(stderr, "steps %ld dt %g wall %g count %d broken %d\n", long(s.step_count()), s.stable_step(),
          s.summary().wall_s, s.cohesive_count(), s.broken_count());
  return r;
}

}  // namespace

/// Branching in soda-lime glass, such as Ha and Bobaru 2010: a notched plate under a sudden stress.
void branching() {
  for (const double strength : {8e6, 12e6}) {
    for (const double shift : {0.0, 0.25}) {
      const Run r = run(0.5e-3, shift, strength);
      char name[40];
      std::snprintf(name, sizeof name, "branching_%.0f_%.2f", strength * 1e-6, shift);
      draw_cracks(name, {r.cracks}, {0, -0.5 * kHeight}, {kWidth, 0.5 * kHeight});
    }
  }
}

}  // namespace bench
