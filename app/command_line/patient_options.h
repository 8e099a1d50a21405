#pragma once
/// Whose vessels: options shared by the commands that take a case's patient outside a session.
#include <string>
#include <vector>

#include "app/command_line/options.h"
#include "data/catalogue/case/case.h"

namespace ostium::app {

/// --set KEY=VALUE, as sessions take it: person, heart_rate.
void add_patient_option(Options& options, std::vector<std::string>& set);

/// The case with what was set. Throws LoadError, for a key that is not known too.
data::Case case_with(const std::string& name, const std::vector<std::string>& set);

}  // namespace ostium::app
