// The blocks of section 6.2, run and drawn: blocks [OUT_DIR]
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "blocks.hpp"
#include "cdfp/simulation.hpp"
#include "cdfp/topology.hpp"

namespace {

using blocks::Vector;
using cdfp::Index;

Vector at(const cdfp::Simulation& s, Index node) {
  const double* x = &s.positions()[3 * static_cast<std::size_t>(node)];
  return {x[0], x[1], x[2]};
}

/// Frames side by side as a drawing in SVG: the outside of all parts, seen from the front right above.
class Drawing {
 public:
  /// `low` and `high`: what of space is shown, m.
  Drawing(const Vector& low, const Vector& high) {
    for (int corner = 0; corner < 8; ++corner) {
      const Seen p =
          see({corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1], corner & 4 ? high[2] : low[2]});
      left_ = std::min(left_, p.x), right_ = std::max(right_, p.x);
      top_ = std::min(top_, p.y), bottom_ = std::max(bottom_, p.y);
    }
    scale_ = kFrame / (right_ - left_);
  }

  void add_frame(const cdfp::Simulation& s) {
    struct Face {
      double depth;
      std::string drawn;
    };
    std::vector<Face> faces;
    const cdfp::Mesh& mesh = s.model().mesh;
    for (const cdfp::FacetSet& set : mesh.facet_sets) {
      for (const cdfp::FacetUse use : set.facets) {
        const cdfp::FacetNodes facet = s.topology().facet_nodes(use);
        std::array<Seen, 4> corners{};
        double depth = 0, area = 0;
        for (std::size_t i = 0; i < 4; ++i) {
          corners[i] = see(at(s, facet.nodes[i]));
          depth += corners[i].depth / 4;
        }
        for (std::size_t i = 0; i < 4; ++i) {
          const Seen &a = corners[i], &b = corners[(i + 1) % 4];
          area += a.y * b.x - a.x * b.y;  // y goes down
        }
        if (area > 0) faces.push_back({depth, draw(corners, mesh.parts[use.element], slope(s, facet))});
      }
    }
    std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.depth < b.depth; });
    for (const Face& face : faces) text_ += face.drawn;
    char label[100];
    std::snprintf(label, sizeof label, "<text x=\"%.0f\" y=\"14\">%.2f ms</text>\n", kFrame * frames_ + 6.0,
                  1e3 * s.time());
    text_ += label;
    ++frames_;
  }

  void write(const std::filesystem::path& file) const {
    std::ofstream out(file);
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << kFrame * frames_ << "\" height=\""
        << std::ceil(scale_ * (bottom_ - top_)) + kTitle
        << "\" font-family=\"sans-serif\" font-size=\"12\" stroke=\"#444\" stroke-width=\".4\">\n"
        << "<style>text{stroke:none}</style>\n"
        << text_ << "</svg>\n";
  }

 private:
  static constexpr double kFrame = 210, kTitle = 20;  // px

  struct Seen {
    double x, y, depth;
  };
  static Seen see(const Vector& p) {
    const double c = std::cos(0.5), s = std::sin(0.5), up = 0.9, flat = std::sqrt(1 - up * up);
    const double across = c * p[0] + s * p[1], away = -s * p[0] + c * p[1];
    return {across, -(up * p[2] + flat * away), flat * p[2] - up * away};
  }
  /// Of the facet's normal against the light.
  static double slope(const cdfp::Simulation& s, const cdfp::FacetNodes& facet) {
    const Vector a = at(s, facet.nodes[0]), b = at(s, facet.nodes[1]), d = at(s, facet.nodes[3]);
    const Vector p{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, q{d[0] - a[0], d[1] - a[1], d[2] - a[2]};
    const Vector n{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
    return (0.35 * n[0] - 0.25 * n[1] + 0.9 * n[2]) / std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  }
  std::string draw(const std::array<Seen, 4>& corners, Index part, double slope) const {
    constexpr std::array<std::array<double, 3>, 7> kColours{{{120, 160, 200},
                                                             {215, 165, 95},
                                                             {135, 180, 135},
                                                             {195, 135, 135},
                                                             {160, 145, 195},
                                                             {190, 185, 120},
                                                             {225, 120, 80}}};
    const auto& colour = kColours[static_cast<std::size_t>(part) % kColours.size()];
    const double light = 0.75 + 0.3 * slope;
    char text[200];
    const auto level = [&](int d) { return static_cast<int>(std::clamp(light * colour[d], 0.0, 255.0)); };
    std::snprintf(text, sizeof text, "<path fill=\"#%02x%02x%02x\" d=\"M", level(0), level(1), level(2));
    std::string drawn = text;
    for (const Seen& p : corners) {
      std::snprintf(text, sizeof text, "%.1f %.1f ", scale_ * (p.x - left_) + kFrame * frames_,
                    scale_ * (p.y - top_) + kTitle);
      drawn += text;
    }
    return drawn + "z\"/>\n";
  }

  double left_ = 1e30, right_ = -1e30, top_ = 1e30, bottom_ = -1e30, scale_ = 1;
  int frames_ = 0;
  std::string text_;
};

void run(cdfp::Model model, const std::vector<double>& times, Drawing drawing,
         const std::filesystem::path& picture) {
  cdfp::Simulation s(std::move(model));
  for (const double time : times) {
    while (s.time() + 0.5 * s.step_size() < time && !s.finished()) s.step();
    drawing.add_frame(s);
  }
  s.advance(s.model().time.end > s.time() ? 1000000 : 0);
  drawing.write(picture);
  const cdfp::Summary summary = s.summary();
  std::printf("%s: %lld steps of %.0f ns, energy balance %.4f to %.4f\n", summary.title.c_str(),
              static_cast<long long>(summary.steps), 1e9 * summary.dt_s, summary.energy_balance_min,
              summary.energy_balance_max);
  for (const cdfp::Summary::ContactPair& pair : summary.contact_pairs) {
    std::printf("  %s on %s: at most %.0f N, %.1f um deep\n", pair.parts[1].c_str(), pair.parts[0].c_str(),
                pair.peak_force_n, 1e6 * pair.deepest_penetration_m);
  }
  for (const std::string& warning : summary.warnings) std::printf("  %s\n", warning.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::filesystem::path out = argc > 1 ? argv[1] : "out/blocks";
    std::filesystem::create_directories(out);
    run(blocks::case_1(), {0, 0.2e-3, 0.44e-3, 0.5e-3}, {{-4.5e-3, -4.2e-3, -4.5e-3}, {5.5e-3, 4.2e-3, 5e-3}},
        out / "case_1.svg");
    run(blocks::case_2(), {0, 0.09e-3, 0.18e-3, 0.25e-3},
        {{-2.5e-3, -2.5e-3, -2.5e-3}, {12.5e-3, 4e-3, 12.5e-3}}, out / "case_2.svg");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
