#include "app/session/vessel/coronaries.h"

#include <algorithm>

#include "app/angiography/settle.h"

namespace ostium::app {

namespace {

/// The vertices of each cell, of those that cells_of(vertex, take) gives them to.
template <class CellsOf>
CellVertices vertices_of(std::size_t cells, std::size_t vertices, CellsOf&& cells_of) {
  CellVertices out{.first = std::vector<int>(cells + 1, 0), .vertices = {}};
  for (std::size_t v = 0; v < vertices; ++v) cells_of(v, [&](int cell) { ++out.first[cell + 1]; });
  for (std::size_t c = 1; c <= cells; ++c) out.first[c] += out.first[c - 1];
  out.vertices.resize(static_cast<std::size_t>(out.first.back()));
  std::vector<int> next(out.first.begin(), out.first.end() - 1);
  for (std::size_t v = 0; v < vertices; ++v)
    cells_of(v, [&](int cell) { out.vertices[static_cast<std::size_t>(next[cell]++)] = static_cast<int>(v); });
  return out;
}

template <class Take>
void cells_of(const vascular::VertexSource& from, Take&& take) {
  if (from.part != vascular::VertexSource::coronary) return;
  take(from.below);
  if (from.above != from.below) take(from.above);
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
  out->treatment.forks = make_forks(out->tree(), out->map, out->treatment.paths);
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
  const std::vector<vascular::LumenMap::Vertex>& sources = out->map.sources;
  out->opened_with = vertices_of(out->tree().cells.size(), sources.size(),
                                 [&](std::size_t v, auto&& take) { cells_of(sources[v].first, take); });
  out->aside_with = vertices_of(out->tree().cells.size(), sources.size(), [&](std::size_t v, auto&& take) {
    cells_of(sources[v].first, take);
    if (sources[v].second_share > 0) cells_of(sources[v].second, take);
  });
  return out;
}

}  // namespace ostium::app
