#include "output/pictures.hpp"

#include <algorithm>
#include <span>
#include <string_view>

#include "output/files.hpp"
#include "output/history_pictures.hpp"
#include "output/scale.hpp"

namespace cdfp {
namespace {

constexpr std::size_t shown_panels = 6, kept_panels = 24;

Index part_number(const Frame& frame, const std::string& name) {
  const auto found = std::find(frame.part_names.begin(), frame.part_names.end(), name);
  return found == frame.part_names.end() ? kNone : static_cast<Index>(found - frame.part_names.begin());
}

std::string file_name(std::string part) {
  constexpr std::string_view ending = "_glass";
  if (part.size() > ending.size() && part.ends_with(ending)) part.resize(part.size() - ending.size());
  return "cracks_" + part + ".png";
}

/// Below the lowest nodes of the part "impactor", on the highest of the parts that crack.
std::optional<std::array<double, 3>> impact_point(const Frame& frame, const std::vector<Index>& crack_parts) {
  const Index impactor = part_number(frame, "impactor");
  double lowest = 0, count = 0, x = 0, y = 0, top = 0;
  bool any = false;
  std::size_t element = 0;
  for (std::size_t i = 0; impactor != kNone && i < frame.connectivity.size(); ++i) {
    while (static_cast<std::size_t>(frame.first_corner[element + 1]) <= i) ++element;
    const double* position = &frame.positions[3 * static_cast<std::size_t>(frame.connectivity[i])];
    const Index part = frame.parts[element];
    if (std::find(crack_parts.begin(), crack_parts.end(), part) != crack_parts.end()) {
      top = any ? std::max(top, position[2]) : position[2];
      any = true;
    }
    if (part != impactor) continue;
    if (count == 0 || position[2] < lowest - 1e-9) {
      lowest = position[2];
      count = x = y = 0;
    }
    if (position[2] > lowest + 1e-9) continue;
    x += position[0];
    y += position[1];
    ++count;
  }
  if (count == 0) return std::nullopt;
  return std::array<double, 3>{x / count, y / count, top};
}

/// Every second panel goes when many are there, so that a run of many snapshots needs bounded memory.
void add_panel(std::vector<CrackPanel>& panels, CrackPanel panel) {
  if (panels.size() == kept_panels)
    for (std::size_t k = 0; k < kept_panels / 2; ++k)
      panels.erase(panels.begin() + static_cast<std::ptrdiff_t>(k));
  panels.push_back(std::move(panel));
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
  begun_ = true;
  for (const std::string& part : parts_) numbers_.push_back(part_number(frame, part));
  const auto impact = impact_point(frame, numbers_);
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    CrackPicture picture;
    picture.part = spoken(parts_[i]);
    picture.copies = copies(frame.symmetry_planes, from_above);
    if (impact) picture.impact = from_above.project(impact->data());
    if (numbers_[i] != kNone) picture.outline = part_outline(frame, numbers_[i], frame.reference, from_above);
    cracks_.push_back(std::move(picture));
  }
  begin_section(frame, impact);
}

void Pictures::begin_section(const Frame& frame, const std::optional<std::array<double, 3>>& impact) {
  section_.copies = copies(frame.symmetry_planes, from_the_front);
  if (impact) section_.impact = from_the_front.project(impact->data());
  std::vector<Point> cracking;
  for (Index part = 0; part < static_cast<Index>(frame.part_names.size()); ++part) {
    if (frame.part_names[static_cast<std::size_t>(part)] == "impactor") continue;
    const bool cracks = std::find(numbers_.begin(), numbers_.end(), part) != numbers_.end();
    section_.bodies.push_back({part_outline(frame, part, frame.reference, from_the_front), cracks});
    const auto& outline = section_.bodies.back().outline;
    if (cracks) cracking.insert(cracking.end(), outline.begin(), outline.end());
  }
  if (cracking.empty()) return;
  // Twelve times as wide as high shows the whole thickness well.
  section_.shown = extent_of(cracking);
  const double middle =
      section_.impact ? section_.impact->x : 0.5 * (section_.shown.low.x + section_.shown.high.x);
  const double reach = 6 * section_.shown.height();
  section_.shown.low.x = std::max(section_.shown.low.x, middle - reach);
  section_.shown.high.x = std::min(section_.shown.high.x, middle + reach);
  section_depth_ = impact ? (*impact)[1] : 0;
}

void Pictures::keep(const Frame& frame) {
  if (!begun_) begin(frame);
  if (frame.time <= 0) return;
  const std::span<const double> positions = frame.reference;
  CrackPanel section{frame.time, {}};
  for (std::size_t i = 0; i < cracks_.size(); ++i) {
    CrackPanel panel{frame.time, {}};
    for (const CrackFacet& facet : frame.cracks) {
      if (facet.part != numbers_[i]) continue;
      panel.facets.push_back(see(facet, positions, from_above));
      if (const auto line = cut(facet, positions, from_the_front, section_depth_))
        section.facets.push_back(*line);
    }
    add_panel(cracks_[i].panels, std::move(panel));
  }
  add_panel(section_.panels, std::move(section));
  Archive kept;
  archive(kept);
  make_folder(kept_file().parent_path());
  write_whole_file(kept_file(), kept.bytes());
}

void Pictures::take_up(double time) {
  const std::string bytes = contents_of(kept_file());
  if (bytes.empty()) return;
  Pictures earlier(folder_, {});
  try {
    Archive kept(bytes);
    earlier.archive(kept);
  } catch (const Error&) {
    return;  // of another build: pictures show what comes
  }
  if (earlier.parts_ != parts_) return;
  *this = std::move(earlier);
  const auto is_later = [time](const CrackPanel& panel) { return panel.time > time; };
  for (CrackPicture& picture : cracks_) std::erase_if(picture.panels, is_later);
  std::erase_if(section_.panels, is_later);
}

void Pictures::archive(Archive& a) {
  const auto panels = [&a](std::vector<CrackPanel>& list) {
    std::uint64_t count = list.size();
    a("panels", count);
    list.resize(count);
    for (CrackPanel& panel : list) {
      a("time", panel.time);
      a("facets", panel.facets);
    }
  };
  a("parts", parts_);
  a("numbers", numbers_);
  a("begun", begun_);
  a("section_depth", section_depth_);
  std::uint64_t count = cracks_.size();
  a("cracks", count);
  cracks_.resize(count);
  for (CrackPicture& picture : cracks_) {
    a("part", picture.part);
    a("outline", picture.outline);
    a("copies", picture.copies);
    a("impact", picture.impact);
    panels(picture.panels);
  }
  count = section_.bodies.size();
  a("bodies", count);
  section_.bodies.resize(count);
  for (SectionPicture::Body& body : section_.bodies) {
    a("outline", body.outline);
    a("cracks", body.cracks);
  }
  a("shown", section_.shown);
  a("copies", section_.copies);
  a("impact", section_.impact);
  panels(section_.panels);
}

void Pictures::draw(const History& history, const Summary& summary) const {
  for (std::size_t i = 0; i < cracks_.size(); ++i) {
    CrackPicture picture = cracks_[i];
    picture.panels = choose_panels(picture.panels, shown_panels);
    draw_crack_picture(folder_ / file_name(parts_[i]), picture);
  }
  SectionPicture section = section_;
  section.panels = choose_panels(section.panels, shown_panels);
  draw_section_picture(folder_ / "section.png", section);
  draw_history(folder_, history, summary);
}

}  // namespace cdfp
