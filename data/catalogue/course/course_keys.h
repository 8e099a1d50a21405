#pragma once
/// The keys of a course, object by object: what the reader accepts, and how each is described. The schema
/// (data/schemas/course.schema.json) is generated from them.
#include "data/catalogue/script/script_keys.h"
#include "data/formats/json/json_object.h"

namespace ostium::data::course_keys {

/// Arteries before which a guide can lie as a lesson begins.
inline const std::vector<std::string> beginnings = {"LM", "RCA"};

inline const JsonObjectKeys root = {
    "course",
    {{"schema", true, "\"ostium-course/1\"", json_type::constant("ostium-course/1")},
     {"name", true, "the file's name without .json", json_type::text()},
     {"title", true, "what people call it, a text", json_type::text()},
     {"note", true, "what it is worth, a text", json_type::text()},
     {"any_order", false, "true: every lesson is open from the beginning; else once the one before it has been passed",
      json_type::boolean()},
     {"lessons", true, "a list of at least one, in their order", json_type::list_of(json_type::object("lesson"), 1)}}};

inline const JsonObjectKeys lesson = {
    "lesson",
    {{"name", true, "a name of its own: at most 60 small letters, digits and -", json_type::text()},
     {"title", true, "what people call it, a text", json_type::text()},
     {"goal", true, "what has been done at its end, a text", json_type::text()},
     {"instructions", true, "what to do, in its order: a text, or a text that ticks itself (see instruction)",
      json_type::list_of(json_type::either({json_type::text(), json_type::object("instruction")}), 1)},
     {"case", true, "a case of data/cases, or a file", json_type::text()},
     {"person", false, "a whole number from 0 on: another person with this case", json_type::whole(from_zero)},
     {"begin", false, "LM or RCA: the guide lies before it, ready", json_type::choice(beginnings)},
     {"set", false, "what `ostium run --set` takes, a list: \"guide=guide-al1-6f\"",
      json_type::list_of(json_type::text(), 1)},
     {"script", true, "a script whose instruments lie ready, and whose expert shows how", json_type::text()},
     {"scoring", true, "a scoring list of data/scoring, or a file", json_type::text()},
     {"must_hold", true, "ids of the list's items that must be done to go on; none: it has only to come to its end",
      json_type::list_of(json_type::text())},
     {"limit_min", false, "it ends by itself after so many minutes of simulated time, > 0 and at most 600",
      json_type::number(above_zero_to(600))},
     {"exam", false, "true: no hints, no expert, no going back, and nothing is told of errors and scores",
      json_type::boolean()}}};

/// Ticked once: by `until` or `event`, or by what the expert's step at `label` waits for.
inline const JsonObjectKeys instruction = {
    "instruction",
    {{"text", true, "what to do, a text", json_type::text()},
     {"until", false, "a list of a script's conditions; it is ticked once one of them holds",
      json_type::list_of(json_type::object("condition"), 1)},
     {"while", false,
      "a list of a script's conditions, beside until; where one does not hold, nothing is ticked, and what is counted "
      "begins anew",
      json_type::list_of(json_type::object("condition"), 1)},
     {"event", false, "an event of a recording; it is ticked once that has come", json_type::text()},
     {"label", false,
      "a label of the script: hints begin at that step; without until and event it is ticked by what that step "
      "waits for",
      json_type::text()},
     {"in_turn", false, "true: not before the one before it; what is counted is counted from then",
      json_type::boolean()}}};

inline const std::vector<const JsonObjectKeys*> all = {&root, &lesson, &instruction, &script_keys::condition};

}  // namespace ostium::data::course_keys
