/// A stent left in the artery is tied to the wall, while the session goes on.
#include "vascular/treatment/stent_ties.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/app/session/short_treatment.h"
#include "tests/support/allocations.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"

namespace ostium::app {
namespace {

/// As if it had been opened at 20 mm of the right coronary artery, to the size of the wall there.
void deploy(const SessionModel& model, SessionState& state) {
  vascular::StentState& stent = state.treatment.stents[0];
  const auto& paths = model.treatment.paths;
  const std::size_t branch = 0;
  stent.where = vascular::StentState::deployed, stent.branch = static_cast<int>(branch);
  stent.middle_m = 20e-3, stent.shift_m = 0;
  for (auto* radii : {&stent.radius_m, &stent.rest_m})
    std::fill(radii->begin(), radii->end(), paths[branch].value(state.treatment.wall.radius_m, stent.middle_m));
}

TEST(StentTies, OneRingAStepAndNoStepAllocates) {
  ScriptedRun run(setup(), vessel());
  SessionScratch scratch(run.model);
  SessionReport report;
  for (int n = 0; n < 50; ++n) step(run.model, run.inputs, run.state, scratch, report);
  deploy(run.model, run.state);
  const vascular::StentState& stent = run.state.treatment.stents[0];
  const int rings = run.model.treatment.stents[0].rings;
  for (int ring = 0; ring < rings; ++ring) {
    EXPECT_FALSE(is_tied(stent)) << ring;
    const long before = allocations();
    step(run.model, run.inputs, run.state, scratch, report);
    const long after = allocations();
    EXPECT_EQ(after, before) << ring;
  }
  EXPECT_TRUE(is_tied(stent));
}

TEST(StentTies, EachPointIsTiedToTheNearestPlaceOfTheWall) {
  ScriptedRun run(setup(), vessel());
  deploy(run.model, run.state);
  const Coronaries& c = *run.model.vessel->coronaries;
  const vascular::StentModel& model = run.model.treatment.stents[0];
  const vascular::PlaqueState& wall = run.state.treatment.wall;
  vascular::StentState& stent = run.state.treatment.stents[0];
  const vascular::VesselPath& path = run.model.treatment.paths[static_cast<std::size_t>(stent.branch)];
  constexpr double phase = 0.4;
  vascular::Mesh mesh{.vertices = {}, .triangles = c.patient->lumen.triangles};
  c.shape->at(wall.radius_m, {.phase = phase}, mesh.vertices);
  const vascular::BoundingVolumeHierarchy surface(mesh);
  tie_to_wall(*c.ties, model, path, wall, {.phase = phase}, stent);
  const auto points = points_on_path(model, stent, c.map, path, {.phase = phase});
  for (std::size_t i = 0; i < points.size(); ++i) {
    const vascular::StentTie& tie = stent.ties[i];
    ASSERT_GE(tie.triangle, 0);
    const auto& triangle = mesh.triangles[static_cast<std::size_t>(tie.triangle)];
    const auto corner = [&](int k) { return mesh.vertices[static_cast<std::size_t>(triangle[k])]; };
    const Eigen::Vector3d on = corner(0) + tie.u * (corner(1) - corner(0)) + tie.v * (corner(2) - corner(0));
    EXPECT_NEAR((on - points[i]).norm(), surface.nearest(points[i], 10e-3).distance_m, 1e-6) << i;
  }
}

}  // namespace
}  // namespace ostium::app
