#pragma once
#include <string>

#include "fluoro/display/display.h"

namespace ostium::app {

/// A grey JPEG; `quality`: 1 to 100. Empty for an empty picture.
std::string jpeg_of(const fluoro::Picture& picture, int quality = 88);

}  // namespace ostium::app
