/// What the fracture benchmarks print and draw.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cdfp/simulation.hpp"
#include "output/chart.hpp"

namespace bench {

inline const std::filesystem::path kPictures = "out/fracture";

/// One line: a figure, the range that it should lie in, and whether it does.
void report(const std::string& what, double figure, double low, double high, const char* unit);
/// A figure without such a range.
void note(const std::string& what, double figure, const char* unit);
/// What fell short so far; empty if nothing did.
const std::string& shortfall();

void chart(const std::string& name, const cdfp::Chart& c);

struct CrackLine {
  cdfp::Point a, b;
  double damage, time;
};

/// Cohesive facets of a plate seen along z, where its nodes are now; facets that lie in the plane show as
/// lines too.
std::vector<CrackLine> cracks_of(const cdfp::Simulation& s);

/// Panels side by side, all of the rectangle from `low` to `high`.
void draw_cracks(const std::string& name, const std::vector<std::vector<CrackLine>>& panels, cdfp::Point low,
                 cdfp::Point high);

}  // namespace bench
