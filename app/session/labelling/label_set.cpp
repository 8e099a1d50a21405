#include "app/session/labelling/label_set.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "app/session/labelling/coco.h"
#include "app/session/labelling/splits.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace {

using Json = nlohmann::ordered_json;

Json manifest(const LabelSetHead& head, const Json& runs) {
  Json classes = Json::array();
  for (const char* name : label_class_names) classes.push_back(name);
  return {{"software", "ostium " OSTIUM_VERSION},
          {"every_s", head.every_s},
          {"pixels", head.pixels},
          {"units",
           "px from the upper left corner, centres of pixels at one half; mm in the patient's frame: x left, y "
           "head, z front"},
          {"mask_values", classes},
          {"depth_unit_mm", 1e3 * depth_unit_m},
          {"keys", head.keys},
          {"runs", runs}};
}

}  // namespace

std::size_t write_label_set(const std::string& folder, const LabelSetHead& head, const std::vector<Json>& runs) {
  const auto file = [&](const std::string& name) { return (std::filesystem::path(folder) / name).string(); };
  std::vector<std::string> persons;
  std::set<std::string> names;
  for (const Json& run : runs) {
    persons.push_back(run.at("person"));
    for (const Json& picture : run.at("pictures"))
      for (const Json& one : picture.at("annotations")) names.insert(one.at("category_id"));
  }
  const Json categories = categories_of({names.begin(), names.end()});
  const std::vector<Split> split_of = splits_of(persons);
  std::size_t pictures = 0;
  for (const Split split : {Split::train, Split::val, Split::test}) {
    std::vector<Json> own;
    for (std::size_t run = 0; run < runs.size(); ++run)
      if (split_of[run] == split) own.push_back(runs[run]);
    const Json coco = coco_of(own, categories);
    pictures += coco.at("images").size();
    data::write_file(file(fmt::format("{}.json", split_name(split))), coco.dump() + "\n");
  }
  Json listed = Json::array();
  for (std::size_t run = 0; run < runs.size(); ++run) {
    Json one = runs[run];
    one["pictures"] = one.at("pictures").size();
    one["split"] = split_name(split_of[run]);
    one.erase("dataset");
    listed.push_back(one);
  }
  data::write_file(file("manifest.json"), manifest(head, listed).dump(2) + "\n");
  return pictures;
}

}  // namespace ostium::app
