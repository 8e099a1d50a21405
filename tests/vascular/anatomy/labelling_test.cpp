/// Hearts are named and beat; vessels of other organs have numbers, stay still, and stand as they are in their file.
#include "vascular/anatomy/labelling/labelling.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/made_up_vessels.h"
#include "tests/vascular/geometry/bent_tube.h"
#include "vascular/patient/patient.h"

namespace ostium::vascular {
namespace {

/// 60 mm long, 5 mm wide, along an arc: also the LAD's course, turned, would nearly fit it.
Mesh single_artery() { return mesh_of(test::BentTube{0.06, 0.005, 0.1}); }

LabellingOptions looked_for(HeartSearch heart) {
  LabellingOptions options;
  options.heart = heart;
  return options;
}

void expect_as_it_was(const LabelledVessels& found, const Mesh& mesh) {
  EXPECT_FALSE(found.heart);
  EXPECT_FALSE(found.anatomy.aorta);
  EXPECT_EQ(found.R_PF, Eigen::Matrix3d::Identity());
  for (std::size_t b = 0; b < found.anatomy.branches.size(); ++b)
    EXPECT_EQ(found.anatomy.branches[b].name, "vessel " + std::to_string(b + 1));
  EXPECT_EQ(make_patient(found.anatomy, mesh, {}).lumen.moving, 0U);
}

TEST(Labelling, NamesAreGivenAtOnceAndEachToOne) {
  Mesh two = single_artery(), other = two;
  for (auto& p : other.vertices) p.z() += 0.05;
  append(two, other);
  LabellingOptions options = looked_for(HeartSearch::none);
  options.names = {{"vessel 1", "vessel 2"}, {"vessel 2", "vessel 1"}};
  const LabelledVessels found = label_vessels(two, options);
  ASSERT_EQ(found.anatomy.branches.size(), 2U);
  EXPECT_EQ(found.anatomy.branches[0].name, "vessel 2");
  EXPECT_EQ(found.anatomy.branches[1].name, "vessel 1");
  options.names = {{"vessel 1", "x"}, {"vessel 2", "x"}};
  EXPECT_THROW(label_vessels(two, options), MeshError);
  options.names = {{"vessel 1", "vessel 2"}};
  EXPECT_THROW(label_vessels(two, options), MeshError);
}

TEST(Labelling, ASingleArteryIsAVesselAndStill) {
  const Mesh mesh = single_artery();
  const LabelledVessels found = label_vessels(mesh);
  expect_as_it_was(found, found.lumen);
  ASSERT_EQ(found.anatomy.branches.size(), 1U);
  EXPECT_NEAR(found.anatomy.branches[0].length_m(), 0.06, 0.0005);
  EXPECT_LT((found.lumen.vertices.front() - mesh.vertices.front()).norm(), 1e-9);
}

/// Its widest place may be found two radii before a lid.
TEST(Labelling, ASingleArteryIsStoredFromLidToLid) {
  for (const auto& [length, diameter] : {std::pair{0.05, 0.0065}, {0.05, 0.006}, {0.1, 0.012}, {0.03, 0.003}}) {
    const LabelledVessels found = label_vessels(mesh_of(test::BentTube{length, diameter, 0.1}));
    ASSERT_EQ(found.anatomy.branches.size(), 1U);
    EXPECT_NEAR(found.anatomy.branches[0].length_m(), length, 0.01 * length) << length << " " << diameter;
  }
}

/// An aorta's width and bend are no aorta; nor is it cut where one would have begun.
TEST(Labelling, ATubeAsWideAndBentAsAnAortaIsAVessel) {
  const test::BentTube tube{0.2, 0.025, 0.06};
  const Mesh mesh = mesh_of(tube);
  const LabelledVessels found = label_vessels(mesh);
  expect_as_it_was(found, found.lumen);
  ASSERT_EQ(found.anatomy.branches.size(), 1U);
  EXPECT_NEAR(found.anatomy.branches[0].length_m(), tube.length, 0.01 * tube.length);
}

TEST(Labelling, AHeartIsOneIfSomebodySaysSo) {
  const LabelledVessels found = label_vessels(single_artery(), looked_for(HeartSearch::assumed));
  EXPECT_TRUE(found.heart);
  EXPECT_GT(make_patient(found.anatomy, found.lumen, {}).lumen.moving, 0U);
  // Too wide for a coronary artery.
  EXPECT_THROW(label_vessels(mesh_of(test::BentTube{0.1, 0.01, 0.2}), looked_for(HeartSearch::assumed)), MeshError);
}

TEST(Labelling, NoneIsLookedForIfSomebodySaysSo) {
  const Mesh heart = mesh_of(synthetic::made_up_vessels("coronary arteries", 1));
  expect_as_it_was(label_vessels(heart, looked_for(HeartSearch::none)), heart);
}

class LabellingOfKind : public testing::TestWithParam<std::string> {};

TEST_P(LabellingOfKind, IsRight) {
  const synthetic::MadeUpVessels made = synthetic::made_up_vessels(GetParam(), 1);
  const Mesh mesh = mesh_of(made);
  const LabelledVessels found = label_vessels(mesh);
  EXPECT_EQ(found.heart, made.heart) << found.heart_doubt;
  EXPECT_EQ(found.anatomy.aorta, made.aorta) << found.aorta_doubt;
  EXPECT_EQ(found.heart, found.heart_doubt > 0 && found.heart_doubt < 1);
  if (!made.heart && !made.aorta) expect_as_it_was(found, found.lumen);
  EXPECT_TRUE(!made.heart || find_branch(found.anatomy, "LAD"));
  const bool mirrored = std::any_of(found.notes.begin(), found.notes.end(), [](const std::string& note) {
    return note.find("its mirror image has") != std::string::npos;
  });
  EXPECT_EQ(mirrored, GetParam() == "mirrored coronary arteries");
  EXPECT_TRUE(std::none_of(found.notes.begin(), found.notes.end(), [](const std::string& note) {
    return note.find("the spacing of slices") != std::string::npos;
  }));
}

std::string note_on_axes(const Mesh& mesh) {
  for (const std::string& note : label_vessels(mesh).notes)
    if (note.find("the spacing of slices") != std::string::npos) return note;
  return "";
}

TEST(Labelling, AnAxisThatWasScaledAloneIsSaid) {
  const Mesh whole = mesh_of(synthetic::made_up_vessels("coronary arteries", 1));
  EXPECT_EQ(note_on_axes(whole), "");
  struct {
    int axis;
    double factor;
    const char* said;
  } const scaled[] = {{2, 1.7, "drawn out along the file's z axis"}, {0, 0.6, "flat along the file's x axis"}};
  for (const auto& [axis, factor, said] : scaled) {
    Mesh mesh = whole;
    for (Eigen::Vector3d& p : mesh.vertices) p[axis] *= factor;
    EXPECT_NE(note_on_axes(mesh).find(said), std::string::npos) << said << ": " << note_on_axes(mesh);
  }
}

INSTANTIATE_TEST_SUITE_P(Labelling, LabellingOfKind, testing::ValuesIn(synthetic::made_up_kinds()),
                         [](const auto& kind) {
                           std::string name = kind.param;
                           std::ranges::replace(name, ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace ostium::vascular
