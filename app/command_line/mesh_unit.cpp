#include "app/command_line/mesh_unit.h"

#include <fmt/format.h>

#include "vascular/geometry/repair/double_wall.h"

namespace ostium::app {

namespace {
constexpr double largest_m = 10;
}

vascular::UnitGuess guess_lumen_unit(const vascular::Mesh& raw) {
  const vascular::UnitGuess guess = guess_unit(raw);
  return guess.vessel ? guess : guess_unit(without_outer_wall(raw));
}

void take_unit(vascular::LengthUnit unit, vascular::UnitGuess& guess) {
  const double ratio = metres(unit) / metres(guess.unit);
  guess.unit = unit, guess.extent_m *= ratio, guess.calibre_m *= ratio;
}

void require_size(const std::string& file, const vascular::UnitGuess& guess) {
  if (guess.extent_m > largest_m)
    throw vascular::MeshError(
        fmt::format("{}: is {:.3g} m long if its numbers are {}; expected vessels, {:g} m long at most: say its unit "
                    "with --units, or is the file damaged?",
                    file, guess.extent_m, name_of(guess.unit), largest_m));
}

}  // namespace ostium::app
