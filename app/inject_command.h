#pragma once
#include <cstdint>
#include <string>

namespace ostium {

struct InjectOptions {
  std::string of = "rca-mid-focal";  ///< case
  std::string at = "right";          ///< left, right: the ostium; left-sinus, right-sinus, aorta
  double rate_mL_s = 0;              ///< 0: as measured by hand, 2.1 left and 1.7 right
  double volume_mL = 0;              ///< 0: 7.1 left, 4.8 right
  double iodine_mg_mL = 350;
  double phase = 0.9;  ///< of the heart, as the contrast reaches the tip
  double seconds = 5;
  double frames_per_s = 15;
  std::string view;  ///< "": lao for the right, rao-cranial for the left
  int pixels = 512;
  bool healthy = false;  ///< without lesions
  bool count = false, json = false;
  std::uint64_t seed = 1;
  std::string out = "inject.png";  ///< .png: moments side by side; .mp4
};

int inject_command(const InjectOptions& options);

}  // namespace ostium
