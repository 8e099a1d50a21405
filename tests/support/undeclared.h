#pragma once
/// Measured sets that show an effect of which their file says nothing, made by the boundary-value solver, in a tube by
/// the pushed chain, or of two tubes with play by nested ones: what `ostium explain` is judged by. Everything about a
/// set follows from its kind and seed.
#include <map>

#include "tests/support/synthetic_set.h"

namespace ostium::synthetic {

struct Undeclared {
  data::MeasurementSet set;
  std::vector<std::string> effects;     ///< ids that would be right; empty: a clean set, or nothing of the library
  bool in_library = true;               ///< false: the right verdict is "unexplained"
  std::string frame;                    ///< of an effect outside the library: what its signature should say
  std::map<std::string, double> truth;  ///< parameters as the library names them, "roll_loss.fraction"
};

/// Kinds that begin so are pushed into a tube, and drawn back.
inline constexpr const char* in_tube = "tube:";

/// "clean", ids of the library, two of them joined by "+", and effects outside the library ("out:...");
/// "tube:clean", "tube:wall_friction", "tube:wall_compliance".
const std::vector<std::string>& undeclared_kinds();

/// Throws std::runtime_error if the solver finds no shape of this seed's instrument.
Undeclared undeclared_set(const std::string& kind, unsigned seed);

}  // namespace ostium::synthetic
