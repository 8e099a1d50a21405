/// A case that is edited: what is refused changes nothing, what is done can be undone, and what is written reads as
/// what was seen.
#include "data/catalogue/case/case_draft.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "data/catalogue/case/anatomy_file.h"
#include "data/formats/load_error.h"
#include "data/formats/mesh_writer.h"
#include "vascular/anatomy/editing/edit_anatomy.h"
#include "vascular/geometry/implicit/contour.h"

namespace ostium::data {
namespace {

namespace fs = std::filesystem;
using Json = CaseDraft::Json;

fs::path folder(const std::string& name) {
  const fs::path out = fs::path(testing::TempDir()) / ("case-draft-" + std::to_string(getpid())) / name;
  fs::remove_all(out);
  fs::create_directories(out);
  return out;
}

/// A straight artery, still, with two names, in a folder of its own.
std::string imported_artery() {
  const fs::path in = folder("artery");
  vascular::Anatomy anatomy;
  anatomy.aorta = false;
  anatomy.tubes = {vascular::make_tube("main", -1, {{{0, 0, 0}, 2e-3}, {{0.05, 0, 0}, 0}, {{0.1, 0, 0}, 2e-3}})};
  anatomy.branches = {{"1", 0, 0, 0.06}, {"2", 0, 0.06, 0.1}};
  anatomy.landmarks.p_access = {2e-3, 0, 0}, anatomy.landmarks.access_direction = {1, 0, 0};
  anatomy.landmarks.root_axis = {0, 1, 0}, anatomy.landmarks.right_groove = {1, 0, 0};
  anatomy.landmarks.p_lv_apex = {0, -0.08, 0};
  write_file((in / "anatomy.json").string(), anatomy_to_json(anatomy));
  write_mesh((in / "lumen.ply").string(), contour(vascular::TubeUnion(anatomy.tubes)).mesh,
             vascular::LengthUnit::millimetre);
  write_file((in / "artery.json").string(), R"({"schema": "ostium-case/1", "name": "artery", "title": "One artery",
  "card": {"history": "h", "ecg": "e", "planned_access": "p"},
  "imported": {"anatomy": "anatomy.json", "lumen": "lumen.ply"}, "heart_rate_1_min": 70, "lesions": []})");
  return in.string();
}

Json lesion(double from_mm, double percent = 70) {
  return {{"branch", "RCA"},       {"from_mm", from_mm}, {"length_mm", 10}, {"stenosis_percent", percent},
          {"shape", "concentric"}, {"calcified", false}};
}

TEST(CaseDraft, LesionsOfABuiltCaseAreCheckedAsByTheReader) {
  CaseDraft draft("rca-mid-focal");
  const std::size_t had = draft.now().lesions.size();
  draft.add_lesion(lesion(80));
  ASSERT_EQ(draft.now().lesions.size(), had + 1);
  EXPECT_TRUE(draft.changed());
  const int revision = draft.revision();
  EXPECT_THROW(draft.add_lesion(lesion(82)), LoadError) << "two in one place";
  EXPECT_THROW(draft.add_lesion(lesion(5000)), LoadError);
  EXPECT_THROW(draft.change_lesion(had, lesion(80, 140)), LoadError);
  EXPECT_THROW(draft.add_lesion({{"branch", "RCA"}}), LoadError);
  EXPECT_THROW(draft.change_lesion(7, lesion(80)), std::invalid_argument);
  EXPECT_THROW(draft.set("", "heart_rate_1_min", 500), LoadError);
  EXPECT_THROW(draft.edit_anatomy("", [](vascular::Anatomy a) { return a; }), std::invalid_argument);
  EXPECT_EQ(draft.revision(), revision) << "what is refused changes nothing";
  draft.change_lesion(had, lesion(80, 50));
  EXPECT_DOUBLE_EQ(draft.now().lesions[had].stenosis, 0.5);
  draft.undo();
  EXPECT_DOUBLE_EQ(draft.now().lesions[had].stenosis, 0.7);
  EXPECT_EQ(draft.redoes(), "change a lesion");
  draft.undo();
  EXPECT_FALSE(draft.changed());
  EXPECT_EQ(draft.undoes(), "");
  draft.redo(), draft.redo();
  EXPECT_DOUBLE_EQ(draft.now().lesions[had].stenosis, 0.5);
  draft.remove_lesion(had);
  EXPECT_EQ(draft.now().lesions.size(), had);
}

TEST(CaseDraft, AnotherPersonKeepsLesionsThatFit) {
  CaseDraft draft("rca-mid-focal");
  draft.set("take another person", "anatomy.seed", 4);
  EXPECT_EQ(draft.now().seed, 4U);
  draft.set("change the title", "title", "Mine");
  EXPECT_EQ(draft.now().title, "Mine");
  const int revision = draft.revision();
  draft.set("change the title", "title", "Mine");
  EXPECT_EQ(draft.revision(), revision) << "the same is no change";
}

TEST(CaseDraft, ViewsAreOfTheCase) {
  CaseDraft draft("rca-mid-focal");
  draft.set("change the views", "views", {{{"name", "my view"}, {"lao_deg", -30}, {"cran_deg", 20}}});
  ASSERT_EQ(draft.now().views.size(), 1U);
  EXPECT_DOUBLE_EQ(draft.now().views[0].lao_deg, -30);
  EXPECT_THROW(draft.set("", "views", {{{"name", "spider"}, {"lao_deg", 0}, {"cran_deg", 0}}}), LoadError);
  EXPECT_THROW(draft.set("", "views", {{{"name", "far"}, {"lao_deg", 150}, {"cran_deg", 0}}}), LoadError);
  const Json one = {{"name", "a"}, {"lao_deg", 0}, {"cran_deg", 0}};
  EXPECT_THROW(draft.set("", "views", Json::array({one, one})), LoadError);
}

TEST(CaseDraft, AnImportedCaseIsWrittenAsItWasSeen) {
  CaseDraft draft(imported_artery());
  ASSERT_TRUE(draft.imported());
  draft.edit_anatomy("rename 2", [](vascular::Anatomy a) { return with_name(std::move(a), "2", "femoral"); },
                     {"2", "femoral"});
  draft.edit_anatomy("entry", [](vascular::Anatomy a) { return with_entry(std::move(a), {0.01, 0, 0}); });
  EXPECT_THROW(draft.edit_anatomy("", [](vascular::Anatomy a) { return with_name(std::move(a), "1", "femoral"); }),
               std::invalid_argument);
  const fs::path to = folder("copy");
  fs::remove(to);
  fs::create_directory(to);
  for (const FileText& one : draft.texts("copy")) write_file((to / one.path).string(), one.bytes);
  for (const std::string& file : draft.lumen_files())
    fs::copy_file(fs::path(draft.file()).parent_path() / file, to / file);
  draft.saved_as((to / "copy.json").string());
  EXPECT_FALSE(draft.changed());
  const Case again = load_case(draft.file());
  EXPECT_EQ(again.name, "copy");
  ASSERT_TRUE(find_branch(again.imported->anatomy, "femoral"));
  EXPECT_NEAR(again.imported->anatomy.landmarks.p_access.x(), 0.01, 1e-8);
  EXPECT_EQ(again.imported->lumen.triangles.size(), draft.now().imported->lumen.triangles.size());
  draft.undo();
  EXPECT_TRUE(draft.changed()) << "what is undone after saving is a change";
  EXPECT_NEAR(draft.now().imported->anatomy.landmarks.p_access.x(), 2e-3, 1e-8);
  EXPECT_EQ(draft.now().name, "copy");
}

}  // namespace
}  // namespace ostium::data
