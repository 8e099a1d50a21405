#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/session/operator/setup.h"
#include "data/assessment/score_list.h"
#include "data/catalogue/case/anatomy_file.h"
#include "data/catalogue/case/case.h"
#include "data/catalogue/case/markups_file.h"
#include "data/catalogue/case/tree_file.h"
#include "data/catalogue/catalogue.h"
#include "data/catalogue/instrument/instrument_reader.h"
#include "data/catalogue/script/script.h"
#include "data/identification/measurement/measurement_reader.h"
#include "tests/fuzz/target.h"
#include "tests/support/sets/synthetic_set.h"

namespace ostium::fuzz {

namespace {

namespace fs = std::filesystem;
using data::LoadError;

/// Files that ship, under their whole paths: a script looks for its parts from there.
std::vector<Seed> shipped(const char* folder) {
  std::vector<Seed> seeds;
  for (const fs::directory_entry& entry : fs::directory_iterator(fs::path(data::data_folder()) / folder)) {
    if (entry.path().extension() != ".json") continue;
    std::ifstream file(entry.path(), std::ios::binary);
    seeds.push_back({entry.path().string(), {std::istreambuf_iterator<char>(file), {}}});
  }
  std::ranges::sort(seeds, {}, &Seed::name);
  return seeds;
}

std::vector<Seed> trees() {
  return {{"tree.json", R"({ "schema": "ostium-tree/1", "branches": [
    { "name": "a", "parent": -1, "parent_sphere": -1, "spheres": [[0, 0, 0, 2], [5, 0, 0, 1.5], [9, 1, 0, 1]] },
    { "name": "b", "parent": 0, "parent_sphere": 1, "spheres": [[5, 2, 0, 1], [5, 9, 3, 0.5]] } ] })"}};
}

std::vector<Seed> anatomies() {
  return {{"anatomy.json", R"({ "schema": "ostium-anatomy/1", "aorta": true, "ascending_mm": 60, "landmarks": {
    "access_mm": [0, -300, 0], "access_direction": [0, 1, 0], "left_ostium_mm": [0, 0, 0],
    "right_ostium_mm": [-20, 0, 10], "annulus_mm": [-10, -15, 0], "root_axis": [0, 1, 0], "lv_base_mm": [20, -20, 10],
    "lv_apex_mm": [60, -70, 50], "right_groove": [-1, 0, 0.2] },
    "branches": [{ "name": "aorta", "tube": 0, "from_mm": 0, "to_mm": 100 }, { "name": "RCA", "tube": 1, "from_mm": 0,
    "to_mm": 30 }],
    "tubes": [{ "name": "aorta", "parent": -1, "blend": 1, "nodes": [[0, 0, 0, 12], [0, 60, 0, 11], [0, 150, 0, 10]] },
    { "name": "RCA", "parent": 0, "blend": 0.5, "nodes": [[-12, 5, 5, 1.6], [-30, 0, 10, 1.4], [-50, -20, 10, 1]] }] })"}};
}

std::vector<Seed> measurements() {
  data::MeasurementSet wire = synthetic::free_wire(2);
  synthetic::measure(wire, {}, 0.05);
  return {{"measurement.json", synthetic::to_json(wire)}};
}

/// A curve with radii, as 3D Slicer saves it.
std::vector<Seed> markups() {
  return {{"lines.mrk.json", R"({"@schema": "markups-schema-v1.0.3.json#", "markups": [{"type": "Curve",
 "coordinateSystem": "LPS", "coordinateUnits": "mm", "controlPoints": [
  {"id": "1", "label": "C-1", "position": [0.5, -12.25, 3.0], "positionStatus": "defined"},
  {"id": "2", "label": "C-2", "position": [8.5, -14.0, 9.0], "positionStatus": "defined"},
  {"id": "3", "label": "C-3", "position": [19.0, -10.0, 14.5], "positionStatus": "defined"}],
 "measurements": [{"name": "length", "enabled": true, "value": 21.5, "units": "mm"},
  {"name": "Radius", "enabled": false, "controlPointValues": [1.9, 1.7, 1.25]}]}]}
)"}};
}

std::vector<Seed> setups() {
  app::RunSetup setup;
  app::set_vessel("rca-mid-focal", vascular::LengthUnit::millimetre, setup);
  app::set_script(data::find_script("iliac-wire"), setup);
  return {{"run.h5", app::to_json(setup)}};
}

/// What a recording says that it was of; a replay reads the texts in it.
Answer read_setup(const Seed& input) {
  return answer_of<LoadError>([&] {
    const app::RunSetup setup = app::setup_from_json(input.name, input.bytes);
    for (std::size_t t = 0; t < setup.tool_texts.size(); ++t)
      data::read_instrument(setup.tool_files[t], setup.tool_texts[t]);
    if (!setup.is_mesh()) data::read_case(setup.vessel + ".json", setup.case_text);
  });
}

}  // namespace

std::vector<Target> json_targets() {
  return {
      {"script", [] { return shipped("scripts"); },
       [](const Seed& in) { return answer_of<LoadError>([&] { data::read_script(in.name, in.bytes); }); }},
      {"case", [] { return shipped("cases"); },
       [](const Seed& in) { return answer_of<LoadError>([&] { data::read_case(in.name, in.bytes); }); }},
      {"instrument", [] { return shipped("instruments"); },
       [](const Seed& in) { return answer_of<LoadError>([&] { data::read_instrument(in.name, in.bytes); }); }},
      {"scoring", [] { return shipped("scoring"); },
       [](const Seed& in) { return answer_of<LoadError>([&] { data::read_score_list(in.name, in.bytes); }); }},
      {"measurement", measurements,
       [](const Seed& in) { return answer_of<LoadError>([&] { data::read_measurement(in.name, in.bytes); }); }},
      {"tree", trees, [](const Seed& in) { return answer_of<LoadError>([&] { data::read_tree(in.name, in.bytes); }); }},
      {"anatomy", anatomies,
       [](const Seed& in) { return answer_of<LoadError>([&] { data::read_anatomy(in.name, in.bytes); }); }},
      {"markups", markups,
       [](const Seed& in) { return answer_of<LoadError>([&] { data::read_markups(in.name, in.bytes); }); }},
      {"setup", setups, read_setup}};
}

}  // namespace ostium::fuzz
