#pragma once
/// Small sets to begin from, one for each kind of measurement: the folders of data/templates. Each can be explained as
/// it is.
#include <string>
#include <vector>

namespace ostium::app {

/// The kinds that have one, sorted.
std::vector<std::string> template_kinds();

/// Copies the files of a kind's template to `folder` and returns their paths. Throws LoadError for an unknown kind, and
/// WriteError; where one of the files is there already, nothing is written.
std::vector<std::string> write_template(const std::string& kind, const std::string& folder);
/// The same of any folder of files below data.
std::vector<std::string> write_template_of(const std::string& below_data, const std::string& folder);

}  // namespace ostium::app
