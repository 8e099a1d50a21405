#include <fmt/format.h>

#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "data/catalogue/catalogue.h"
#include "data/catalogue/instrument/instrument_picture.h"
#include "data/catalogue/instrument/instrument_report.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::string name;  ///< one instrument, in detail; empty: list all
  bool json = false;
  std::string picture;  ///< SVG file to draw; empty: none
};

void declare(Options& options, Arguments& a) {
  options.add("name", a.name, "One of them, in detail and with its sources").type("NAME");
  add_json_flag(options, a.json, "instruments.schema.json");
  options.add("--picture", a.picture, "Draw them at rest").type("FILE.svg").writes();
}

int run(const Arguments& a) {
  std::vector<data::Instrument> chosen = data::load_catalogue();
  if (!a.name.empty()) chosen = {data::Instrument(find_instrument(chosen, a.name))};
  if (!a.picture.empty()) draw_instruments(chosen, a.picture);
  if (a.json) {
    fmt::print("{}\n", to_json(chosen));
  } else if (!a.name.empty()) {
    fmt::print("{}", instrument_details(chosen.front()));
  } else if (a.picture.empty()) {
    fmt::print("{}\n", data::instrument_heading());
    for (const data::Instrument& instrument : chosen) fmt::print("{}\n", instrument_line(instrument));
  }
  return 0;
}

}  // namespace

Command instruments_command() {
  return make_command("instruments", "What instruments there are, how stiff, and where from",
                      {"ostium instruments", "ostium instruments guide-jl4-6f", "ostium instruments --picture all.svg"},
                      declare, run);
}

}  // namespace ostium::app
