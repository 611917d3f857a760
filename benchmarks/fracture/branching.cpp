#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "fracture/cases.hpp"
#include "fracture/report.hpp"
#include "fracture/scene.hpp"

namespace bench {

using namespace cdfp;

namespace {

constexpr double kE = 72e9, kRho = 2440, kNu = 0.22, kG = 3.8, kStrength = 10e6, kRayleigh = 3100;
constexpr double kWidth = 100e-3, kHeight = 40e-3, kNotch = 50e-3;
/// The stress of 2 MPa comes in through soft, light pads above and below, whose grips move so far and stay: a
/// stress that hardly depends on what the plate does. P = E (e + 1.5 e^2 + 0.5 e^3) in the direction of the
/// pull.
constexpr double kPad = 2e-3, kPadE = 5e6, kPadRho = 20, kStretch = 0.2768, kLoading = 4e-6;

/// m, the broken facets that lie highest and lowest between two places along the plate.
std::array<double, 2> spread(const std::vector<CrackLine>& cracks, double from, double to) {
  std::array<double, 2> y{kHeight, -kHeight};
  for (const CrackLine& c : cracks) {
    if (c.damage < 1 || c.a.x < from || c.a.x > to) continue;
    y = {std::min(y[0], c.a.y), std::max(y[1], c.a.y)};
  }
  return y;
}

}  // namespace

/// Branching in soda-lime glass (Ha and Bobaru 2010): a notched plate under a sudden stress.
void branching() {
  const double h = 1e-3;
  IrregularPlate plate{.h = h, .width = kWidth, .height = kHeight + 2 * kPad, .thickness = h};
  plate.y0 = -0.5 * kHeight - kPad;
  plate.notch = kNotch;
  Mesh mesh = mesh_of(plate, {"plate", "pad"});
  for (Index e = 0; e < mesh.element_count(); ++e) {
    double y = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const Index node = mesh.connectivity[4 * static_cast<std::size_t>(e) + c];
      y += 0.25 * mesh.coordinates[3 * static_cast<std::size_t>(node) + 1];
    }
    if (std::abs(y) > 0.5 * kHeight) mesh.parts[static_cast<std::size_t>(e)] = 1;
  }
  Model model = model_of(std::move(mesh), {kRho, kE, kNu}, law_of(kStrength, kG), "plate");
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
  const std::vector<CrackLine> cracks = cracks_of(s);
  const auto [lower, upper] = spread(cracks, kWidth - 8e-3, kWidth - 2e-3);
  double fork = kWidth - 8e-3;
  while (fork > kNotch) {
    const auto [low, high] = spread(cracks, fork - 2e-3, fork);
    if (high - low < 4e-3) break;
    fork -= 1e-3;
  }
  double begin = 1, end = 0;
  for (const CrackLine& c : cracks) {
    if (c.damage < 1 || c.a.x > fork) continue;
    begin = std::min(begin, c.time);
    end = std::max(end, c.time);
  }
  report("way from the notch to the fork", 1e3 * (fork - kNotch), 10, 40, "mm");
  report("its speed over c_R", (fork - kNotch) / (end - begin) / kRayleigh, 0.2, 1, "");
  report("two branches, at the far side apart by", 1e3 * (upper - lower), 6, 30, "mm");
  report("their middle off the notch, over that", std::abs(upper + lower) / (upper - lower), 0, 0.5, "");
  report("energy balance", s.energies().balance(), 0.99, 1.01, "");
  draw_cracks("branching", {cracks}, {0, -0.5 * kHeight}, {kWidth, 0.5 * kHeight});
}

}  // namespace bench
