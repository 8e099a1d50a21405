/// The picture of nesting in `core`'s README, after figure 5.4 of the thesis, with instruments of the catalogue: a
/// stiff wire straightens a soft catheter, a soft wire follows a stiff one.
#include <exception>
#include <iostream>

#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"
#include "data/catalogue/catalogue.h"
#include "data/formats/svg.h"

namespace {

using namespace ostium;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double element_m = 1.5e-3, catheter_m = 0.22;

core::Rod rod_of(const data::Instrument& instrument, double inserted_m) {
  core::RodDescription d =
      rod_description(instrument, std::vector<double>(static_cast<int>(inserted_m / element_m), element_m));
  d.damping = {1, 0.5, 1e-3};  // to come to rest soon
  return core::make_rod(d);
}

std::vector<Vector2d> drawn(const core::RodState& rod, const Vector2d& origin) {
  std::vector<Vector2d> points;
  for (int i = 0; i < rod.position.size(); ++i)
    points.emplace_back(origin.x() + 400 * rod.position[i].x(), origin.y() - 400 * rod.position[i].z());
  return points;
}

/// Catheter alone, wire alone, and one in the other at rest, side by side.
void panel(data::Drawing& drawing, const Vector2d& corner, const std::string& words, const data::Instrument& catheter,
           const data::Instrument& wire, double protrudes_m) {
  require_fit(wire, catheter);
  core::Model model;
  model.gravity_W.setZero();
  model.rods = {rod_of(catheter, catheter_m), rod_of(wire, catheter_m + protrudes_m)};
  const std::vector<core::EndState> bases(2, core::along_x());
  const auto show = [&](const core::State& state, bool with_catheter, bool with_wire, double y) {
    const Vector2d origin = corner + Vector2d(4, y);
    if (with_catheter) drawing.line(drawn(state.rods[0], origin), "#9bc", 1.6);
    if (with_wire) drawing.line(drawn(state.rods[1], origin), "#246", 0.5);
  };
  drawing.text(corner + Vector2d(0, 0), words);
  const core::State alone = make_state_at_rest_shape(model, bases);
  show(alone, true, false, 22);
  drawing.text(corner + Vector2d(108, 12), catheter.name, 3);
  show(alone, false, true, 58);
  drawing.text(corner + Vector2d(108, 55), wire.name, 3);

  model.nestings = core::coaxial({0, 1});
  core::State state = make_state(model, bases);
  core::Scratch scratch(model);
  core::StepReport report;
  core::Inputs inputs;
  inputs.rods.resize(2);
  for (int n = 0; n < 6000; ++n) step(model, inputs, state, scratch, report);
  show(state, true, true, 72);
  drawing.text(corner + Vector2d(108, 69), "together", 3);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: " << argv[0] << " FILE.svg\n";
    return 2;
  }
  try {
    const std::vector<data::Instrument> catalogue = data::load_catalogue();
    const auto instrument = [&](const char* name) { return data::find_instrument(catalogue, name); };
    data::Drawing drawing(300, 112);
    panel(drawing, {6, 8}, "A stiff wire straightens a soft catheter", instrument("diagnostic-jr4-5f"),
          instrument("amplatz-super-stiff"), 0.13);
    panel(drawing, {158, 8}, "A soft wire follows a stiff catheter", instrument("diagnostic-jl4-5f"),
          instrument("wire-014-workhorse"), 0.02);
    drawing.write(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
  return 0;
}
