#pragma once
#include <string>

namespace ostium::app {

/// Puts the parts of a sweep beside `table` (part_file) together into it: the same bytes as one process writes. If a
/// run is missing it says which, and writes nothing. Exit code: 0, or 1 if something is missing. Throws LoadError if
/// there are no parts, or parts of several sweeps; WriteError.
int merge_parts(const std::string& table);

}  // namespace ostium::app
