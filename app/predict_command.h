#pragma once
/// `ostium predict`: the static shapes that a measured set declares.
#include <string>

namespace ostium {

struct PredictOptions {
  std::string set;           ///< folder or measurement.json
  std::string folder = ".";  ///< where prediction.json and prediction.csv go
  bool json = false;         ///< prediction.json to stdout instead of a table
};

/// Exit code 0. Throws LoadError if the set is wrong, std::runtime_error if a file cannot be written.
int predict_command(const PredictOptions& options);

}  // namespace ostium
