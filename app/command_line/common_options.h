#pragma once
/// Options shared by several commands, each declared once.
#include "app/command_line/options.h"

namespace ostium::app {

void add_case_option(Options& options, std::string& name);
void add_measured_set_option(Options& options, std::string& set);
/// Throws LoadError if `output`, the value of an option, is a file of the measured set.
void require_not_of_set(const std::string& set, const std::string& option, const std::string& output);
/// The same of what a command writes into a folder, by names of its own.
void require_none_of_set(const std::string& set, const std::string& option, const std::string& folder,
                         std::initializer_list<const char*> names);
/// `schema`: a file of data/schemas, or empty if there is none.
void add_json_flag(Options& options, bool& json, const std::string& schema = "");
void add_box_serial_option(Options& options, std::string& serial);
/// Throws LoadError where another box is asked for; empty: none is.
void require_emulated_box(const std::string& serial);

/// mm, cm, m or in, or auto (unit_of).
void add_unit_option(Options& options, std::string& unit, const std::string& help);

}  // namespace ostium::app
