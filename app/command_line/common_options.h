#pragma once
/// Options that several commands have, each declared once.
#include "app/command_line/options.h"

namespace ostium::app {

void add_case_option(Options& options, std::string& name);
void add_measured_set_option(Options& options, std::string& set);
/// `schema`: of data/schemas, or empty where there is none.
void add_json_flag(Options& options, bool& json, const std::string& schema = "");
void add_box_serial_option(Options& options, std::string& serial);

/// mm, cm or m.
void add_unit_option(Options& options, std::string& unit, const std::string& help);
/// The same and inches, or auto: then the unit is guessed.
void add_guessed_unit_option(Options& options, std::string& unit, const std::string& help);

}  // namespace ostium::app
