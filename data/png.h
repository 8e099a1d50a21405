#pragma once
#include <string>

#include "fluoro/display.h"

namespace ostium {

/// 8-bit greyscale PNG. Throws LoadError naming the file if it cannot be written; what was begun is removed.
void write_png(const std::string& file, const Picture& picture);

}  // namespace ostium
