#pragma once
/// `ostium explain`: what of a measured set the model explains, and what is left.
#include <string>
#include <vector>

namespace ostium {

struct ExplainCommandOptions {
  std::string set;                 ///< folder or measurement.json
  std::string folder = ".";        ///< where explanation.json, explanation.html and amended/ go
  std::vector<std::string> tries;  ///< "shaft_torsion", or several together: "shaft_torsion+stress_relaxation"
  std::string instrument;          ///< file for the innermost instrument as it was found; empty: only in `folder`
  int threads = 0;                 ///< 0: one for each core
  bool json = false;               ///< explanation.json to stdout instead of words
};

/// Exit code 0. Throws LoadError if the set is wrong, std::runtime_error if a file cannot be written. Under mpirun the
/// first rank alone writes.
int explain_command(const ExplainCommandOptions& options);

}  // namespace ostium
