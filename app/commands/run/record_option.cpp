#include "app/commands/run/record_option.h"

#include <fmt/format.h>

#include "data/formats/load_error.h"

namespace ostium::app {

std::string record_help() { return "What run.h5 holds; events: no states, so replay starts at the beginning"; }

std::string record_words() { return "none|events|full"; }

RecorderOptions recorder_of(const std::string& record) {
  RecorderOptions recorder;
  if (record == "none")
    recorder.mode = RecordMode::none;
  else if (record == "events" || record.empty())
    recorder.mode = RecordMode::events;
  else if (record == "full")
    recorder.mode = RecordMode::full;
  else
    throw data::LoadError(fmt::format("--record is \"{}\"; expected {}", record, record_words()));
  return recorder;
}

}  // namespace ostium::app
