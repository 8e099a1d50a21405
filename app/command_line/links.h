#pragma once
#include <string>

namespace ostium::app {

/// Prints the links of a page that this program serves: "WHO: ..." for the one who may do everything, "viewers: ...".
/// `open`: others can reach it, which is warned of.
void tell_links(const std::string& who, const std::string& link, const std::string& viewers, bool open);

}  // namespace ostium::app
