/// Walls and contact in the gates' test vessel, which moves and has branches, with a wire and a guide of the catalogue.
#include <gtest/gtest.h>

#include <random>

#include "app/gates/drives.h"
#include "core/math/rotation.h"
#include "core/wall/pose.h"
#include "tests/support/allocations.h"
#include "tests/support/nearest_corner.h"

namespace ostium::app {
namespace {

using Eigen::Vector3d;

/// Distance to the nearest corner, at either end of the step, of the clusters found.
double nearest_found_m(const core::Surface& surface, const std::vector<int>& found, core::SurfacePose& pose,
                       const Vector3d& p) {
  double nearest_m = 1;
  for (int c : found)
    for (const auto* corners : {&pose_of(surface, c, pose).before, &pose_of(surface, c, pose).after})
      nearest_m = std::min(nearest_m, test::nearest_corner_m(*corners, p));
  return nearest_m;
}

/// The test vessel, that also sways.
core::SurfaceDescription swaying(const gates::TestVessel& vessel) {
  core::SurfaceDescription d = vessel.wall;
  for (const Vector3d& p : d.frames[0])
    d.sway.push_back(Vector3d(3e-3, -4e-3, 2e-3) + 0.1 * Vector3d(p.y(), p.z(), p.x()));
  return d;
}

/// The boxes contain a cluster throughout an interval, so a query misses nothing.
TEST(Surface, AQueryFindsWhatIsNearAtAnyMoment) {
  const gates::TestVessel vessel = gates::test_vessel();
  const core::Surface surface = make_surface(vessel.wall);
  core::SurfacePose pose(surface);
  std::vector<int> found;
  found.reserve(surface.clusters.size());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0, 1);
  for (int n = 0; n < 300; ++n) {
    core::SurfaceMotion motion;
    motion.frame_before = 24 * u(random), motion.frame_after = motion.frame_before + u(random);
    set_motion(surface, motion, pose);
    const auto& corner = vessel.wall.triangles[random() % vessel.wall.triangles.size()];
    const Vector3d p = vertex_at(vessel.wall, corner[0], n % 2 ? motion.frame_before : motion.frame_after);
    const core::V3<double> q = core::from_eigen(p), pad{1e-4, 1e-4, 1e-4};
    find_clusters(surface, q - pad, q + pad, pose, found);
    EXPECT_LT(nearest_found_m(surface, found, pose, p), 1e-6) << n;
  }
}

/// Also for a beating vessel; and with no sway the result is bit-identical to a surface that cannot sway.
TEST(Surface, WhatBeatsAndSwaysIsFoundAtAnyMoment) {
  const gates::TestVessel vessel = gates::test_vessel();
  const core::SurfaceDescription d = swaying(vessel);
  const core::Surface still = make_surface(vessel.wall), surface = make_surface(d);
  core::SurfacePose pose(surface), still_pose(still);
  std::vector<int> found, still_found;
  found.reserve(surface.clusters.size()), still_found.reserve(surface.clusters.size());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(0, 1);
  for (int n = 0; n < 300; ++n) {
    core::SurfaceMotion motion;
    motion.frame_before = 24 * u(random), motion.frame_after = motion.frame_before + u(random);
    motion.sway_before = u(random), motion.sway_after = u(random);
    set_motion(surface, motion, pose);
    const int v = d.triangles[random() % d.triangles.size()][0];
    const Vector3d p = n % 2 ? vertex_at(d, v, motion.frame_before, motion.sway_before)
                             : vertex_at(d, v, motion.frame_after, motion.sway_after);
    const core::V3<double> q = core::from_eigen(p), pad{1e-6, 1e-6, 1e-6};
    find_clusters(surface, q - pad, q + pad, pose, found);
    EXPECT_LT(nearest_found_m(surface, found, pose, p), 1e-6) << n;

    motion.sway_before = motion.sway_after = 0;
    set_motion(surface, motion, pose), set_motion(still, motion, still_pose);
    const core::V3<double> at = core::from_eigen(vertex_at(d, v, motion.frame_before)), wide{5e-3, 5e-3, 5e-3};
    find_clusters(surface, at - wide, at + wide, pose, found);
    find_clusters(still, at - wide, at + wide, still_pose, still_found);
    ASSERT_EQ(found, still_found);
    for (int c : found) {
      const core::ClusterPose &a = pose_of(surface, c, pose), &b = pose_of(still, c, still_pose);
      for (int i = 0; i < a.after.size(); ++i) ASSERT_EQ(Vector3d(a.after[i]), Vector3d(b.after[i]));
    }
  }
}

/// A vessel that beats and sways, in steps of a sixtieth of a frame from a random moment; every other one with a sway.
core::SurfaceMotion small_step(int n, double frame, double sway) {
  core::SurfaceMotion motion;
  motion.frame_before = frame, motion.frame_after = frame + 1.0 / 60;
  if (n % 2) motion.sway_before = sway, motion.sway_after = sway + 1e-3;
  return motion;
}

/// A wall that gives way: every vertex lies aside as a smooth function of its place says, times `far_m`.
class Yielding {
 public:
  Yielding(const core::SurfaceDescription& d, core::Surface& surface) : d_(d), editor_(d, surface) {
    editor_.let_yield();
  }
  Vector3d aside(int v, double far_m) const {
    const Vector3d& p = d_.frames[0][static_cast<std::size_t>(v)];
    return far_m * Vector3d(std::sin(300 * p.y()), std::sin(200 * p.z()), std::cos(250 * p.x()));
  }
  void move(double far_m) {
    for (int v = 0; v < static_cast<int>(d_.frames[0].size()); ++v) editor_.put_aside(v, aside(v, far_m));
    editor_.refit_aside();
  }

 private:
  const core::SurfaceDescription& d_;
  core::SurfaceEditor editor_;
};

/// Every corner is where it was, and aside of it, and is found there; back at its place, the wall is what it was.
TEST(Surface, WhatLiesAsideIsFoundAtAnyMoment) {
  const gates::TestVessel vessel = gates::test_vessel();
  const core::SurfaceDescription d = swaying(vessel);
  const core::Surface before = make_surface(d);
  core::Surface surface = before;
  Yielding wall(d, surface);
  core::SurfacePose pose(surface), pose_before(before);
  std::vector<int> found, found_before;
  found.reserve(surface.clusters.size()), found_before.reserve(surface.clusters.size());
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(0, 1);
  for (int n = 0; n < 100; ++n) {
    const double far_m = n % 3 ? 2e-3 * u(random) : 0, frame = 24 * u(random), sway = u(random);
    wall.move(far_m);
    const core::SurfaceMotion motion = small_step(n, frame, sway);
    set_motion(surface, motion, pose);
    const int v = d.triangles[random() % d.triangles.size()][0];
    const Vector3d p = vertex_at(d, v, motion.frame_after, motion.sway_after) + wall.aside(v, far_m);
    const core::V3<double> q = core::from_eigen(p), pad{1e-6, 1e-6, 1e-6};
    find_clusters(surface, q - pad, q + pad, pose, found);
    EXPECT_LT(nearest_found_m(surface, found, pose, p), 1e-6) << n;
    if (far_m != 0) continue;
    set_motion(before, motion, pose_before);
    find_clusters(before, q - pad, q + pad, pose_before, found_before);
    ASSERT_EQ(found, found_before);
    for (int c : found) {
      const core::ClusterPose &a = pose_of(surface, c, pose), &b = pose_of(before, c, pose_before);
      for (int i = 0; i < a.after.size(); ++i) ASSERT_EQ(Vector3d(a.after[i]), Vector3d(b.after[i]));
    }
  }
}

/// What is known of a cluster without computing its corners holds for each of them.
TEST(Surface, ARoughPoseHoldsTheExactOne) {
  const gates::TestVessel vessel = gates::test_vessel();
  const core::SurfaceDescription d = swaying(vessel);
  core::Surface surface = make_surface(d);
  Yielding wall(d, surface);
  core::SurfacePose pose(surface);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0, 1);
  int rough_ones = 0;
  double loosest_m = 0;
  for (int n = 0; n < 40; ++n) {
    const double frame = 24 * u(random);  // every fourth step goes over into the next interval
    if (n >= 20) wall.move(1e-3 * u(random));
    set_motion(surface, small_step(n, n % 4 ? frame : std::ceil(frame) - 1.0 / 120, u(random)), pose);
    for (int node = static_cast<int>(random() % 7); node < static_cast<int>(surface.nodes.size()); node += 7) {
      const int cluster = surface.nodes[node].cluster;
      if (cluster < 0) continue;
      const core::RoughPose rough = rough_pose(surface, node, {-1, -1, -1}, {1, 1, 1}, pose);
      if (rough.low.x == -1) continue;  // only its box is known
      ++rough_ones;
      const core::ClusterPose& exact = pose_of(surface, cluster, pose);
      for (int i = 0; i < exact.before.size(); ++i) {
        const Vector3d p = exact.before[i], moved = exact.after[i] - p - to_eigen(rough.move.drift);
        ASSERT_TRUE((p - to_eigen(rough.low)).minCoeff() >= 0 && (to_eigen(rough.high) - p).minCoeff() >= 0) << n;
        ASSERT_LE(moved.norm(), rough.move.spread) << n;
      }
      loosest_m = std::max(loosest_m, rough.move.spread - exact.move.spread);
    }
  }
  EXPECT_GT(rough_ones, 1000);
  EXPECT_LT(loosest_m, 0.1e-3) << "a bound that says nothing is of no use";
}

/// A list of leaves that is kept from step to step has what a walk through the tree finds, in the same order.
TEST(Surface, AKeptListHasWhatTheTreeFinds) {
  const gates::TestVessel vessel = gates::test_vessel();
  const core::SurfaceDescription d = swaying(vessel);
  core::Surface surface = make_surface(d);
  core::SurfaceEditor editor(d, surface);
  Yielding wall(d, surface);
  core::SurfacePose pose(surface);
  core::LeafList list;
  std::vector<int> kept, found;
  for (std::vector<int>* v : {&kept, &found}) v->reserve(surface.clusters.size());
  std::mt19937 random(6);
  std::uniform_real_distribution<double> u(0, 1);
  int again = 0, some = 0;
  for (int walk = 0; walk < 20; ++walk) {
    const int v = d.triangles[random() % d.triangles.size()][0];
    double frame = 24 * u(random);
    const double sway = u(random);
    Vector3d p = vertex_at(d, v, frame, walk % 2 ? sway : 0);
    for (int n = 0; n < 100; ++n, frame += 1.0 / 60) {
      p += 0.1e-3 * Vector3d(u(random) - 0.4, u(random) - 0.5, u(random) - 0.5);
      if (walk % 3 == 0 && n % 10 == 0) wall.move(1e-3 * u(random) / (1 + walk % 2));
      if (walk % 3 == 1) wall.move(2e-6 * n);
      if (n == 50) editor.place(v, 3, d.frames[3][v] + Vector3d(1e-3, 0, 0)), editor.refit();
      set_motion(surface, small_step(walk, frame, sway + 1e-3 * n), pose);
      const core::V3<double> q = core::from_eigen(p), pad{2e-3, 2e-3, 2e-3};
      const long made = list.made;
      find_clusters(surface, q - pad, q + pad, pose, found);
      some += !found.empty();
      if (!renew(surface, q - pad, q + pad, pose, list)) continue;
      kept.clear();
      for (const int leaf : list.leaves)
        if (const int cluster = surface.nodes[leaf].cluster;
            std::find(found.begin(), found.end(), cluster) != found.end())
          kept.push_back(cluster);
      ASSERT_EQ(kept, found) << walk << ", " << n;
      again += list.made == made;
    }
  }
  EXPECT_GT(some, 1500);
  EXPECT_GT(again, 1000) << "it was hardly ever kept";
}

/// Vertices that were moved are found at their new places; moved back, the surface is bit-identical to before.
TEST(Surface, VerticesArePlacedAnewAndBack) {
  const gates::TestVessel vessel = gates::test_vessel();
  const core::Surface before = make_surface(vessel.wall);
  core::Surface surface = before;
  core::SurfaceEditor editor(vessel.wall, surface);
  core::SurfaceDescription opened = vessel.wall;
  for (auto& frame : opened.frames)
    for (std::size_t v = 0; v < frame.size(); v += 3) frame[v] += Vector3d(0.5e-3, -0.3e-3, 0.2e-3);
  const auto place = [&](const core::SurfaceDescription& d) {
    for (int f = 0; f < static_cast<int>(d.frames.size()); ++f)
      for (int v = 0; v < static_cast<int>(d.frames[0].size()); ++v) editor.place(v, f, d.frames[f][v]);
    editor.refit();
  };
  place(opened);
  EXPECT_NE(surface.corner_frames, before.corner_frames);
  core::SurfacePose pose(surface);
  std::vector<int> found;
  found.reserve(surface.clusters.size());
  for (int v = 0; v < static_cast<int>(opened.frames[0].size()); v += 97) {
    core::SurfaceMotion motion;
    motion.frame_before = 0.37 * v, motion.frame_after = motion.frame_before + 0.2;
    set_motion(surface, motion, pose);
    const core::V3<double> q = core::from_eigen(vertex_at(opened, v, motion.frame_before)), pad{1e-5, 1e-5, 1e-5};
    find_clusters(surface, q - pad, q + pad, pose, found);
    double nearest_m = 1;
    for (int c : found)
      nearest_m = std::min(nearest_m, test::nearest_corner_m(pose_of(surface, c, pose).before, to_eigen(q)));
    EXPECT_LT(nearest_m, 1e-6) << v;
  }
  place(vessel.wall);
  EXPECT_EQ(surface.corner_frames, before.corner_frames);
  for (std::size_t b = 0; b < before.boxes.size(); ++b) {
    ASSERT_EQ(surface.boxes[b].low, before.boxes[b].low);
    ASSERT_EQ(surface.boxes[b].high, before.boxes[b].high);
  }
}

TEST(Contact, AStepDoesNotAllocateAndIsBitIdentical) {
  const gates::TestVessel vessel = gates::test_vessel();
  gates::Rehearsal a(vessel, false), b(vessel, false);
  for (gates::Rehearsal* run : {&a, &b}) {
    run->lay_wire(vessel.ways_W[0], 0.42);
    run->inputs.rods[0].feed_m_s = 0.02;
    run->inputs.rods[0].base.turn_rate_W_rad_s = Vector3d(6, 0, 0);
  }
  for (int n = 0; n < 300; ++n) a.step(75), b.step(75);
  EXPECT_EQ(hash(a.state), hash(b.state));
  b.scratch = core::Scratch(b.model);  // the scratch holds nothing that is needed
  long allocated = 0;
  for (int n = 0; n < 300; ++n) {
    const long before = allocations();
    a.step(75);
    allocated += allocations() - before;
    b.step(75);
  }
  EXPECT_EQ(first_difference(a.state, b.state), "");
  EXPECT_LT(allocated, 10) << "the list of touches grows at first";
}

/// Walls that sleep are those that would not have been met: a run that looks at all of them in every step is the same
/// to the bit, and poses many more.
TEST(Contact, WhatSleepsIsNotMet) {
  const gates::TestVessel vessel = gates::test_vessel();
  gates::Rehearsal a(vessel, false), b(vessel, false);
  for (gates::Rehearsal* run : {&a, &b}) {
    run->lay_wire(vessel.ways_W[0], 0.42);
    run->inputs.rods[0].feed_m_s = 0.05;
    run->inputs.rods[0].base.turn_rate_W_rad_s = Vector3d(20, 0, 0);
  }
  long posed = 0, posed_awake = 0;
  for (int n = 0; n < 1000; ++n) {
    a.step(90);
    for (core::Lookouts& rod : b.scratch.lookouts)
      for (core::KeptLeaves& kept : rod.leaves) kept.nodes = 0;  // wakes them
    b.step(90);
    posed += a.report.counts.clusters, posed_awake += b.report.counts.clusters;
    ASSERT_EQ(hash(a.state), hash(b.state)) << n;
  }
  EXPECT_GT(posed, 1000);
  EXPECT_LT(posed, posed_awake);
}

/// Also where the wall gives way while they sleep.
TEST(Contact, WhatSleepsInAWallThatGivesWayIsNotMet) {
  const gates::TestVessel vessel = gates::test_vessel();
  gates::Rehearsal a(vessel, false), b(vessel, false);
  const auto surface = std::make_shared<core::Surface>(*a.model.surfaces[0]);
  Yielding wall(vessel.wall, *surface);
  for (gates::Rehearsal* run : {&a, &b}) {
    run->model.surfaces = {surface};
    run->lay_wire(vessel.ways_W[0], 0.42);
    run->inputs.rods[0].feed_m_s = 0.05;
    run->inputs.rods[0].base.turn_rate_W_rad_s = Vector3d(20, 0, 0);
  }
  long posed = 0, posed_awake = 0;
  for (int n = 0; n < 800; ++n) {
    if (n % 8 == 0) wall.move(0.4e-3 * std::sin(0.2 * n));
    a.step(90);
    if (n % 8 == 0) b.scratch = core::Scratch(b.model);  // everything is awake
    b.step(90);
    posed += a.report.counts.clusters, posed_awake += b.report.counts.clusters;
    ASSERT_EQ(hash(a.state), hash(b.state)) << n;
  }
  EXPECT_GT(posed, 800);
  EXPECT_LT(posed, posed_awake);
  EXPECT_FALSE(a.report.touches.empty());
}

/// And where it is opened meanwhile, here and there, in all frames of the beat.
TEST(Contact, WhatSleepsInAWallThatIsEditedIsNotMet) {
  const gates::TestVessel vessel = gates::test_vessel();
  gates::Rehearsal a(vessel, false), b(vessel, false);
  const auto surface = std::make_shared<core::Surface>(*a.model.surfaces[0]);
  core::SurfaceEditor editor(vessel.wall, *surface);
  for (gates::Rehearsal* run : {&a, &b}) {
    run->model.surfaces = {surface};
    run->lay_wire(vessel.ways_W[0], 0.42);
    run->inputs.rods[0].feed_m_s = 0.05;
    run->inputs.rods[0].base.turn_rate_W_rad_s = Vector3d(20, 0, 0);
  }
  for (int n = 0; n < 400; ++n) {
    if (n % 8 == 0) {
      const auto vertices = vessel.wall.frames[0].size();
      const Vector3d by = 0.4e-3 * Vector3d(std::sin(0.3 * n), std::cos(0.2 * n), std::sin(0.1 * n));
      for (std::size_t v = static_cast<std::size_t>(n / 8 % 3); v < vertices; v += 3)
        for (std::size_t f = 0; f < vessel.wall.frames.size(); ++f)
          editor.place(static_cast<int>(v), static_cast<int>(f), vessel.wall.frames[f][v] + by);
      editor.refit();
    }
    a.step(90);
    if (n % 8 == 0) b.scratch = core::Scratch(b.model);  // everything is awake
    b.step(90);
    ASSERT_EQ(hash(a.state), hash(b.state)) << n;
  }
  EXPECT_FALSE(a.report.touches.empty());
}

/// A wire in a moving branch, driven at random, stays inside, as tested with the triangles.
TEST(Contact, AWireStaysInABeatingBranch) {
  const gates::TestVessel vessel = gates::test_vessel();
  const gates::Holding held = gates::random_drive(vessel, 5, 2);
  EXPECT_EQ(held.escapes, 0);
  EXPECT_LT(held.deepest_m, 0.178e-3);
}

/// The same without contact between the two ends of a step: wires escape.
TEST(Contact, WithoutTheSweepWiresEscape) {
  const gates::TestVessel vessel = gates::test_vessel();
  int escapes = 0;
  for (int seed : {1, 3, 5}) escapes += gates::random_drive(vessel, static_cast<std::uint64_t>(seed), 2, false).escapes;
  EXPECT_GT(escapes, 0);
}

}  // namespace
}  // namespace ostium::app
