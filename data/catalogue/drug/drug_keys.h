#pragma once
/// The keys of a drug's file: what the reader accepts, and how each is described. The schema
/// (data/schemas/drug.schema.json) is generated from them.
#include <iterator>

#include "data/formats/json/json_object.h"
#include "vascular/treatment/drugs.h"

namespace ostium::data::drug_keys {

inline std::vector<std::string> target_names() {
  return {std::begin(vascular::drug_target_names), std::end(vascular::drug_target_names)};
}

inline const std::string source_text = "where the numbers are from: a citation, or \"estimate: \" and the reasoning";

inline const JsonObjectKeys drug = {
    "drug",
    {{"schema", true, "\"ostium-drug/1\"", json_type::constant("ostium-drug/1")},
     {"name", true, "the file's name without .json", json_type::text()},
     {"title", true, "the name that people use, a text", json_type::text()},
     {"unit", true, "of its doses", json_type::choice({"ug", "mg"})},
     {"dose", true, "the least and the most that are given at once, in that unit, two numbers > 0",
      json_type::numbers(2, above_zero)},
     {"dose_source", true, source_text, json_type::text()},
     {"half_life_s", true, "in which half of it no longer acts, in s, > 0", json_type::number(above_zero)},
     {"half_life_source", true, source_text, json_type::text()},
     {"effects", true, "what it does, a list of at least one", json_type::list_of(json_type::object("effect"), 1)}}};

inline const JsonObjectKeys effect = {
    "effect",
    {{"on", true, "what it acts on (drugs.h)", json_type::choice(target_names())},
     {"most", true, "the largest effect, a share; on heparin, the units that one unit of the drug takes away; > 0",
      json_type::number(above_zero)},
     {"half_dose", false, "dose of half the largest effect, > 0; not on heparin", json_type::number(above_zero)},
     {"works_in", false, "share of people in whom it works, > 0 and at most 1, which it is if it is not said",
      json_type::number(above_zero_to(1))},
     {"onset_s", true, "time constant of its onset in s, > 0", json_type::number(above_zero)},
     {"source", true, source_text, json_type::text()}}};

inline const std::vector<const JsonObjectKeys*> all = {&drug, &effect};

}  // namespace ostium::data::drug_keys
