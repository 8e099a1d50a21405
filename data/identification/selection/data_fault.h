#pragma once
/// A fault of the data: not of the instrument, the rig or the picture, but of what was written down or handled once.
#include <string>
#include <vector>

namespace ostium::data {

struct DataFault {
  std::string id;                        ///< outlier_experiment, unit_error, swapped_experiments, ...
  std::vector<std::string> experiments;  ///< ids
  std::string what;                      ///< in words: what is wrong
  std::string mend;                      ///< in words: what mends it
  std::string told_by;                   ///< in words: how it was told from a physical effect
};

}  // namespace ostium::data
