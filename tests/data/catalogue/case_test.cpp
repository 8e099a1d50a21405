/// Shipped cases load; errors in a case file are named along with the valid choices. Trees survive a round trip through
/// files.
#include "data/catalogue/case/case.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "data/catalogue/case/anatomy_file.h"
#include "data/catalogue/case/anatomy_keys.h"
#include "data/catalogue/case/case_keys.h"
#include "data/catalogue/case/tree_file.h"
#include "data/catalogue/case/tree_keys.h"
#include "data/catalogue/catalogue.h"
#include "data/formats/load_error.h"
#include "data/formats/mesh_writer.h"
#include "data/formats/write_file.h"
#include "tests/data/refusals.h"
#include "vascular/geometry/implicit/contour.h"

namespace ostium::data {
namespace {

namespace fs = std::filesystem;

const std::string small_case = R"({
  "schema": "ostium-case/1",
  "name": "small",
  "title": "A test",
  "card": { "history": "none", "ecg": "none", "planned_access": "Right femoral" },
  "anatomy": { "dominance": "right", "access": "femoral", "seed": 0 },
  "heart_rate_1_min": 70,
  "lesions": [
    { "branch": "RCA", "from_mm": 40, "length_mm": 9, "stenosis_percent": 70, "shape": "concentric", "calcified": false }
  ]
})";

std::string case_refusal(const std::string& from, const std::string& to) {
  std::string text = small_case;
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  try {
    read_case("folder/small.json", text);
  } catch (const LoadError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Case, TheTenOfTheProductAreThere) {
  setenv("OSTIUM_CASES", (testing::TempDir() + "no-cases-of-ones-own").c_str(), 1);
  std::set<std::string> names;
  for (const Case& c : load_cases()) {
    names.insert(c.name);
    EXPECT_FALSE(c.lesions.empty()) << c.name;
    EXPECT_FALSE(c.card.history.empty() || c.card.ecg.empty() || c.card.planned_access.empty()) << c.name;
    EXPECT_EQ(c.name.ends_with("-radial"), c.anatomy.access == vascular::Access::radial) << c.name;
  }
  for (const char* name :
       {"rca-mid-focal", "lad-proximal-eccentric", "lcx-tubular", "left-main-shaft", "rca-diffuse"}) {
    EXPECT_TRUE(names.count(name)) << name;
    EXPECT_TRUE(names.count(std::string(name) + "-radial")) << name;
  }
  EXPECT_EQ(nlohmann::json::parse(to_json(load_cases())).size(), names.size());
  unsetenv("OSTIUM_CASES");
}

TEST(Case, OneThatCannotBeReadHidesNoOther) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "ostium-a-bad-case";
  std::filesystem::create_directories(folder / "bad");
  std::ofstream(folder / "bad/bad.json") << "{";
  setenv("OSTIUM_CASES", folder.c_str(), 1);
  std::vector<std::string> unread;
  EXPECT_EQ(load_cases(&unread).size(), 11U);
  ASSERT_EQ(unread.size(), 1U);
  EXPECT_NE(unread[0].find("bad.json:1"), std::string::npos) << unread[0];
  try {
    find_case("nowhere");
    ADD_FAILURE() << "accepted";
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("there is no case"), std::string::npos) << error.what();
  }
  unsetenv("OSTIUM_CASES");
  std::filesystem::remove_all(folder);
}

TEST(Case, WithoutAHomeImportedOnesAreThoseOfTheUser) {
  const std::string home = std::getenv("HOME") ? std::getenv("HOME") : "";
  unsetenv("HOME");
  EXPECT_TRUE(std::filesystem::path(imported_folder()).is_absolute()) << imported_folder();
  if (!home.empty()) setenv("HOME", home.c_str(), 1);
}

TEST(Case, ALesionThatDoesNotFitIsRefusedWithWhatExists) {
  EXPECT_EQ(case_refusal("A test", "Another test"), "accepted");
  for (const char* length_mm : {"1e-300", "0.4", "2.9", "1e300"})
    expect_words(case_refusal("\"length_mm\": 9", std::string("\"length_mm\": ") + length_mm), {"length_mm"});
  expect_words(case_refusal("\"length_mm\": 9", "\"length_mm\": 90"),
               {"folder/small.json:9: lesions[0]", "from 40 to 130 mm of RCA", "within the branch's 101."});
  expect_words(case_refusal("\"stenosis_percent\": 70", "\"stenosis_percent\": 120"),
               {"folder/small.json:9: lesions[0].stenosis_percent", "120", "1 to 95"});
  expect_words(case_refusal("\"RCA\"", "\"RAC\""),
               {"folder/small.json:9: lesions[0]", "no branch \"RAC\"", "LAD", "LCx", "RCA", "PDA"});
  for (const char* branch : {"\"aorta\"", "\"right iliac\""})
    expect_words(case_refusal("\"RCA\"", branch),
                 {"folder/small.json:9: lesions[0].branch is ", branch, "a coronary artery"});
}

TEST(Case, LesionsThatShareAStretchAreRefused) {
  const auto second = [](const std::string& from_mm) {
    const std::string one = R"("concentric", "calcified": false })";
    return case_refusal(
        one, one + R"(,
    { "branch": "RCA", "from_mm": )" +
                 from_mm + R"(, "length_mm": 9, "stenosis_percent": 70, "shape": "concentric", "calcified": false })");
  };
  for (const char* at : {"40", "48.9", "31.1"})
    expect_words(second(at), {"folder/small.json:8: lesions", "lesions 1 and 2 of RCA share a stretch", "40 to 49 mm"});
  for (const char* at : {"49", "31", "60"}) EXPECT_EQ(second(at), "accepted");
}

TEST(Case, ALesionLiesAtTheEndOfAnArteryThatIsShorterInSomebody) {
  const Case mean = find_case("rca-diffuse");
  int moved = 0;
  for (std::uint64_t seed = 0; seed <= 20; ++seed) {
    const Case one = with_person(mean, seed);
    const vascular::Anatomy anatomy = anatomy_of(one);
    const double length_m = find_branch(anatomy, "RCA")->length_m();
    ASSERT_EQ(one.lesions.size(), 2U);
    for (std::size_t l = 0; l < 2; ++l) {
      EXPECT_NO_THROW(check(anatomy, one.lesions[l])) << "person " << seed;
      EXPECT_EQ(one.lesions[l].length_m, mean.lesions[l].length_m);
      const bool fits = mean.lesions[l].from_m + mean.lesions[l].length_m <= length_m;
      const double from_m = fits ? mean.lesions[l].from_m : length_m - mean.lesions[l].length_m;
      EXPECT_NEAR(one.lesions[l].from_m, from_m, fits ? 0 : 1e-8) << "person " << seed;
      moved += !fits;
    }
  }
  EXPECT_GT(moved, 0);
}

TEST(Case, ALesionFollowsTheBranchThatItIsAt) {
  const Case mean = find_case("lad-diagonal");
  ASSERT_EQ(mean.lesions.front().at_branch, "D1");
  std::set<double> places_mm;
  for (std::uint64_t seed = 0; seed <= 8; ++seed) {
    const Case one = with_person(mean, seed);
    const vascular::Anatomy anatomy = anatomy_of(one);
    const vascular::Lesion& lesion = one.lesions.front();
    const vascular::NamedBranch &lad = *find_branch(anatomy, "LAD"), &side = *find_branch(anatomy, "D1");
    const auto& tubes = anatomy.tubes;
    const Eigen::Vector3d middle =
        tubes[static_cast<std::size_t>(lad.tube)].at(lad.from_m + lesion.from_m + lesion.length_m / 2).p;
    const Eigen::Vector3d leaves = tubes[static_cast<std::size_t>(side.tube)].nodes.front().p;
    EXPECT_LT((middle - leaves).norm(), 1e-3) << "its middle is where the branch leaves, in person " << seed;
    places_mm.insert(1e3 * lesion.from_m);
  }
  EXPECT_GT(*places_mm.rbegin() - *places_mm.begin(), 2) << "which is not the same in all";
  expect_words(case_refusal("\"calcified\": false", "\"calcified\": false, \"at_branch\": \"OM1\""),
               {"at_branch is \"OM1\"", "a branch that leaves RCA"});
  expect_words(case_refusal("\"from_mm\": 40", "\"from_mm\": -4"), {"from_mm is -4"});
  expect_words(case_refusal("\"from_mm\": 40", "\"from_mm\": -500, \"at_branch\": \"RV\""),
               {"a lesion from -4", "expected it within the branch's"});
}

TEST(Case, AnotherPersonHasPlaqueOfTheirOwn) {
  const Case mean = find_case("rca-diffuse"), one = with_person(mean, 1), again = with_person(mean, 1);
  EXPECT_EQ(with_person(mean, 0).lesions[0].made_of.calcium_arc_rad, mean.lesions[0].made_of.calcium_arc_rad);
  for (std::size_t l = 0; l < mean.lesions.size(); ++l) {
    EXPECT_NE(one.lesions[l].made_of.hardness, mean.lesions[l].made_of.hardness);
    EXPECT_EQ(one.lesions[l].made_of.hardness, again.lesions[l].made_of.hardness);
    EXPECT_TRUE(one.lesions[l].made_of.calcified());
  }
}

TEST(Case, OtherMistakesAreNamed) {
  expect_words(case_refusal("\"right\"", "\"middle\""), {"small.json:6: anatomy.dominance is \"middle\"", "balanced"});
  expect_words(case_refusal("\"seed\": 0", "\"seed\": 1.5"), {"small.json:6: anatomy.seed is 1.5", "whole number"});
  expect_words(case_refusal("\"heart_rate_1_min\": 70", "\"heart_rate_1_min\": 300"), {"small.json:7:", "40 to 180"});
  expect_words(case_refusal("\"calcified\": false", "\"calcified\": 0"), {"small.json:9:", "true or false"});
  expect_words(case_refusal("\"calcified\": false", "\"calcified\": false, \"side_deg\": 3"), {"eccentric ones only"});
  expect_words(case_refusal("\"calcified\": false", "\"calcified\": false, \"calcium_arc_deg\": 200"),
               {"calcium_arc_deg", "120 or more if calcified"});
  expect_words(case_refusal("\"calcified\": false", "\"calcified\": true, \"hardness\": 0"), {"hardness", "0.2 to 5"});
  expect_words(case_refusal("\"name\": \"small\"", "\"name\": \"big\""), {"small.json:3: name is \"big\""});
  expect_words(case_refusal("\"title\"", "\"titel\""), {"titel is not a key of the case", "title"});
  try {
    find_case("rca-mid");
    FAIL();
  } catch (const LoadError& error) {
    expect_words(error.what(), {"no case \"rca-mid\"", "rca-mid-focal"});
  }
}

/// A straight generated tube as an imported case, in a folder of its own.
fs::path imported_case(const std::string& lumen_name = "lumen.ply") {
  static const struct Place {
    fs::path path = fs::path(testing::TempDir()) / ("ostium-case-" + std::to_string(getpid()));
    ~Place() {
      std::error_code error;
      fs::remove_all(path, error);
    }
  } place;
  const fs::path folder = place.path / "mine";
  fs::create_directories(folder);
  vascular::Anatomy anatomy;
  anatomy.aorta = false;
  anatomy.tubes = {vascular::make_tube("LAD", -1, {{{0, 0, 0}, 2e-3}, {{0.03, 0, 0}, 1.8e-3}, {{0.06, 0, 0}, 1.6e-3}})};
  anatomy.branches = {{"LAD", 0, 0, anatomy.tubes[0].length_m()}};
  anatomy.landmarks = vascular::build_anatomy({}).landmarks;
  write_file((folder / "anatomy.json").string(), anatomy_to_json(anatomy));
  write_mesh((folder / "lumen.ply").string(), vascular::contour(vascular::TubeUnion(anatomy.tubes)).mesh,
             vascular::LengthUnit::millimetre);
  std::string text = small_case;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("\"small\"", "\"mine\"");
  replace("\"anatomy\": { \"dominance\": \"right\", \"access\": \"femoral\", \"seed\": 0 }",
          "\"imported\": { \"anatomy\": \"anatomy.json\", \"lumen\": \"" + lumen_name + "\" }");
  replace("\"RCA\"", "\"LAD\"");
  replace("\"from_mm\": 40", "\"from_mm\": 20");
  write_file((folder / "mine.json").string(), text);
  return folder;
}

TEST(Case, AnImportedOneIsACaseLikeAnyOther) {
  const Case c = find_case(imported_case().string());
  ASSERT_TRUE(c.imported);
  ASSERT_EQ(c.lesions.size(), 1u);
  const vascular::Patient patient = patient_of(c);
  EXPECT_EQ(patient.lumen.triangles.size(), c.imported->lumen.triangles.size());
  EXPECT_EQ(patient.lumen.moving, patient.lumen.vertices());  // an LAD moves
  EXPECT_EQ(patient.tree_frames.size(), static_cast<std::size_t>(vascular::beat_frames));
  // The given lesion: 70 % in its middle, none away from it.
  for (const vascular::TreeSphere& sphere : patient.tree.branches[0].spheres) {
    const double healthy = c.imported->anatomy.tubes[0].at(sphere.p.x()).radius_m;
    if (std::fabs(sphere.p.x() - 0.0245) < 1e-3) {
      EXPECT_NEAR(sphere.radius_m / healthy, 0.3, 0.03);
    }
    if (sphere.p.x() > 0.035 && sphere.p.x() < 0.055) {
      EXPECT_NEAR(sphere.radius_m / healthy, 1, 0.05);
    }
  }
}

TEST(Case, ABrokenImportedOneIsRefused) {
  const auto message = [](const fs::path& folder) -> std::string {
    try {
      find_case(folder.string());
    } catch (const LoadError& error) {
      return error.what();
    }
    return "accepted";
  };
  expect_words(message(imported_case("none.ply")), {"mine.json:6", "none.ply", "no such file"});
  expect_words(message(imported_case("../lumen.ply")), {"mine.json:6", "beside this one"});
  const fs::path folder = imported_case();
  std::stringstream text;
  text << std::ifstream(folder / "anatomy.json").rdbuf();
  std::string broken = text.str();
  broken.replace(broken.find("\"parent\": -1"), 12, "\"parent\": 0 ");
  write_file((folder / "anatomy.json").string(), broken);
  expect_words(message(folder), {"anatomy.json:", "tubes[0].parent is 0", "earlier tube"});
  expect_words(case_refusal("\"anatomy\":", "\"imported\": {}, \"anatomy\":"), {"both"});
}

vascular::SphereTree fork() {
  vascular::SphereTree tree;
  tree.branches.push_back({"trunk", -1, -1, {{{0.01, 0.02, 0.03}, 2e-3, 0}, {{0.014, 0.023, 0.03}, 1.5e-3, 5e-3}}});
  tree.branches.push_back({"twig", 0, 1, {{{0.014, 0.023, 0.031}, 1e-3, 0}}});
  return tree;
}

TEST(TreeFile, JsonBringsBackTheTree) {
  const vascular::SphereTree back = read_tree("t.json", tree_to_json(fork()));
  ASSERT_EQ(back.branches.size(), 2u);
  EXPECT_EQ(back.branches[1].name, "twig");
  EXPECT_EQ(back.branches[1].parent, 0);
  EXPECT_EQ(back.branches[1].parent_sphere, 1);
  EXPECT_LT((back.branches[0].spheres[1].p - Eigen::Vector3d(0.014, 0.023, 0.03)).norm(), 1e-7);  // 0.0001 mm written
  EXPECT_NEAR(back.branches[0].spheres[1].s_m, 5e-3, 1e-7);
  EXPECT_NEAR(back.branches[0].spheres[1].radius_m, 1.5e-3, 1e-7);
}

TEST(TreeFile, ABrokenTreeIsRefusedByLine) {
  const auto broken = [](const std::string& from, const std::string& to) -> std::string {
    std::string text = tree_to_json(fork());
    text.replace(text.find(from), from.size(), to);
    try {
      read_tree("t.json", text);
    } catch (const LoadError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(broken("\"parent\": 0", "\"parent\": 1").find("earlier branch"), std::string::npos);
  EXPECT_NE(broken("\"parent_sphere\": 1", "\"parent_sphere\": 2").find("sphere of the parent"), std::string::npos);
  EXPECT_NE(broken("2.0000]", "0]").find("t.json:5"), std::string::npos);
  EXPECT_THROW(write_tree("tree.txt", fork()), LoadError);
  EXPECT_THROW(write_tree("/proc/nowhere/tree.json", fork()), WriteError);
}

TEST(TreeFile, VtkHasALineABranchInLps) {
  const std::string vtp = tree_to_vtp(fork());
  EXPECT_NE(vtp.find("NumberOfPoints=\"4\""), std::string::npos);  // the side branch begins at its parent
  EXPECT_NE(vtp.find("NumberOfLines=\"2\""), std::string::npos);
  EXPECT_NE(vtp.find("MaximumInscribedSphereRadius"), std::string::npos);
  EXPECT_NE(vtp.find("10.0000 -30.0000 20.0000"), std::string::npos);  // left, back, head
}

TEST(TreeFile, VtkOfSomebodysMeshKeepsItsAxesAndUnit) {
  const std::string in_mm = tree_to_vtp(fork(), vascular::LengthUnit::millimetre);
  EXPECT_NE(in_mm.find("10.0000 20.0000 30.0000"), std::string::npos);
  const std::string in_m = tree_to_vtp(fork(), vascular::LengthUnit::metre);
  EXPECT_NE(in_m.find("0.0100000 0.0200000 0.0300000"), std::string::npos);
  EXPECT_NE(in_m.find("\n0.0015000\n"), std::string::npos);  // a radius
}

}  // namespace
}  // namespace ostium::data
