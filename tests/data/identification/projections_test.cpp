/// Sets of projections: correct reading, errors by entry, and the ways in.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "data/formats/dicom/dicom.h"
#include "data/formats/dicom/dicom_geometry.h"
#include "data/formats/write_file.h"
#include "data/identification/forward/misfit.h"
#include "data/identification/forward/prediction.h"
#include "data/identification/measurement/measured_curves.h"
#include "data/identification/measurement/measurement_reader.h"
#include "data/identification/report/explanation_report.h"
#include "tests/data/refusals.h"
#include "tests/support/sets/undeclared.h"

namespace ostium::data {
namespace {

using Json = nlohmann::ordered_json;
using Eigen::Vector2d;
using units::mm, units::degree;

const MeasurementSet& seen_set() {
  static const MeasurementSet set = synthetic::undeclared_set("views:clean", 1).set;
  return set;
}
Json seen_file() { return Json::parse(synthetic::to_json(seen_set())); }

std::string seen_refusal(const Json& file) {
  return refusal_of([&] { read_measurement("set/measurement.json", file.dump(1)); });
}
std::string refusal_with(const char* pointer, const Json& value) {
  Json file = seen_file();
  file[Json::json_pointer(pointer)] = value;
  return seen_refusal(file);
}

/// A folder of its own that is removed.
struct SetFolder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("ostium-projections-" + std::to_string(getpid()));
  SetFolder() { std::filesystem::create_directories(path); }
  ~SetFolder() { std::filesystem::remove_all(path); }
  std::string write(const std::string& name, const std::string& text) const {
    write_file((path / name).string(), text);
    return (path / name).string();
  }
};

void expect_same(const MeasurementSet& a, const MeasurementSet& b, double px) {
  ASSERT_EQ(a.experiments.size(), b.experiments.size());
  for (std::size_t e = 0; e < a.experiments.size(); ++e) {
    const auto &x = a.experiments[e].polylines, &y = b.experiments[e].polylines;
    ASSERT_EQ(x.size(), y.size()) << a.experiments[e].id;
    for (std::size_t v = 0; v < x.size(); ++v) {
      EXPECT_EQ(x[v].view, y[v].view);
      ASSERT_EQ(x[v].points_px.size(), y[v].points_px.size());
      for (std::size_t i = 0; i < x[v].points_px.size(); ++i)
        EXPECT_LT((x[v].points_px[i] - y[v].points_px[i]).norm(), px);
    }
  }
}

TEST(Projections, AreReadAsTheyWereWritten) {
  const MeasurementSet set = read_measurement("m.json", seen_file().dump());
  EXPECT_EQ(set.unit().name, "px");
  EXPECT_DOUBLE_EQ(*set.imaging.noise_sigma_m, *seen_set().imaging.noise_sigma_m);
  expect_same(set, seen_set(), 1e-9);
  ASSERT_EQ(set.views.size(), 2u);
  for (std::size_t v = 0; v < 2; ++v) {
    const Camera &read = set.views[v].camera, &meant = seen_set().views[v].camera;
    const Eigen::Vector3d p(0.02, -0.03, 0.05);
    EXPECT_LT((read(p) - meant(p)).norm(), 1e-6);
  }
}

TEST(Projections, TheExactEntryIsNamed) {
  Json file = seen_file();
  file["experiments"][3]["projections"][1]["polyline_px"][7] = {1, 2, 3};
  expect_words(seen_refusal(file),
               {"set/measurement.json:", "experiments[3].projections[1].polyline_px[7]", "expected 2 numbers, got 3"});
  expect_words(refusal_with("/experiments/3/projections/1/view", "C"),
               {"experiments[3].projections[1].view is \"C\"", "A, B"});
  expect_words(refusal_with("/experiments/3/projections/1/view", "A"), {"view is \"A\"", "does not have yet"});
  expect_words(refusal_with("/experiments/3/projections/0/polyline_px/5/0", 1400),
               {"experiments[3].projections[0].polyline_px[5] is [1400", "a pixel of the picture", "[1023, 1023]"});
  expect_words(refusal_with("/views/1/id", "A"), {"views[1].id is \"A\"", "no other view"});
  expect_words(refusal_with("/imaging/noise_sigma_px", 0), {"imaging.noise_sigma_px is 0", "null if it is unknown"});
  expect_words(refusal_with("/imaging/registration", "given"), {"imaging.registration is not a key"});
  file = seen_file();
  file["experiments"][2].erase("projections");
  expect_words(seen_refusal(file), {"experiments[2] has no polyline"});
  file = seen_file();
  file["views"][0].erase("pixel_mm");
  expect_words(seen_refusal(file), {"views[0].pixel_mm is missing", "dicom"});
}

TEST(Projections, ViewsWhoseNumbersDoNotGoTogether) {
  expect_words(refusal_with("/views/0/u", {2, 0, 0}), {"views[0].u is [2, 0, 0]", "of length 1, got 2"});
  Json file = seen_file();
  file["views"][0]["v"] = file["views"][0]["u"];
  expect_words(seen_refusal(file), {"views[0].v is", "perpendicular to u"});
  file = seen_file();
  for (const char* key : {"source_mm", "pixel_0_0_mm"})
    for (Json& x : file["views"][1][key]) x = x.get<double>() * 1e-3;
  expect_words(seen_refusal(file), {"views[1]: its source is", "expected 200 to 3000 mm", "are these m?"});
  file = seen_file();
  file["views"][0]["pixel_mm"] = 0.3e-3;
  expect_words(seen_refusal(file), {"views[0]", "1024 columns of 0.0003 mm", "are these m?"});
  file = seen_file();
  file["views"][0]["pixel_0_0_mm"][0] = 2000;
  expect_words(seen_refusal(file), {"views[0]: its source", "in one frame"});
}

TEST(Projections, AnglesThatAreNotThoseOfTheGeometry) {
  Json file = seen_file();
  const GantryAngles at = gantry_angles(seen_set().views[1].camera.outwards());
  file["views"][1]["primary_deg"] = at.primary_rad / degree,
  file["views"][1]["secondary_deg"] = at.secondary_rad / degree;
  EXPECT_EQ(seen_refusal(file), "accepted");
  file["views"][1]["primary_deg"] = at.primary_rad, file["views"][1]["secondary_deg"] = at.secondary_rad;
  expect_words(seen_refusal(file), {"views[1].primary_deg", "degrees from where source and detector are", "radians?"});
  file["views"][1]["primary_deg"] = -20;
  expect_words(seen_refusal(file), {"views[1].primary_deg", "y to the back"});
}

/// All clicks of an experiment changed alike.
Json with_clicks(const std::function<Vector2d(const Vector2d&, const Camera&)>& change) {
  Json file = seen_file();
  for (Json& projection : file["experiments"][4]["projections"]) {
    const Camera& camera = seen_set().views[projection["view"] == "A" ? 0 : 1].camera;
    for (Json& p : projection["polyline_px"]) {
      const Vector2d to = change(Vector2d(p[0].get<double>(), p[1].get<double>()), camera);
      p = {to.x(), to.y()};
    }
  }
  return file;
}

TEST(Projections, ClicksInOtherUnitsAreSuspected) {
  const auto said = [](auto&& change) { return seen_refusal(with_clicks(change)); };
  EXPECT_EQ(said([](const Vector2d& p, const Camera&) { return p; }), "accepted");
  expect_words(said([](const Vector2d& p, const Camera& c) -> Vector2d { return p * c.pixel_m / mm; }),
               {"experiments[4].projections[0].polyline_px", "sees the base at", "mm on the detector?"});
  expect_words(
      said([](const Vector2d& p, const Camera& c) -> Vector2d { return (p - c.middle_px()) * c.pixel_m / mm; }),
      {"experiments[4].projections[0].polyline_px", "from its middle?"});
  expect_words(said([](const Vector2d& p, const Camera& c) -> Vector2d { return p * c.pixel_m; }),
               {"experiments[4].projections[0].polyline_px", "metres?"});
  Json file = seen_file();
  Json& points = file["experiments"][4]["projections"][0]["polyline_px"];
  std::reverse(points.begin(), points.end());
  expect_words(seen_refusal(file), {"experiments[4].projections[0].polyline_px", "from base to tip"});
  file = seen_file();
  file["experiments"][4]["set"][0]["inserted_length_mm"] =
      file["experiments"][4]["set"][0]["inserted_length_mm"].get<double>() / 10;
  expect_words(seen_refusal(file), {"experiments[4].projections[0].polyline_px", "is inserted_length_mm in mm?"});
}

/// The set with its clicks in a table.
Json tabled(const MeasurementSet& set, std::string& table, char separator) {
  Json file = Json::parse(synthetic::to_json(set));
  table = "# clicked by hand\n";
  for (const char* name : {"experiment", "view", "column_px", "row_px"})
    table += std::string(name) + (std::string(name) == "row_px" ? '\n' : separator);
  for (const Experiment& e : set.experiments)
    for (const ClickedPolyline& polyline : e.polylines)
      for (const Vector2d& p : polyline.points_px)
        table += e.id + separator + set.views[polyline.view].id + separator + std::to_string(p.x()) + separator +
                 std::to_string(p.y()) + "\n";
  for (Json& e : file["experiments"]) e.erase("projections");
  file["polylines_csv"] = "clicks.csv";
  return file;
}

TEST(Projections, ATableInTheirPlace) {
  for (const char separator : {',', ';', '\t'}) {
    const SetFolder folder;
    std::string table;
    const std::string set = folder.write("measurement.json", tabled(seen_set(), table, separator).dump());
    folder.write("clicks.csv", table);
    expect_same(load_measurement(set), seen_set(), 1e-5);
    expect_same(load_measurement(folder.path.string()), seen_set(), 1e-5);
  }
}

/// The amended set lies in another folder than the table.
TEST(Projections, ATableIsWrittenOut) {
  const SetFolder folder;
  std::string table;
  const std::string text = tabled(seen_set(), table, ',').dump();
  const std::string file = folder.write("measurement.json", text);
  folder.write("clicks.csv", table);
  const MeasurementSet set = load_measurement(file);
  expect_same(read_measurement("elsewhere/measurement.json", written_out(text, set)), set, 1e-12);
}

TEST(Projections, ATableIsReadStrictly) {
  const SetFolder folder;
  std::string table;
  const Json file = tabled(seen_set(), table, ',');
  const std::string set = folder.write("measurement.json", file.dump());
  const auto said = [&](const std::string& from, const std::string& to) {
    std::string text = table;
    text.replace(text.find(from), from.size(), to);
    folder.write("clicks.csv", text);
    return refusal_of([&] { load_measurement(set); });
  };
  expect_words(said("column_px", "x_px"), {"clicks.csv:2", "x_px", "expected experiment, view, column_px, row_px"});
  expect_words(said("x0,A", "y0,A"), {"clicks.csv:3: experiment is \"y0\""});
  expect_words(said("x0,A", "x0,Z"), {"clicks.csv:3: view is \"Z\"", "A, B"});
  expect_words(said("x0,A,", "x0,A,1,"), {"clicks.csv:3: 5 fields; expected 4"});
  expect_words(said("x0,A,", "x0,A,x"), {"clicks.csv:3: column_px is \"x", "a number"});
  expect_words(said("x0,A,", "x0,A,9"), {"clicks.csv: experiment \"x0\", view \"A\", point 1"});
  std::filesystem::remove(folder.path / "clicks.csv");
  expect_words(refusal_of([&] { load_measurement(set); }), {"clicks.csv: cannot be read"});
  Json both = seen_file();
  both["polylines_csv"] = "clicks.csv";
  expect_words(seen_refusal(both), {"polylines_csv", "experiments[0].projections", "one of them"});
}

fluoro::CineRun frame_at(double lao_deg, double cran_deg) {
  fluoro::CineRun run;
  run.view.arm.lao_rad = lao_deg * degree, run.view.arm.cran_rad = cran_deg * degree;
  run.view.pixels = 64, run.view.field_m = 64 * 0.4 * mm;
  run.programme = fluoro::cine(15);
  run.frames.push_back({64, 64, std::vector<std::uint8_t>(64 * 64)});
  return run;
}

/// A frame as the renderer writes it, and where the renderer's own camera sees points.
TEST(Projections, AFramesTagsGiveAView) {
  const SetFolder folder;
  const fluoro::CineRun run = frame_at(-30, 20);
  write_dicom((folder.path / "frame.dcm").string(), run);
  Json file = seen_file();
  file["views"][0] = {{"id", "A"}, {"dicom", "frame.dcm"}, {"isocentre_mm", {10, 20, 30}}};
  file["polylines_csv"] = "clicks.csv";
  for (Json& e : file["experiments"]) e.erase("projections");
  folder.write("clicks.csv", "experiment,view,column_px,row_px\n");
  const std::string set = folder.write("measurement.json", file.dump());
  expect_words(refusal_of([&] { load_measurement(set); }), {"experiments[0] has no polyline"});

  const DicomGeometry tags = read_dicom_geometry((folder.path / "frame.dcm").string());
  EXPECT_NEAR(tags.primary_deg, -30, 1e-9);
  EXPECT_NEAR(tags.secondary_deg, 20, 1e-9);
  EXPECT_NEAR(tags.source_to_detector_mm, 1e3 * run.view.arm.source_to_detector_m, 1e-9);
  EXPECT_NEAR(tags.source_to_isocentre_mm, 1e3 * run.view.arm.source_to_isocentre_m, 1e-9);
  EXPECT_NEAR(tags.pixel_mm, 0.4, 1e-9);
  EXPECT_EQ(tags.columns, 64);
}

TEST(Projections, AViewOfAFrameSeesWhatTheRendererSees) {
  const SetFolder folder;
  const fluoro::CineRun run = frame_at(-30, 20);
  write_dicom((folder.path / "frame.dcm").string(), run);
  Json file = seen_file();
  file["views"] = {{{"id", "A"}, {"dicom", "frame.dcm"}}};
  // One straight stub of wire at the isocentre, clicked where the renderer projects it.
  Json e = file["experiments"][0];
  e["base"]["position_mm"] = {0, 0, 0};
  e["set"][0]["inserted_length_mm"] = 5;
  e["projections"] = {{{"view", "A"}, {"polyline_px", {{31.5, 31.5}, {32, 32}}}}};
  file["experiments"] = {e};
  const MeasurementSet set = load_measurement(folder.write("measurement.json", file.dump()));
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(3, 0, 0), Eigen::Vector3d(0, 2, -4), Eigen::Vector3d(-1, 3, 2)}) {
    const Eigen::Vector3d of_patient(p.x(), p.z(), -p.y());  // the renderer's y goes to the head, z to the front
    const Vector2d on_detector = *project(run.view.arm, of_patient * mm) / (0.4 * mm);
    EXPECT_LT((set.views[0].camera(p * mm) - Vector2d(31.5 + on_detector.x(), 31.5 - on_detector.y())).norm(), 1e-6);
  }
  const MeasurementSet moved = read_measurement("elsewhere/m.json", written_out(file.dump(), set));
  EXPECT_LT((moved.views[0].camera.source_m - set.views[0].camera.source_m).norm(), 1e-12);
  expect_words(refusal_of([&] { read_dicom_geometry((folder.path / "measurement.json").string()); }),
               {"measurement.json is not a DICOM file"});
  expect_words(refusal_of([&] { read_dicom_geometry((folder.path / "none.dcm").string()); }), {"cannot be read"});
}

struct Tag {
  std::uint16_t group, element;
  std::string bytes() const { return {char(group & 255), char(group >> 8), char(element & 255), char(element >> 8)}; }
};

/// Writes another value, of an even length, into a file of explicit little endian, under the tag `as`.
void retag(const std::string& file, const Tag& tag, const Tag& as, const std::string& value) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(in)), {});
  const auto at = bytes.find(tag.bytes());  // two bytes of its kind and two of its length come before the value
  ASSERT_NE(at, std::string::npos) << file;
  bytes.replace(at + 8, static_cast<unsigned char>(bytes[at + 6]), value);
  bytes[at + 6] = static_cast<char>(value.size());
  bytes.replace(at, 4, as.bytes());
  std::ofstream(file, std::ios::binary) << bytes;
}

TEST(Projections, TagsThatNoPictureOfACArmHasAreRefusedByName) {
  const SetFolder folder;
  const std::string frame = (folder.path / "frame.dcm").string();
  Json file = seen_file();
  file["views"] = {{{"id", "A"}, {"dicom", "frame.dcm"}}};
  const std::string set = folder.write("measurement.json", file.dump());
  const auto under = [&](const Tag& tag, const Tag& as, const std::string& value) {
    write_dicom(frame, frame_at(-30, 20));
    retag(frame, tag, as, value);
    return refusal_of([&] { load_measurement(set); });
  };
  const auto with = [&](const Tag& tag, const std::string& value) { return under(tag, tag, value); };
  const Tag body_part{0x18, 0x15}, orientation{0x20, 0x20};
  expect_words(with({0x18, 0x1510}, "-300"), {"frame.dcm", "PositionerPrimaryAngle is -300", "-180 to 180"});
  expect_words(with({0x18, 0x1511}, "1e300 "), {"PositionerSecondaryAngle is 1e+300", "-90 to 90"});
  expect_words(with({0x08, 0x60}, "CT"), {"Modality is \"CT\"", "XA or RF"});
  expect_words(under(body_part, {0x18, 0x1500}, "DYNAMIC "), {"PositionerMotion is DYNAMIC", "C-arm"});
  expect_words(under(body_part, {0x18, 0x1134}, "DYNAMIC "), {"TableMotion is DYNAMIC", "table"});
  for (const char* mirrored : {"RP\\FP ", "LA\\H"})
    expect_words(with(orientation, mirrored), {"PatientOrientation is ", "mirrored"});
  for (const char* coarse : {"L\\F ", "LA\\FP "})
    EXPECT_EQ(with(orientation, coarse).find("PatientOrientation"), std::string::npos) << coarse;
}

/// The clicked points of the true wire lie on the prediction with the true stiffness: 1 px is 0.2 mm.
TEST(Projections, APredictionLiesWhereTheOtherSolverIsSeen) {
  MeasurementSet set = seen_set();
  set.experiments.resize(3);
  synthetic::Truth truth;
  for (Experiment& e : set.experiments) {
    const boundary_value::Solution exact = boundary_value::solve(synthetic::problem_of(set, e, truth));
    ASSERT_TRUE(exact.converged);
    e.polylines = {{0, {}}, {1, {}}};
    for (ClickedPolyline& polyline : e.polylines)
      for (const Eigen::Vector3d& p : exact.curve) polyline.points_px.push_back(set.views[polyline.view].camera(p));
  }
  for (const Prediction& p : predict(set)) {
    EXPECT_EQ(p.unit.name, "px");
    EXPECT_LT(*p.rms_to_measured_m, 0.15) << p.id;
    ASSERT_EQ(p.projections.size(), 2u);
    EXPECT_EQ(p.projections[1].view, "B");
    EXPECT_EQ(p.projections[1].points_px.size(), p.shape.points_m.size());
  }
}

TEST(Projections, AMisfitIsAcrossTheProjectedWireAndInPixels) {
  MeasurementSet set = seen_set();
  Experiment& e = set.experiments[0];
  PredictedShape shape;
  const Camera& camera = set.views[0].camera;
  // A straight wire in the plane of the detector, seen along a row.
  for (int i = 0; i <= 10; ++i) shape.points_m.push_back(camera.pixel_in_room({100.0 + 20 * i, 500}));
  e.polylines = {{0, {{90, 503}, {150, 500}, {200, 496}, {320, 501}}}};
  const MeasuredView view = seen(set, e, {}, {});
  const Eigen::VectorXd off = misfit(e, shape, view);
  ASSERT_EQ(off.size(), 12);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(off.segment<3>(3 * i).dot(camera.v), (Eigen::Vector4d(3, 0, -4, 1))[i], 1e-6) << i;
  EXPECT_NEAR(rms({&e}, {off}), std::sqrt((9 + 16 + 1) / 4.0), 1e-6);
  EXPECT_EQ(numbers_measured(e), 4u);
  EXPECT_DOUBLE_EQ(noise_floor(seen_set(), 0.5), 0.5) << "one number a point";
}

TEST(Projections, CurvesOfTheViewsFollowEachOther) {
  const Experiment& e = seen_set().experiments[0];
  const std::vector<MeasuredCurve> curves = measured_curves(e);
  ASSERT_EQ(curves.size(), 2u);
  EXPECT_EQ(curves[1].first, e.polylines[0].points_px.size());
  EXPECT_NEAR(curves[0].from_tip_m.front(), e.set[0].inserted_m, 1e-12);
  EXPECT_EQ(curves[1].from_tip_m.back(), 0);
}

}  // namespace
}  // namespace ostium::data
