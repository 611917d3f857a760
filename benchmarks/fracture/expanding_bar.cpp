#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "fracture/cases.hpp"
#include "fracture/report.hpp"
#include "fracture/scene.hpp"

namespace bench {

using namespace cdfp;

namespace {

constexpr double kE = 275e9, kRho = 2750, kStrength = 300e6, kG = 100, kLength = 50e-3;

/// Zhou, Molinari, Ramesh 2006.
double expected_fragments(double rate) {
  const double c = std::sqrt(kE / kRho);
  const double size = kE * kG / (kStrength * kStrength);
  const double x = rate * kE * kE * kG / (c * kStrength * kStrength * kStrength);
  return kLength / (size * 4.5 / (1 + 0.77 * std::pow(x, 0.25) + 5.4 * std::pow(x, 0.75)));
}

/// Fragments of a bar that stretches at a constant rate. Without any scatter it breaks everywhere at once;
/// its strength varies by `scatter` (standard deviation over mean) in waves, the shortest a third of a
/// fragment, the same on any mesh.
Index fragments(double rate, Index elements, double scatter) {
  const double h = kLength / elements;
  const Plate bar{.nx = elements, .width = kLength, .height = h, .thickness = h};
  Model model = model_of(mesh_of(bar, {"bar"}), {kRho, kE, 0}, law_of(kStrength, kG), "bar");
  const int waves = static_cast<int>(3 * expected_fragments(rate));
  std::mt19937 random(1);
  model.strength_shares.assign(static_cast<std::size_t>(elements), 1.0);
  for (int k = 1; k <= waves; ++k) {
    const double phase = 2 * std::numbers::pi * static_cast<double>(random()) / 0x1p32;
    for (Index e = 0; e < elements; ++e) {
      model.strength_shares[static_cast<std::size_t>(e)] +=
          scatter * std::sqrt(2.0 / waves) *
          std::cos(2 * std::numbers::pi * k * (e + 0.5) / elements + phase);
    }
  }
  const double speed = 0.5 * rate * kLength;
  model.prescribed_velocities = {{"left", {true, false, false}, {}, {-speed}},
                                 {"right", {true, false, false}, {}, {speed}}};
  model.initial_velocities = {{"bar", {-speed, 0, 0}, {rate, 0, 0, 0, 0, 0, 0, 0, 0}}};
  // Facets reach the strength at a strain of strength / E, then part by 2 G / strength.
  model.time.end =
      kStrength / kE / rate + 3 * 2 * kG / kStrength / (rate * kLength / expected_fragments(rate));
  Simulation s(std::move(model));
  s.advance(1000000);
  return s.broken_count() + 1;
}

}  // namespace

void expanding_bar() {
  Chart picture;
  picture.title = "Fragments of an expanding bar of 50 mm";
  picture.x_title = "log10 of the strain rate in 1/s";
  picture.y_title = "log10 of the number of fragments";
  Series theory{"Zhou, Molinari, Ramesh", {}, line_colour(0)}, found{"cdfp", {}, line_colour(1)};
  for (const auto& [rate, elements] : {std::pair{1e3, 2000}, {1e4, 4000}, {1e5, 8000}, {1e6, 16000}}) {
    const double wanted = expected_fragments(rate);
    const Index count = fragments(rate, elements, 0.005);
    char what[80];
    std::snprintf(what, sizeof what, "fragments at %.0e 1/s (%d) over %.0f", rate, count, wanted);
    report(what, count / wanted, 0.7, 1.3, "");
    picture.x.push_back(std::log10(rate));
    theory.y.push_back(std::log10(wanted));
    found.y.push_back(std::log10(count));
  }
  const double coarse = fragments(1e4, 2000, 0.01), fine = fragments(1e4, 4000, 0.01);
  report("1 % of scatter, 1e4 1/s: 4000 elements over 2000", fine / coarse, 0.95, 1.05, "");
  picture.series = {theory, found};
  picture.legend = true;
  chart("expanding_bar", picture);
}

}  // namespace bench
