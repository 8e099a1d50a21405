#pragma once
/// The wire of the rod gates: 1 m, radius 0.45 mm, E 60 GPa, nu 0.3, 6500 kg/m3, straight, along x from the origin.
#include "core/model/inputs.h"
#include "core/step/statics.h"
#include "core/step/step.h"

namespace ostium::core {

struct WireOptions {
  int elements = 100;
  double E_Pa = 60e9;
  double length_m = 1;
  bool gravity = true;  ///< along -z
};

/// A model with one wire, its state and its working memory.
struct Bench {
  explicit Bench(Model m, const EndState& base);

  void step();
  RodEquilibrium settle();
  bool is_unstable();  ///< whether the present shape, taken as an equilibrium, is unstable
  RodState& rod() { return state.rods[0]; }
  Eigen::Vector3d tip() const { return state.rods[0].position[model.rods[0].elements]; }

  Model model;
  State state;
  Scratch scratch;
  Inputs inputs;  ///< base clamped, tip free, no load
  StepReport report;
};

RodDescription steel_wire(const WireOptions& options);
Bench steel_bench(const WireOptions& options);
/// A bench with one rod of any description, along x.
Bench bench_of(const RodDescription& rod, bool gravity = true);

/// A frame with d3 along x, d1 along -z, d2 along y.
EndState along_x();
/// The frame rotated by a vector in world axes.
Eigen::Vector4d turned_frame(const Eigen::Vector4d& q_W, const Eigen::Vector3d& rotation_W_rad);

/// Lays a rod along a curve: element j gets frame j; nodes follow from the base. Sets both ends' poses, the tip's frame
/// to `tip_q_W`, and clears motion and forces.
void lay_out(const Rod& rod, const std::vector<Eigen::Vector4d>& q_W, const Eigen::Vector4d& tip_q_W, RodState& state);

/// Lays a rod into a closed plane circle through its base; the tip frame is turned by `twist_rad` about the tangent
/// relative to the base frame, with the twist spread evenly.
void lay_out_ring(const Rod& rod, double twist_rad, RodState& state);

/// The smallest x in [stable, unstable] with `is_unstable(x)`, to the given relative accuracy, by bisection.
template <class F>
double critical(double stable, double unstable, double fraction, F&& is_unstable) {
  while (unstable - stable > fraction * unstable) {
    const double middle = 0.5 * (stable + unstable);
    (is_unstable(middle) ? unstable : stable) = middle;
  }
  return 0.5 * (stable + unstable);
}

}  // namespace ostium::core
