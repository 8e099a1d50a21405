/// From points to cells, seats and tips; and that a step does not allocate.
#include "vascular/contrast/cell_locator.h"

#include <gtest/gtest.h>

#include <random>

#include "core/base/units.h"
#include "tests/support/allocations.h"
#include "vascular/treatment/treatment.h"

namespace ostium::vascular {

using units::atm;
namespace {

/// One patient for all tests: making one takes seconds.
struct Ward {
  Patient patient = make_patient({}, {typical(LesionType::A, "RCA", 42e-3)});
  PhysiologyModel physiology = make_physiology(patient);
  const FlowTree& tree = physiology.flow.tree;
  LumenMap map = make_lumen_map(patient, physiology.flow);
};
const Ward& ward() {
  static const Ward the_one;
  return the_one;
}

TEST(CellLocator, AMarkerPairIsFoundAgainAtEveryMomentOfTheBeat) {
  const Ward& w = ward();
  CellLocator locator(w.map, w.tree);
  const int near = w.tree.cell_at(w.tree.branch("RCA"), 40e-3), far = w.tree.cell_at(w.tree.branch("RCA"), 52e-3);
  const VesselPath path = path_along(w.tree, far);
  const std::vector<VesselPath> paths = all_paths(w.tree);
  for (double phase : {0.0, 0.2, 0.36, 0.7}) {
    locator.set_moment({.phase = phase});
    const Eigen::Vector3d beside(0.3e-3, 0.2e-3, -0.1e-3);
    const auto seat = seat_of(locator, w.tree, paths, locator.centre(near) + beside, locator.centre(far) + beside);
    ASSERT_TRUE(seat);
    EXPECT_NEAR(seat->middle_m,
                (path.s_m[path.cells.size() - 1] + path_position(w.tree, path, "RCA", w.tree.s_of(near))) / 2, 0.4e-3);
    EXPECT_LT(seat->offset_m, 0.4e-3);
  }
  // Markers in two different vessels do not make a seat.
  const int other = w.tree.cell_at(w.tree.branch("LAD"), 30e-3);
  EXPECT_FALSE(seat_of(locator, w.tree, paths, locator.centre(other), locator.centre(far)));
  EXPECT_FALSE(seat_of(locator, w.tree, paths, locator.centre(far) + Eigen::Vector3d(0.05, 0, 0), locator.centre(far)));
}

TEST(CellLocator, NoCellIsNearerThanTheOneFound) {
  const Ward& w = ward();
  CellLocator locator(w.map, w.tree);
  locator.set_moment({.phase = 0.3, .breath = 0.5});
  const auto cells = static_cast<int>(w.tree.cells.size());
  std::mt19937 random(1);
  std::normal_distribution<double> away(0, 4e-3);
  int found = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p = locator.centre(i * 7 % cells) + Eigen::Vector3d(away(random), away(random), away(random));
    double least = 1;
    for (int c = 0; c < cells; ++c) least = std::min(least, (p - locator.centre(c)).norm());
    const CellLocator::Found f = locator.nearest(p, 6e-3);
    if (f.cell < 0) {
      EXPECT_GT(least, 5.5e-3);
      continue;
    }
    ++found;
    EXPECT_EQ((p - locator.centre(f.cell)).norm(), least);
  }
  EXPECT_GT(found, 200);
}

TEST(CellLocator, ByAForkADeviceLiesWhereItsWireGoes) {
  const Ward& w = ward();
  CellLocator locator(w.map, w.tree);
  const std::vector<VesselPath> paths = all_paths(w.tree);
  const int lad = w.tree.branch("LAD"), lcx = w.tree.branch("LCx"), near = w.tree.cell_at(w.tree.branch("LM"), 2e-3);
  for (double phase : {0.0, 0.36, 0.7}) {
    locator.set_moment({.phase = phase});
    // Between both arteries, slightly nearer to one.
    const Eigen::Vector3d p_lad = locator.centre(w.tree.cell_at(lad, 1.5e-3)),
                          p_lcx = locator.centre(w.tree.cell_at(lcx, 1.5e-3));
    for (const double share : {0.45, 0.55}) {
      const Eigen::Vector3d p_far = p_lad + share * (p_lcx - p_lad);
      for (const int branch : {lad, lcx}) {
        const int wire_cell = w.tree.cell_at(branch, 60e-3);
        const auto seat = seat_of(locator, w.tree, paths, locator.centre(near), p_far, wire_cell);
        ASSERT_TRUE(seat);
        EXPECT_EQ(seat->branch, branch) << phase << ' ' << share;
      }
    }
    // Far from the wire's vessel, the nearest vessel counts.
    const Eigen::Vector3d p_other = locator.centre(w.tree.cell_at(lcx, 25e-3));
    EXPECT_EQ(w.tree.cells[inside(locator, w.tree, paths, p_other, w.tree.cell_at(lad, 60e-3)).cell].branch, lcx);
  }
}

TEST(CellLocator, AShaftFillsTheCellsItRunsThroughAndNoOthers) {
  const Ward& w = ward();
  CellLocator locator(w.map, w.tree);
  locator.set_moment({.phase = 0.5});
  const VesselPath path = path_along(w.tree, w.tree.cell_at(w.tree.branch("RCA"), 60e-3));
  std::vector<Eigen::Vector3d> nodes;
  for (std::size_t k = 0; k < path.cells.size(); k += 3) nodes.push_back(locator.centre(path.cells[k]));
  nodes.push_back(locator.centre(path.cells.back()));
  std::vector<double> occupied(w.tree.cells.size(), 0);
  occupy(locator, w.tree, nodes, 0.5e-3, occupied);
  std::size_t filled = 0;
  for (double r : occupied) filled += r > 0;
  EXPECT_EQ(filled, path.cells.size());
  for (int cell : path.cells) EXPECT_EQ(occupied[cell], 0.5e-3);
}

TEST(CellLocator, ATipIsInTheCoronaryAtItsOstiumOrInTheAorta) {
  const Ward& w = ward();
  CellLocator locator(w.map, w.tree);
  locator.set_moment({});
  const int first = w.tree.branches[w.tree.branch("RCA")].first;
  const Eigen::Vector3d in = (locator.centre(first + 3) - locator.centre(first)).normalized();
  const auto at = [&](const Eigen::Vector3d& p, const Eigen::Vector3d& direction) {
    return tip_place(locator, w.tree, w.physiology.contrast, w.patient, w.map, {}, p, direction);
  };
  EXPECT_EQ(at(locator.centre(first + 4), in).where, TipPlace::coronary);
  const TipPlace aimed = at(locator.centre(first) - 5e-3 * in, in), away = at(locator.centre(first) - 5e-3 * in, -in);
  EXPECT_EQ(aimed.where, TipPlace::right_sinus);
  EXPECT_GT(aimed.into_ostium, 0.2);
  EXPECT_EQ(away.into_ostium, 0);
  const Landmarks& marks = w.patient.anatomy.landmarks;
  EXPECT_EQ(at(marks.p_annulus + 60e-3 * marks.root_axis, in).where, TipPlace::aorta);
  EXPECT_GT(beyond_valve_m(marks, marks.p_annulus - 5e-3 * marks.root_axis), 0);
  EXPECT_LT(beyond_valve_m(marks, marks.p_left_ostium), 0);
  EXPECT_LT(beyond_valve_m(marks, marks.p_access), 0) << "the groin lies beyond the plane, but not in the ventricle";
}

TEST(CellLocator, StepsOfPhysiologyAndTreatmentAllocateNothing) {
  const Ward& w = ward();
  TreatmentModel model{.plaque = make_plaque_model(w.tree, w.patient.lesions),
                       .injury = {},
                       .drugs = {},
                       .balloons = {make_balloon(Compliance::semi, 3e-3, 18.5e-3)},
                       .stents = {make_stent(3e-3, 18e-3)},
                       .stent_on = {0},
                       .paths = all_paths(w.tree)};
  PhysiologyState blood = make_state(w.physiology);
  TreatmentState state = make_state(model, w.tree);
  PhysiologyInputs inputs;
  inputs.contrast.tip = {TipPlace::coronary, w.tree.branches[w.tree.branch("RCA")].first, 1};
  inputs.contrast.injection_m3_s = 2e-6;
  TreatmentInputs device;
  device.balloons[0] = {.balloon = 0, .branch = w.tree.branch("RCA"), .shaft = {.middle_m = 48e-3}};
  PhysiologyScratch blood_scratch;
  TreatmentScratch scratch;
  const auto run = [&](int steps) {
    for (int n = 0; n < steps; ++n) {
      step(model, device, 1e-3, state, {w.physiology.flow, blood, inputs.occupied_m}, scratch);
      step(w.physiology, inputs, 1e-3, blood, blood_scratch);
    }
  };
  run(3000);  // contrast has reached every branch of the right coronary
  const long before = allocations();
  device.balloons[0].gauge_Pa = 10 * atm;
  run(500);
  EXPECT_EQ(allocations(), before);
}

}  // namespace
}  // namespace ostium::vascular
