/// The anatomy and its variants: closed, free of crossings, named, and narrowed as requested.
#include <gtest/gtest.h>

#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/patient/patient.h"

namespace ostium::vascular {
namespace {

void expect_sound(const AnatomyParameters& parameters) {
  const Anatomy anatomy = build_anatomy(parameters);
  const SurfaceReport r = check_surface(contour(TubeUnion(anatomy.tubes)).mesh);
  EXPECT_TRUE(r.sound()) << describe(r);
  EXPECT_EQ(r.components, 1);
  // One piece without handles: V - E + F = 2.
  EXPECT_EQ(r.vertices - r.triangles / 2, 2);
}

TEST(Anatomy, TheMeanOfEachDominanceAndAccessIsSound) {
  for (Dominance dominance : {Dominance::right, Dominance::left, Dominance::balanced})
    expect_sound(mean_of(dominance, Access::femoral));
  expect_sound(mean_of(Dominance::right, Access::radial));
}

TEST(Anatomy, SoArePeople) {
  for (std::uint64_t seed : {1, 2, 3, 4}) expect_sound(person(seed, {}));
  expect_sound(person(5, mean_of(Dominance::left)));
}

TEST(Anatomy, APersonIsTheSameEveryTimeAndUnlikeOthers) {
  const Anatomy a = build_anatomy(person(7, {})), b = build_anatomy(person(7, {})), c = build_anatomy(person(8, {}));
  const auto apex = [](const Anatomy& x) { return x.tubes[find_branch(x, "LAD")->tube].nodes.back().p; };
  EXPECT_EQ(apex(a), apex(b));
  EXPECT_GT((apex(a) - apex(c)).norm(), 1e-3);
}

TEST(Anatomy, PeopleScatterAsPublished) {
  // 400 people: the mean within 4 standard errors; clamping at two deviations lowers the standard deviation by 12 %.
  double sum = 0, squares = 0;
  constexpr int n = 400;
  for (std::uint64_t seed = 1; seed <= n; ++seed) {
    const double mm = person(seed, {}).left_main_mm;
    sum += mm, squares += mm * mm;
  }
  const double mean = sum / n, sd = std::sqrt(squares / n - mean * mean);
  EXPECT_NEAR(mean, 4.5, 4 * 0.5 / std::sqrt(n));
  EXPECT_NEAR(sd, 0.44, 0.07);
}

TEST(Anatomy, TheDominantArteryGivesThePosteriorDescending) {
  const auto parent = [](Dominance dominance) {
    const Anatomy a = build_anatomy(mean_of(dominance));
    const NamedBranch *pda = find_branch(a, "PDA"), *rca = find_branch(a, "RCA");
    const int tube = pda->tube;
    return tube == rca->tube || a.tubes[tube].parent == rca->tube ? "RCA" : "LCx";
  };
  EXPECT_STREQ(parent(Dominance::right), "RCA");
  EXPECT_STREQ(parent(Dominance::balanced), "RCA");
  EXPECT_STREQ(parent(Dominance::left), "LCx");
}

TEST(Anatomy, TheAccessIsInsideAndLeadsToTheHeart) {
  for (Access access : {Access::femoral, Access::radial}) {
    const Anatomy a = build_anatomy(mean_of(Dominance::right, access));
    const Landmarks& marks = a.landmarks;
    EXPECT_NEAR(marks.access_direction.norm(), 1, 1e-9);
    const TubeUnion tubes(a.tubes);
    double least = 1;
    for (int s = 0; s < static_cast<int>(tubes.segments().size()); ++s)
      least = std::min(least, tubes.distance(s, marks.p_access));
    EXPECT_LT(least, -1e-3);
  }
}

TEST(Anatomy, ParametersOutOfRangeAreRefused) {
  EXPECT_THROW(build_anatomy({.diagonals = 4}), std::invalid_argument);
  EXPECT_THROW(build_anatomy({.heart_scale = 2}), std::invalid_argument);
  EXPECT_THROW(build_anatomy({.left_main_mm = 0}), std::invalid_argument);
}

TEST(Lesion, NarrowsTheLumenByWhatItSaysAndOpensAgain) {
  std::vector<Lesion> lesions = {typical(LesionType::A, "RCA", 0.042), typical(LesionType::B, "LAD", 0.012)};
  const Patient patient = make_patient({}, lesions);
  const Mesh narrowed = patient.lumen.at(0, 0), opened = patient.lumen.at(0, 0, 1);
  EXPECT_TRUE(check_surface(narrowed).sound());
  const BoundingVolumeHierarchy narrow(narrowed), healthy(opened);
  for (const Lesion& lesion : lesions) {
    const NamedBranch& branch = *find_branch(patient.anatomy, lesion.branch);
    const double s = branch.from_m + lesion.from_m + lesion.length_m / 2;
    const Narrowing narrowing = narrowing_at(patient.anatomy, lesions, branch.tube, s);
    const Eigen::Vector3d p = patient.anatomy.tubes[branch.tube].at(s).p;
    const double before = healthy.nearest(p, 0.01).distance_m;
    const double after = narrow.nearest(p + narrowing.shift, 0.01).distance_m;
    EXPECT_NEAR(after / before, 1 - lesion.stenosis, 0.03) << lesion.branch;
    // An eccentric lesion does not change the opposite wall.
    if (lesion.eccentric) {
      EXPECT_NEAR(after + narrowing.shift.norm(), before, 0.1e-3);
    }
  }
  // Far from lesions nothing moved.
  EXPECT_GT(patient.lumen.narrowed.size(), 300u);
  EXPECT_LT(patient.lumen.narrowed.size(), 4000u);
}

TEST(Lesion, WhatDoesNotFitIsRefusedWithWhatExists) {
  const Anatomy a = build_anatomy({});
  const auto refusal = [&](Lesion lesion) {
    try {
      check(a, lesion);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refusal(typical(LesionType::A, "RCA", 0.04)), "accepted");
  EXPECT_NE(refusal(typical(LesionType::A, "LADx", 0.04)).find("expected one of"), std::string::npos);
  EXPECT_NE(refusal(typical(LesionType::A, "LADx", 0.04)).find("LCx"), std::string::npos);
  EXPECT_NE(refusal(typical(LesionType::C, "LM", 0)).find("within the branch's 12.2 mm"), std::string::npos);
  EXPECT_NE(
      refusal({.branch = "RCA", .from_m = 0, .length_m = 0.01, .stenosis = 1.2, .eccentric = false}).find("120 %"),
      std::string::npos);
}

TEST(Lesion, PresetsAreOfTheirType) {
  for (LesionType type : {LesionType::A, LesionType::B, LesionType::C})
    EXPECT_EQ(type_of(typical(type, "LAD", 0)), type);
}

TEST(SphereTree, EveryBranchHangsOnASphereOfItsParent) {
  const Patient patient = make_patient({}, {});
  int roots = 0;
  for (const TreeBranch& branch : patient.tree.branches) {
    if (branch.parent < 0) {
      ++roots;
      continue;
    }
    const TreeSphere& at = patient.tree.branches[branch.parent].spheres.at(branch.parent_sphere);
    EXPECT_LT((at.p - branch.spheres.front().p).norm(), at.radius_m + branch.spheres.front().radius_m) << branch.name;
  }
  EXPECT_EQ(roots, 1);
}

}  // namespace
}  // namespace ostium::vascular
