#pragma once
#include "app/serve/http/server.h"

namespace ostium::app {

/// The trainer's page and its parts, built into the program.
std::vector<Page> page_files();
/// The workbench's.
std::vector<Page> workbench_files();

}  // namespace ostium::app
