#include "output/pictures.hpp"

#include <algorithm>
#include <optional>

#include "output/history_pictures.hpp"

namespace cdfp {
namespace {

constexpr std::size_t shown_panels = 6, kept_panels = 24;

Index part_number(const Frame& frame, const std::string& name) {
  const auto found = std::find(frame.part_names.begin(), frame.part_names.end(), name);
  return found == frame.part_names.end() ? kNone : static_cast<Index>(found - frame.part_names.begin());
}

std::string spoken(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string file_name(std::string part) {
  constexpr std::string_view ending = "_glass";
  if (part.size() > ending.size() && part.ends_with(ending)) part.resize(part.size() - ending.size());
  return "cracks_" + part + ".png";
}

/// Below the lowest nodes of the part "impactor".
std::optional<Point> impact_point(const Frame& frame) {
  const Index part = part_number(frame, "impactor");
  double lowest = 0, count = 0;
  Point sum;
  for (std::size_t i = 0; part != kNone && i < frame.hexahedra.size(); ++i) {
    if (frame.parts[i / 8] != part) continue;
    const double* position = &frame.positions[3 * static_cast<std::size_t>(frame.hexahedra[i])];
    if (count == 0 || position[2] < lowest - 1e-9) {
      lowest = position[2];
      count = 0;
      sum = {};
    }
    if (position[2] > lowest + 1e-9) continue;
    sum = {sum.x + position[0], sum.y + position[1]};
    ++count;
  }
  if (count == 0) return std::nullopt;
  return Point{sum.x / count, sum.y / count};
}

}  // namespace

std::vector<CrackPanel> choose_panels(const std::vector<CrackPanel>& panels, std::size_t count) {
  if (panels.size() <= count) return panels;
  std::vector<CrackPanel> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(panels[(i + 1) * panels.size() / count - 1]);
  return chosen;
}

Pictures::Pictures(std::filesystem::path folder, std::vector<std::string> crack_parts)
    : folder_(std::move(folder)), parts_(std::move(crack_parts)) {}

void Pictures::begin(const Frame& frame) {
  for (const std::string& part : parts_) {
    const Index number = part_number(frame, part);
    CrackPicture picture;
    picture.part = spoken(part);
    picture.copies = copies(frame.symmetry_planes, from_above);
    picture.impact = impact_point(frame);
    if (number != kNone) picture.outline = part_outline(frame, number, undeformed_.positions(), from_above);
    numbers_.push_back(number);
    cracks_.push_back(std::move(picture));
  }
}

void Pictures::keep(const Frame& frame) {
  undeformed_.update(frame);
  if (cracks_.empty()) begin(frame);
  if (frame.time <= 0) return;
  for (std::size_t i = 0; i < cracks_.size(); ++i) {
    std::vector<CrackPanel>& panels = cracks_[i].panels;
    // Every second panel goes when many are there, so that a run of many snapshots needs bounded memory.
    if (panels.size() == kept_panels)
      for (std::size_t k = 0; k < kept_panels / 2; ++k)
        panels.erase(panels.begin() + static_cast<std::ptrdiff_t>(k));
    CrackPanel panel{frame.time, {}};
    for (const CrackFacet& facet : frame.cracks)
      if (facet.part == numbers_[i]) panel.facets.push_back(see(facet, undeformed_.positions(), from_above));
    panels.push_back(std::move(panel));
  }
}

void Pictures::draw(const History& history, const Summary& summary) const {
  for (std::size_t i = 0; i < cracks_.size(); ++i) {
    CrackPicture picture = cracks_[i];
    picture.panels = choose_panels(picture.panels, shown_panels);
    draw_crack_picture(folder_ / file_name(parts_[i]), picture);
  }
  draw_history(folder_, history, summary);
}

}  // namespace cdfp
