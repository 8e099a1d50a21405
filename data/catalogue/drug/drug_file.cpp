#include "data/catalogue/drug/drug_file.h"

#include <algorithm>
#include <filesystem>

#include "data/catalogue/catalogue.h"
#include "data/catalogue/drug/drug_keys.h"

namespace ostium::data {

namespace fs = std::filesystem;

vascular::Drug read_drug(const std::string& file, const std::string& text) {
  const JsonValue value = parse_json(file, text);
  const JsonObject root(value, drug_keys::drug);
  root.choice("schema", {"ostium-drug/1"});
  vascular::Drug drug;
  drug.name = root.text("name"), drug.title = root.text("title");
  if (drug.name != fs::path(file).stem().string()) root.refuse("name");
  drug.unit = root.choice("unit", {"ug", "mg"}) == 0 ? "ug" : "mg";
  const std::vector<double> dose = root.numbers("dose", 2);
  drug.least = dose[0], drug.most = dose[1];
  if (!(drug.least > 0 && drug.most >= drug.least)) root.refuse("dose");
  root.text("dose_source"), root.text("half_life_source");
  drug.half_life_s = root.positive("half_life_s");
  if (root.list("effects").empty()) root.refuse("effects");
  for (const JsonValue& one : root.list("effects")) {
    const JsonObject object(one, drug_keys::effect);
    vascular::DrugEffect effect;
    effect.target = static_cast<vascular::DrugTarget>(object.choice("on", drug_keys::target_names()));
    effect.most = object.positive("most"), effect.onset_s = object.positive("onset_s");
    object.text("source");
    if (object.has("half_dose") == (effect.target == vascular::DrugTarget::heparin))
      one.fail(one.path() + ".half_dose: expected for every effect but one on heparin");
    if (object.has("half_dose")) effect.half_dose = object.positive("half_dose");
    if (object.has("works_in")) effect.works_in = object.number("works_in");
    drug.effects.push_back(effect);
  }
  return drug;
}

std::vector<std::string> drug_files() {
  const fs::path folder = fs::path(data_folder()) / "drugs";
  std::vector<std::string> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  if (files.empty()) throw LoadError(folder.string() + ": has no drug; expected a folder with at least one NAME.json");
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace ostium::data
