#pragma once
/// The keys of a scoring list, object by object: what the reader accepts, and how each is described. The schema
/// (data/schemas/scoring.schema.json) is generated from them.
#include "data/formats/json/json_object.h"

namespace ostium::data::scoring_keys {

inline const JsonObjectKeys root = {
    "scoring list",
    {{"schema", true, "\"ostium-scoring/1\"", json_type::constant("ostium-scoring/1")},
     {"name", true, "the file's name without .json", json_type::text()},
     {"title", true, "what people call it, a text", json_type::text()},
     {"note", true, "what it is worth, a text", json_type::text()},
     {"items", true, "steps and errors, a list of at least one", json_type::list_of(json_type::object("item"), 1)}}};

inline const JsonObjectKeys item = {
    "item",
    {{"id", true, "a number of its own, a text", json_type::text()},
     {"phase", true, "a part of the procedure, a text", json_type::text()},
     {"kind", true, "\"step\", \"error\" or \"critical\"", json_type::choice({"step", "error", "critical"})},
     {"what", true, "a text", json_type::text()},
     {"when", true, "how it is told, a text", json_type::text()},
     {"check", false, "what the recording must show; without it a person ticks", json_type::object("check")}}};

inline const JsonObjectKeys check = {
    "check",
    {{"event", false, "an event's name (data/events.cpp)", json_type::text()},
     {"before", false, "an event's name: the first must come before its first", json_type::text()},
     {"metric", false, "a metric's name", json_type::text()},
     {"least", false, "a number: of events, or the metric's value", json_type::number()},
     {"most", false, "a number: of events, or the metric's value", json_type::number()}}};

inline const std::vector<const JsonObjectKeys*> all = {&root, &item, &check};

}  // namespace ostium::data::scoring_keys
