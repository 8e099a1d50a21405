#pragma once
#include "app/serve/http/server.h"

namespace ostium::app {

/// The page and its parts, built into the program.
std::vector<Page> page_files();

}  // namespace ostium::app
