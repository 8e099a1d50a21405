#pragma once
/// `ostium instruments`: what there is in the catalogue, in words and as a picture.
#include <string>

namespace ostium {

struct InstrumentsOptions {
  std::string name;     ///< one of them, in detail; empty: all
  bool json = false;    ///< data/schemas/instruments.schema.json
  std::string picture;  ///< SVG file to draw too; empty: none
};

/// Exit code 0. Throws LoadError if the catalogue is wrong or has no such name, std::runtime_error if the picture
/// cannot be written.
int instruments_command(const InstrumentsOptions& options);

}  // namespace ostium
