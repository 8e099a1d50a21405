#include "app/command_line/common_options.h"

namespace ostium::app {

void add_case_option(Options& options, std::string& name) {
  options.add("case", name, "See `ostium cases`").type("CASE").show_default();
}

void add_measured_set_option(Options& options, std::string& set) {
  options.add("set", set, "The set's folder, or its measurement.json").required().type("SET");
}

void add_json_flag(Options& options, bool& json, const std::string& schema) {
  options.flag("--json", json, "Machine-readable" + (schema.empty() ? "" : ", see data/schemas/" + schema));
}

void add_box_serial_option(Options& options, std::string& serial) {
  options.add("--serial", serial, "Of the box; else the first that is found");
}

void add_unit_option(Options& options, std::string& unit, const std::string& help) {
  options.add("--units", unit, help + "; auto: as the file says, or the only one that makes an artery of it")
      .one_of({"auto", "mm", "cm", "m", "in"})
      .show_default();
}

}  // namespace ostium::app
