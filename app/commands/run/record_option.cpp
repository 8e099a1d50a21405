#include "app/commands/run/record_option.h"

#include <fmt/format.h>

#include "app/command_line/arguments.h"
#include "data/formats/decimal.h"
#include "data/formats/load_error.h"

namespace ostium::app {

std::string record_help() {
  return "What run.h5 holds; events: no states, so replay starts at the beginning; shapes: also each tool's nodes, 30 "
         "times a second or HZ (full, or events,shapes=HZ)";
}

std::string record_words() { return "none|events|full|shapes[=HZ]"; }

RecorderOptions recorder_of(const std::string& record) {
  RecorderOptions recorder;
  if (record.empty()) recorder.mode = RecordMode::events;
  for (const std::string& word : record.empty() ? std::vector<std::string>() : split(record, ',')) {
    const std::string name = word.substr(0, word.find('='));
    const std::optional<double> rate_Hz = word == name ? 30.0 : data::decimal(word.substr(name.size() + 1));
    if (word == "none")
      recorder.mode = RecordMode::none;
    else if (word == "events")
      recorder.mode = RecordMode::events;
    else if (word == "full")
      recorder.mode = RecordMode::full;
    else if (name == "shapes" && rate_Hz && *rate_Hz > 0 && *rate_Hz <= 1000)
      recorder.shapes_Hz = *rate_Hz;
    else
      throw data::LoadError(
          fmt::format("--record is \"{}\"; expected {}, HZ above 0 and at most 1000", record, record_words()));
  }
  return recorder;
}

}  // namespace ostium::app
