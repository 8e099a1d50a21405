#include "app/session/vessel/coronaries.h"

#include <algorithm>

#include "app/angiography/settle.h"

namespace ostium::app {

namespace {

/// Calls take(cell, vertex) for each vertex of the lumen and each cell whose radius it follows.
template <class Take>
void for_each_follower(const vascular::LumenMap& map, Take&& take) {
  for (std::size_t v = 0; v < map.sources.size(); ++v) {
    const vascular::VertexSource& from = map.sources[v].first;
    if (from.part != vascular::VertexSource::coronary) continue;
    take(static_cast<std::size_t>(from.below), static_cast<int>(v));
    if (from.above != from.below) take(static_cast<std::size_t>(from.above), static_cast<int>(v));
  }
}

}  // namespace

std::unique_ptr<const Coronaries> make_coronaries(std::shared_ptr<const vascular::Patient> patient, double rate_1_min) {
  auto out = std::make_unique<Coronaries>();
  out->patient = std::move(patient);
  out->physiology = make_physiology(*out->patient);
  if (out->tree().cells.empty()) return nullptr;
  out->map = make_lumen_map(*out->patient, out->physiology.flow);
  out->shape = std::make_unique<const vascular::WallShape>(*out->patient, out->map, out->tree());
  out->ties = std::make_unique<const vascular::StentTies>(*out->patient, *out->shape, out->map, out->tree());
  Treatable plan =
      plan_treatment(*out->patient, out->physiology.flow, 0, {.stent = false, .predilate = false, .postdilate = false});
  out->treatment = std::move(plan.model), out->lesions = std::move(plan.plans);
  if (!out->lesions.empty()) {
    const Plan& first = out->lesions.front();
    const auto artery = out->tree().branches[static_cast<std::size_t>(first.branch)].territory;
    out->landmark_cell = timi_landmark(out->tree(), vascular::territory_names[static_cast<int>(artery)]);
    out->ostium_cell = first.path.cells[std::min<std::size_t>(2, first.path.cells.size() - 1)];
  }
  out->at_rest = at_rest(out->physiology, rate_1_min);
  vascular::HeartState& heart = out->at_rest.heart;
  heart.phase = heart.since_R_s = 0;  // at_rest ends within a step of the R wave
  heart.time_s = 0, heart.beats = 0, heart.draws = 0;
  out->first_vertex.assign(out->tree().cells.size() + 1, 0);
  for_each_follower(out->map, [&](std::size_t cell, int) { ++out->first_vertex[cell + 1]; });
  for (std::size_t c = 1; c < out->first_vertex.size(); ++c) out->first_vertex[c] += out->first_vertex[c - 1];
  out->vertices.resize(static_cast<std::size_t>(out->first_vertex.back()));
  std::vector<int> next(out->first_vertex.begin(), out->first_vertex.end() - 1);
  for_each_follower(out->map,
                    [&](std::size_t cell, int v) { out->vertices[static_cast<std::size_t>(next[cell]++)] = v; });
  return out;
}

}  // namespace ostium::app
