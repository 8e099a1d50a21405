#include "fluoro/projection/views.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/command_line/command.h"
#include "app/command_line/common_options.h"

namespace ostium::app {

namespace {

struct Arguments {
  bool json = false;
};

void declare(Options& options, Arguments& a) { add_json_flag(options, a.json, "views.schema.json"); }

int run(const Arguments& a) {
  if (a.json) {
    auto array = nlohmann::ordered_json::array();
    for (const fluoro::StandardView& v : fluoro::standard_views())
      array.push_back({{"view", v.name}, {"lao_deg", v.lao_deg}, {"cran_deg", v.cran_deg}, {"shows", v.shows}});
    fmt::print("{}\n", array.dump(2));
    return 0;
  }
  fmt::print("{:<18} {:<16} {}\n", "view", "angles", "shows");
  for (const fluoro::StandardView& v : fluoro::standard_views())
    fmt::print("{:<18} {:<16} {}\n", v.name, fluoro::angles_text(v.lao_deg, v.cran_deg), v.shows);
  return 0;
}

}  // namespace

Command views_command() {
  return make_command("views", "The standard views of coronary angiography", {"ostium views", "ostium views --json"},
                      declare, run);
}

}  // namespace ostium::app
