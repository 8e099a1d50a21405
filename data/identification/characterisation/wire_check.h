#pragma once
/// Does an instrument, as it was characterised, predict a set that was no part of that? Nothing is fitted.
#include <cmath>
#include <functional>

#include "data/identification/characterisation/set_with_wire.h"

namespace ostium::data {

/// How many times the noise a prediction may be off, root mean square; and by how many of its standard errors the set
/// may ask for another number.
inline constexpr double agrees_within = 1.2, agrees_within_errors = 4;

/// A number of the wire, and by how many of its standard errors the set would have it otherwise.
struct AskedMove {
  std::string what;  ///< "EI, 0 to 1000 mm from the tip"
  double errors = 0;
};

struct RunCheck {
  std::string id;
  double over_noise = 0;  ///< root mean square misfit over the noise
};

struct WireCheck {
  std::vector<RunCheck> runs;
  double over_noise = 0;  ///< of all
  /// The same with what the errors of stiffness and friction may do to the prediction taken as further noise:
  /// sqrt(r' (I + D D')^-1 r / n), r the misfits, and D what they change by with each number's standard error.
  double beyond_errors = 0;
  std::vector<AskedMove> moves;  ///< -(I + D' D)^-1 D' r, the largest first

  bool agrees() const {
    return beyond_errors <= agrees_within && (moves.empty() || std::fabs(moves[0].errors) <= agrees_within_errors);
  }
};

/// `root`: the file of a set of shapes or curves that declares its noise, and whose frame is given. Throws LoadError
/// otherwise. `progress` may be empty.
WireCheck check(const JsonValue& root, const CharacterisedWire& wire,
                const std::function<void(const std::string&)>& progress = {});

/// The stretches, and the friction if it was measured, as a set takes them.
WireInSet in_set(const CharacterisedWire& wire);

}  // namespace ostium::data
