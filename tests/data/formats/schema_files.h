#pragma once
/// The formats whose schemas are generated from their readers' tables of keys.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "data/assessment/scoring_keys.h"
#include "data/catalogue/case/anatomy_keys.h"
#include "data/catalogue/case/case_keys.h"
#include "data/catalogue/case/tree_keys.h"
#include "data/catalogue/course/course_keys.h"
#include "data/catalogue/drug/drug_keys.h"
#include "data/catalogue/instrument/instrument_keys.h"
#include "data/catalogue/script/script_keys.h"
#include "data/console/console_order.h"
#include "data/formats/json/json_schema.h"
#include "data/identification/curves/kinds.h"
#include "data/identification/measurement/measurement_keys.h"
#include "data/identification/measurement/projection_keys.h"

namespace ostium::data {

inline std::vector<JsonFormat> json_formats() {
  std::vector<JsonFormat> formats = {
      {"ostium-script/1", "What an operator does", script_keys::all},
      {"ostium-case/1", "A case to rehearse on", case_keys::all},
      {"ostium-drug/1", "A drug of the catalogue, with a source for every number", drug_keys::all},
      {"ostium-instrument/1",
       "An instrument of the catalogue. The reader also refuses gaps, and numbers that do not go together.",
       instrument_keys::all},
      {"ostium-measurement/1",
       "A measured set: one instrument or nested ones, measured several times. The reader also refuses gaps, "
       "instruments pushed in further than they are long, and bases without a direction.",
       measurement_keys::all},
      {"ostium-measurement/2",
       "A measured set of kind projections: a wire seen by the views of a C-arm, as pixels along it. The reader also "
       "refuses views whose numbers do not go together, and polylines outside the picture or in other units.",
       projection_keys::all, "projections"},
      {"ostium-anatomy/1",
       "Tubes, names and landmarks of an imported lumen; patient frame (x left, y head, z front), mm",
       anatomy_keys::all},
      {"ostium-tree/1", "A centreline-sphere tree; patient frame (x left, y head, z front), mm", tree_keys::all},
      {"ostium-scoring/1", "Steps, errors and critical errors of a procedure (data/scoring)", scoring_keys::all},
      {"ostium-course/1", "Lessons in their order, and what must hold to go on (data/courses)", course_keys::all},
      {"ostium-console/1", "What is asked of an operator's console, by a browser", console_keys_of_messages::all}};
  for (const curves::Kind& kind : curves::kinds())
    formats.push_back({"ostium-measurement/2", "A measured set: " + kind.what, kind.keys, kind.name});
  return formats;
}

/// "script.schema.json" of "ostium-script/1", "measurement-density.schema.json" of a form.
inline std::string schema_file(const JsonFormat& format) {
  const std::size_t from = format.id.find('-') + 1;
  const std::string form = format.form.empty() ? "" : "-" + format.form;
  return format.id.substr(from, format.id.find('/') - from) + form + ".schema.json";
}

inline std::string schema_text(const JsonFormat& format) {
  return nlohmann::ordered_json::parse(to_json(schema_of(format))).dump(2) + "\n";
}

}  // namespace ostium::data
