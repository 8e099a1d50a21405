#pragma once
#include "app/film_options.h"

namespace ostium {

struct ReplayOptions {
  std::string file;
  bool verify = false;
  double from_s = 0, seconds = 0;  ///< seconds 0: to the end
  std::string video, dicom, png;   ///< empty: none
  PictureOptions picture;
  bool json = false;
};

/// `ostium replay`. 0 if what was asked for is done and, with `verify`, the same.
int replay_command(const ReplayOptions& options);

}  // namespace ostium
