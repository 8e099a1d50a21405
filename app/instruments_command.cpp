#include "app/instruments_command.h"

#include <fmt/format.h>

#include "data/catalogue/catalogue.h"
#include "data/catalogue/instrument/instrument_picture.h"
#include "data/catalogue/instrument/instrument_report.h"

namespace ostium {

int instruments_command(const InstrumentsOptions& options) {
  std::vector<Instrument> chosen = load_catalogue();
  if (!options.name.empty()) chosen = {Instrument(find_instrument(chosen, options.name))};
  if (!options.picture.empty()) draw_instruments(chosen, options.picture);
  if (options.json) {
    fmt::print("{}\n", to_json(chosen));
  } else if (!options.name.empty()) {
    fmt::print("{}", instrument_details(chosen.front()));
  } else if (options.picture.empty()) {
    fmt::print("{}\n", instrument_heading());
    for (const Instrument& instrument : chosen) fmt::print("{}\n", instrument_line(instrument));
  }
  return 0;
}

}  // namespace ostium
