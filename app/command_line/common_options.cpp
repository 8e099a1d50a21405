#include "app/command_line/common_options.h"

#include <filesystem>

#include "data/formats/load_error.h"
#include "data/formats/read_file.h"
#include "data/identification/measurement/measurement_reader.h"
#include "device/emulator/emulated_box.h"

namespace ostium::app {

void add_case_option(Options& options, std::string& name) {
  options.add("case", name, "See `ostium cases`").type("CASE").show_default();
}

void add_measured_set_option(Options& options, std::string& set) {
  options.add("set", set, "The set's folder, or its measurement.json").required().type("SET");
}

void require_not_of_set(const std::string& set, const std::string& option, const std::string& output) {
  namespace fs = std::filesystem;
  std::error_code none;
  if (output.empty() || !fs::exists(output, none)) return;
  const fs::path told = data::measurement_file(set), folder = told.has_parent_path() ? told.parent_path() : ".";
  const fs::path file = fs::absolute(output, none);
  const bool beside = fs::equivalent(file.parent_path(), folder, none);
  const auto names = [&](const std::string& name) {  // measurement.json names the tables and meshes that belong to it
    return data::read_file(told.string()).find("\"" + name + "\"") != std::string::npos;
  };
  if (!fs::equivalent(file, told, none) && !(beside && names(file.filename().string()))) return;
  throw data::LoadError(option + " " + output + " would take the place of a file of the measured set " + set +
                        "; expected another name");
}

void require_none_of_set(const std::string& set, const std::string& option, const std::string& folder,
                         std::initializer_list<const char*> names) {
  for (const char* name : names) require_not_of_set(set, option, (std::filesystem::path(folder) / name).string());
}

void add_json_flag(Options& options, bool& json, const std::string& schema) {
  options.flag("--json", json, "Machine-readable" + (schema.empty() ? "" : ", see data/schemas/" + schema));
}

void add_box_serial_option(Options& options, std::string& serial) {
  options.add("--serial", serial, "Of the box; else the first that is found");
}

void require_emulated_box(const std::string& serial) {
  if (!serial.empty() && serial != device::emulated_serial)
    throw data::LoadError("--serial " + serial + ": there is one emulated box, " + device::emulated_serial +
                          "; expected that, or a real box");
}

void add_unit_option(Options& options, std::string& unit, const std::string& help) {
  options.add("--units", unit, help + "; auto: as the file says, or the only one that makes an artery of it")
      .one_of({"auto", "mm", "cm", "m", "in"})
      .show_default();
}

}  // namespace ostium::app
