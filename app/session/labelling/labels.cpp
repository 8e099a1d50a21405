#include "app/session/labelling/labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/session/coupling/tool_geometry.h"
#include "app/session/scene/xray_scene.h"
#include "core/rod/introducer.h"

namespace ostium::app {

namespace {

using Eigen::Vector3d;

LabelClass class_of(data::InstrumentKind kind) {
  switch (kind) {
    case data::InstrumentKind::wire:
      return LabelClass::wire;
    case data::InstrumentKind::balloon_shaft:
    case data::InstrumentKind::stent_shaft:
      return LabelClass::device_shaft;
    default:
      return LabelClass::catheter;
  }
}

const std::vector<std::array<int, 3>>& triangles_of(const Vessel& vessel) {
  return vessel.patient ? vessel.patient->lumen.triangles : vessel.wall.triangles;
}

}  // namespace

LabelledPixels pixels_of(const fluoro::View& view, const Labels& labels) {
  const std::size_t count = static_cast<std::size_t>(view.pixels) * static_cast<std::size_t>(view.pixels);
  LabelledPixels out{{view.pixels, view.pixels, std::vector<std::uint8_t>(count)}, std::vector<std::uint16_t>(count)};
  for (const LabelledThing& thing : labels.things) {  // the lowest class first
    const float* depth_m = thing.covered.depth_m().data();
    for (std::size_t i = 0; i < count; ++i) {
      if (!(depth_m[i] > 0)) continue;
      out.mask.grey[i] = static_cast<std::uint8_t>(thing.of_class);
      out.depth[i] = static_cast<std::uint16_t>(std::clamp(std::lround(depth_m[i] / depth_unit_m), 1L, 65535L));
    }
  }
  return out;
}

Labeller::Labeller(const SessionModel& model) : model_(model), triangles_(triangles_of(*model.vessel)) {
  const VesselIndex& way = *model.vessel->way;
  for (const vascular::TreeBranch& branch : way.branches()) {
    const bool of_parent = branch.parent >= 0 && coronary_[static_cast<std::size_t>(branch.parent)];
    coronary_.push_back(model.has_patient() && (of_parent || branch.name == "LM" || branch.name == "RCA"));
  }
  if (model.bed) find_cells();
  const SessionState first = make_state(model, 0);
  const std::vector<Vector3d> wall = wall_at(first);
  for (const auto& t : triangles_) {
    const Vector3d middle = (wall[static_cast<std::size_t>(t[0])] + wall[static_cast<std::size_t>(t[1])] +
                             wall[static_cast<std::size_t>(t[2])]) /
                            3;
    branch_of_.push_back(way.branch(way.locate(middle, first.blood.heart.phase, breath(model, first))));
  }
}

/// The cell nearest to each sphere of a coronary artery.
void Labeller::find_cells() {
  const vascular::FlowTree& tree = model_.vessel->coronaries->tree();
  for (const vascular::TreeBranch& branch : model_.vessel->way->branches())
    cell_of_.emplace_back(branch.spheres.size(), -1);
  for (const vascular::FlowBranch& branch : tree.branches) {
    std::vector<int>& cells = cell_of_[static_cast<std::size_t>(branch.tree_branch)];
    int cell = branch.first;
    for (std::size_t s = 0; s < cells.size(); ++s) {
      while (cell + 1 < branch.last && tree.cells[static_cast<std::size_t>(cell)].sphere < static_cast<int>(s)) ++cell;
      cells[s] = cell;
    }
  }
}

/// The lumen as it is: beating, breathing, narrowed, opened by treatment, pushed aside.
std::vector<Vector3d> Labeller::wall_at(const SessionState& state) const {
  const Vessel& vessel = *model_.vessel;
  const vascular::LumenMoment at = moment(model_, state);
  if (!vessel.patient) return vessel.wall.frames[0];
  if (!vessel.coronaries) return vessel.patient->lumen.at(at.phase, at.breath).vertices;
  std::vector<Vector3d> wall;
  vessel.coronaries->shape->at(state.blood.radius_m, at, wall);
  return wall;
}

Vector3d Labeller::centre(std::size_t branch, std::size_t sphere, const SessionState& state) const {
  const Vessel& vessel = *model_.vessel;
  if (!vessel.patient || vessel.patient->tree_frames.empty()) return vessel.way->branches()[branch].spheres[sphere].p;
  const auto& frames = vessel.patient->tree_frames;
  const auto& still = vessel.patient->tree_breath;
  const auto frame =
      static_cast<std::size_t>(std::lround(state.blood.heart.phase * static_cast<double>(frames.size())));
  Vector3d p = frames[frame % frames.size()].branches[branch].spheres[sphere].p;
  if (!cell_of_.empty() && cell_of_[branch][sphere] >= 0)
    p += state.wall_aside_P[static_cast<std::size_t>(cell_of_[branch][sphere])];
  return still.empty() ? p : Vector3d(p + breath(model_, state) * still[branch][sphere]);
}

void Labeller::add_vessels(const SessionState& state, const fluoro::View& view, Labels& out) const {
  const auto& branches = model_.vessel->way->branches();
  std::vector<fluoro::Silhouette> covered(branches.size(), fluoro::Silhouette(view));
  const std::vector<Vector3d> wall = wall_at(state);
  for (std::size_t t = 0; t < triangles_.size(); ++t)
    covered[static_cast<std::size_t>(branch_of_[t])].add(wall[static_cast<std::size_t>(triangles_[t][0])],
                                                         wall[static_cast<std::size_t>(triangles_[t][1])],
                                                         wall[static_cast<std::size_t>(triangles_[t][2])]);
  for (const bool coronary : {false, true})
    for (std::size_t b = 0; b < branches.size(); ++b) {
      if (coronary_[b] != coronary || covered[b].empty()) continue;
      LabelledThing thing{.of_class = coronary ? LabelClass::coronary : LabelClass::vessel,
                          .name = branches[b].name,
                          .category = branches[b].name,
                          .covered = std::move(covered[b]),
                          .line_P = Eigen::Matrix3Xd(3, branches[b].spheres.size())};
      for (std::size_t s = 0; s < branches[b].spheres.size(); ++s)
        thing.line_P.col(static_cast<Eigen::Index>(s)) = centre(b, s, state);
      out.things.push_back(std::move(thing));
    }
}

void Labeller::add_tools(const SessionState& state, const fluoro::View& view, Labels& out) const {
  for (std::size_t t = 0; t < model_.tools.size(); ++t) {
    const core::Rod& rod = model_.rods.rods[t];
    const core::RodState& own = state.rods.rods[t];
    if (!in_body(rod, own)) continue;
    const SessionTool& tool = model_.tools[t];
    LabelledThing thing{.of_class = class_of(tool.instrument.kind),
                        .name = tool.name,
                        .category = words_for(tool.instrument.kind),
                        .tool = static_cast<int>(t),
                        .covered = fluoro::Silhouette(view),
                        .line_P = Eigen::Matrix3Xd(3, rod.nodes() - own.first)};
    std::vector<double> radius_m;
    for (int i = own.first; i < rod.nodes(); ++i) {
      thing.line_P.col(i - own.first) = own.position[i];
      radius_m.push_back(rod.radius.at(0)[i]);
    }
    thing.covered.add_tube(thing.line_P, radius_m);
    out.points.push_back({"tip of " + tool.name, thing.line_P.rightCols<1>()});
    for (std::size_t m = 0; m < tool.instrument.markers.size(); ++m) {
      const double at_m = tool.instrument.markers[m].from_tip_m + tool.instrument.markers[m].length_m / 2;
      if (at_m < own.inserted_m)
        out.points.push_back({fmt::format("marker {} of {}", m + 1, tool.name), point_from_tip(rod, own, at_m)});
    }
    if (!thing.covered.empty()) out.things.push_back(std::move(thing));
  }
}

void Labeller::add_treatment(const SessionState& state, const fluoro::View& view, Labels& out) const {
  if (!model_.has_patient()) return;
  fluoro::Scene scene;
  app::add_treatment(model_, state, scene);
  LabelledThing balloon{.of_class = LabelClass::balloon,
                        .name = "balloon",
                        .category = "balloon",
                        .covered = fluoro::Silhouette(view),
                        .line_P = {}},
      stent{.of_class = LabelClass::stent,
            .name = "stent",
            .category = "stent",
            .covered = fluoro::Silhouette(view),
            .line_P = {}};
  for (const fluoro::Body& body : scene.moving)
    if (body.name == "balloon") balloon.covered.add(body);
  for (const fluoro::Shaft& strut : scene.shafts) {
    const std::vector<double> radius_m(static_cast<std::size_t>(strut.p_P.cols()), strut.sections[0].outer_radius_m);
    stent.covered.add_tube(strut.p_P, radius_m);
  }
  for (LabelledThing* thing : {&balloon, &stent})
    if (!thing->covered.empty()) out.things.push_back(std::move(*thing));
}

void Labeller::add_places(const SessionState& state, Labels& out) const {
  if (!model_.has_patient()) return;
  const auto& branches = model_.vessel->way->branches();
  const auto point_of = [&](const std::string& branch, double along_m) -> std::optional<Vector3d> {
    const int place = model_.vessel->way->place(fmt::format("{}+{:.3f}", branch, 1e3 * along_m));
    if (place < 0) return {};
    auto sphere = static_cast<std::size_t>(place);
    for (std::size_t b = 0; b < branches.size(); sphere -= branches[b].spheres.size(), ++b)
      if (sphere < branches[b].spheres.size()) return centre(b, sphere, state);
    return {};
  };
  for (const char* ostium : {"RCA", "LM"})
    if (const auto p = point_of(ostium, 0)) out.points.push_back({std::string("ostium of ") + ostium, *p});
  const auto& lesions = model_.vessel->patient->lesions;
  for (std::size_t i = 0; i < lesions.size(); ++i)
    for (const auto& [where, share] : {std::pair{"beginning", 0.0}, {"middle", 0.5}, {"end", 1.0}})
      if (const auto p = point_of(lesions[i].branch, lesions[i].from_m + share * lesions[i].length_m))
        out.points.push_back({fmt::format("lesion {}, {}", i + 1, where), *p});
}

Labels Labeller::at(const SessionState& state, const fluoro::View& view) const {
  Labels out;
  add_vessels(state, view, out);
  add_tools(state, view, out);
  add_treatment(state, view, out);
  add_places(state, out);
  std::stable_sort(out.things.begin(), out.things.end(),
                   [](const LabelledThing& a, const LabelledThing& b) { return a.of_class < b.of_class; });
  return out;
}

}  // namespace ostium::app
