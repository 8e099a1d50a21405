#pragma once
#include <cstdint>
#include <string>

namespace ostium {

struct TreatOptions {
  std::string of = "rca-mid-focal";   ///< case
  double hold_s = 20;                 ///< of each inflation
  double pressure = 1, oversize = 1;  ///< of what is usual
  double shift_mm = 0;                ///< beside the lesion, distally
  bool no_stent = false, no_predilatation = false, no_postdilatation = false, no_pictures = false, json = false;
  std::string view;
  int pixels = 512;
  std::uint64_t seed = 0;
  std::string out = "treat.png";
};

int treat_command(const TreatOptions& options);

}  // namespace ostium
