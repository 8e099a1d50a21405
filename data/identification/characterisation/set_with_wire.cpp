#include "data/identification/characterisation/set_with_wire.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/units.h"

namespace ostium::data {

namespace {

using Json = nlohmann::ordered_json;

using units::mm, units::Nmm2;
constexpr double shortest_mm = 1e-6;

/// One section in pieces, each with the stiffness of the stretch that it lies on.
void cut(const Json& section, const WireInSet& wire, Json& out) {
  const double from = section["from_tip_mm"][0], to = section["from_tip_mm"][1];
  std::vector<double> ends = {from, to};
  for (const DeclaredStretch& s : wire.stretches)
    for (const double end : {s.from_tip_m / mm, s.to_tip_m / mm})
      if (end > from + shortest_mm && end < to - shortest_mm) ends.push_back(end);
  std::sort(ends.begin(), ends.end());
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (ends[i + 1] - ends[i] < shortest_mm) continue;
    Json piece = section;
    piece["from_tip_mm"] = {ends[i], ends[i + 1]};
    const double middle_m = (ends[i] + ends[i + 1]) / 2 * mm;
    for (const DeclaredStretch& s : wire.stretches) {
      if (middle_m < s.from_tip_m || middle_m > s.to_tip_m) continue;
      if (piece.contains("EI_Nmm2")) piece["EI_Nmm2"] = s.EI_N_m2 / Nmm2;
      if (piece.contains("GJ_Nmm2")) piece["GJ_Nmm2"] = s.GJ_N_m2 / Nmm2;
    }
    out.push_back(std::move(piece));
  }
}

/// A stiffness that a fit found for what was declared is not one of what takes its place.
void forget_fitted_stiffness(Json& file) {
  if (!file.contains("fitted")) return;
  Json kept = Json::object();
  for (const auto& [name, value] : file["fitted"].items())
    if (name.rfind("EI_scale", 0) != 0 && name.rfind("GJ_scale", 0) != 0) kept[name] = value;
  file["fitted"] = std::move(kept);
}

}  // namespace

JsonValue set_with(const JsonValue& root, const WireInSet& wire) {
  const JsonValue* instruments = root.find("instruments");
  const bool one = instruments && instruments->items.size() == 1;
  if (!one || !instruments->items[0].find("sections"))
    root.fail("a set of one instrument with sections is needed: only its stiffness can be taken from elsewhere");
  Json file = Json::parse(to_json(root));
  Json cut_up = Json::array();
  for (const Json& section : file["instruments"][0]["sections"]) cut(section, wire, cut_up);
  file["instruments"][0]["sections"] = std::move(cut_up);
  forget_fitted_stiffness(file);
  if (wire.friction) {
    if (file.contains("rig") && file["rig"].contains("friction")) file["rig"]["friction"] = *wire.friction;
    if (file.contains("environment") && file["environment"]["vessel"].is_object())
      file["environment"]["vessel"]["friction"] = *wire.friction;
  }
  return parse_json(*root.file, file.dump());
}

}  // namespace ostium::data
