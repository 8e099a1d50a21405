#pragma once
/// `ostium verify`: runs the physics gates and prints value, reference, tolerance, pass.
#include <string>

namespace ostium {

struct VerifyOptions {
  std::string only;    ///< a gate's name, or the beginning of several
  bool quick = false;  ///< fewer elements and cases, the same tolerances
  bool json = false;
  bool list = false;  ///< names and what they compare, instead of running
};

/// Exit code: 0 all pass, 1 one did not, 2 `only` names no gate. Results go to stdout, progress to stderr.
int verify_command(const VerifyOptions& options);

}  // namespace ostium
