#pragma once
/// Measured sets with an effect that their file does not declare, made by the boundary-value solver, in a tube by the
/// pushed chain, or of two tubes with play by nested chains; `ostium explain` is tested with them. A set is determined
/// by its kind and seed.
#include <functional>
#include <map>

#include "tests/support/sets/synthetic_set.h"

namespace ostium::synthetic {

struct Undeclared {
  data::MeasurementSet set;
  std::vector<std::string> effects;  ///< ids that would be right; empty: a clean set, or an effect outside the library
  bool in_library = true;            ///< false: the right verdict is "unexplained"
  std::string frame;                 ///< for an effect outside the library: the signature's expected frame
  std::map<std::string, double> truth;  ///< parameters by their library names, "roll_loss.fraction"
  std::vector<std::string> faults;      ///< ids of data faults of which one must be named; empty: there is none
  std::vector<std::string> culprits;    ///< whose fault it is: ids of experiments
  std::function<double(double)> law;    ///< of x as in explanation.json: the true law; empty if there is none
  std::string noise;                    ///< how the noise is not as declared, "noise:shared"; empty: it is
};

/// Kinds with this prefix are pushed into a tube, and drawn back.
inline constexpr const char* in_tube = "tube:";

/// "clean", ids of the library, two of them joined by "+", and effects outside the library ("out:..."); laws of another
/// form ("form:..."), other noise ("noise:...") and faults of the data ("fault:..."), undeclared_world.h; "tube:clean",
/// "tube:wall_friction", "tube:wall_compliance". What the list joins are examples: any may be joined.
/// Kinds with this prefix are seen by two views of a C-arm, in pixels.
inline constexpr const char* in_views = "views:";

/// "clean", ids of the library, two of them joined by "+", and effects outside the library ("out:...");
/// "tube:clean", "tube:wall_friction", "tube:wall_compliance"; "views:clean", effects of the views, some of the wire.
const std::vector<std::string>& undeclared_kinds();

/// Throws std::runtime_error if the solver finds no shape of this seed's instrument.
Undeclared undeclared_set(const std::string& kind, unsigned seed);

}  // namespace ostium::synthetic
