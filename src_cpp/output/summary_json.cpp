#include "output/summary_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace cdfp {
namespace {

// nlohmann writes numbers that are not finite as null.
using Json = nlohmann::ordered_json;

Summary::FirstCrack first_crack(const Summary& summary, const std::string& part) {
  for (const Summary::FirstCrack& crack : summary.first_cracks)
    if (crack.part == part) return crack;
  return {};
}

Json text_or_null(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Json list_of(const std::vector<Summary::FirstCrack>& cracks) {
  Json list = Json::array();
  for (const Summary::FirstCrack& crack : cracks) {
    const bool came = std::isfinite(crack.time_s);
    list.push_back({{"part", crack.part},
                    {"time_s", crack.time_s},
                    {"layer", came && crack.layer != kNone ? Json(crack.layer) : Json()},
                    {"layer_face", text_or_null(crack.layer_face)},
                    {"position_m", came ? Json(crack.position) : Json()}});
  }
  return list;
}

Json list_of(const std::vector<Summary::ContactPair>& pairs) {
  Json list = Json::array();
  for (const Summary::ContactPair& pair : pairs) {
    list.push_back({{"parts", pair.parts},
                    {"peak_force_n", pair.peak_force_n},
                    {"stored_j", pair.stored_j},
                    {"friction_heat_j", pair.friction_heat_j},
                    {"deepest_penetration_m", pair.deepest_penetration_m}});
  }
  return list;
}

Json list_of(const std::vector<Summary::Deleted>& deleted) {
  Json list = Json::array();
  for (const Summary::Deleted& d : deleted) {
    list.push_back({{"element", d.element}, {"part", d.part}, {"time_s", d.time_s}});
  }
  return list;
}

}  // namespace

std::string summary_json(const Summary& s) {
  const Summary::FirstCrack upper = first_crack(s, "upper_glass");
  const Summary::FirstCrack lower = first_crack(s, "lower_glass");
  Json json = {
      {"title", s.title},
      {"elements", s.elements},
      {"nodes_initial", s.nodes_initial},
      {"nodes_final", s.nodes_final},
      {"segments_initial", s.segments_initial},
      {"segments_final", s.segments_final},
      {"steps", s.steps},
      {"simulated_time_s", s.simulated_time_s},
      {"dt_s", s.dt_s},
      {"dt_stable_s", s.dt_stable_s},
      {"dt_element", s.dt_element == kNone ? Json() : Json(s.dt_element)},
      {"wall_s", s.wall_s},
      {"threads", s.threads},
      {"peak_rss_mb", s.peak_rss_mb},
      {"energy_balance_min", s.energy_balance_min},
      {"energy_balance_max", s.energy_balance_max},
      {"hourglass_over_strain_max", s.hourglass_over_strain_max},
      {"hourglass_over_strain", Json::object()},
      {"cohesive_inserted", s.cohesive_inserted},
      {"cohesive_broken", s.cohesive_broken},
      {"cohesive_dissipated_over_GA", s.cohesive_dissipated_over_ga},
      {"cohesive_slope_cost_j", s.cohesive_slope_cost_j},
      {"first_contact_s", s.first_contact_s},
      {"first_crack_upper_s", upper.time_s},
      {"first_crack_upper_layer_face", text_or_null(upper.layer_face)},
      {"first_crack_upper_after_contact_s", upper.time_s - s.first_contact_s},
      {"first_crack_lower_s", lower.time_s},
      {"first_crack_lower_layer_face", text_or_null(lower.layer_face)},
      {"first_crack_lower_after_contact_s", lower.time_s - s.first_contact_s},
      {"first_crack_interval_s", lower.time_s - upper.time_s},
      {"first_cracks", list_of(s.first_cracks)},
      {"peak_force_n", s.peak_force_n},
      {"peak_force_time_s", s.peak_force_time_s},
      {"impactor_rebound_mps", s.impactor_rebound_mps},
      {"deepest_penetration_m", s.deepest_penetration_m},
      {"contact_pairs", list_of(s.contact_pairs)},
      {"deleted_elements", list_of(s.deleted)},
      {"stage_seconds", Json::object()},
      {"stage_calls", Json::object()},
      {"warnings", s.warnings},
  };
  for (const auto& part : s.hourglass_over_strain) json["hourglass_over_strain"][part.first] = part.second;
  for (const StageSeconds& stage : s.stages) {
    json["stage_seconds"][stage.name] = stage.seconds;
    json["stage_calls"][stage.name] = stage.calls;
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace cdfp
