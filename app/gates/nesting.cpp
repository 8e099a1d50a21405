/// Nested rods: an inner one within the clearance of an outer one.
#include "app/gates/nesting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "app/gates/gate.h"
#include "core/base/units.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"

namespace ostium::app::gates {

namespace {

using Eigen::Vector3d;
using units::pi;

struct Shape {
  double length_m, EI_N_m2, curvature_per_m, radius_m, bore_m, kg_per_m;
};

/// A uniform rod, torsion for nu = 0.3, damped enough to come to rest.
core::RodDescription uniform(const Shape& shape, int elements, double drag) {
  core::RodDescription rod;
  rod.name = "uniform rod";
  core::Section s;
  s.to_tip_m = shape.length_m;
  s.EI1_N_m2 = s.EI2_N_m2 = shape.EI_N_m2;
  s.GJ_N_m2 = shape.EI_N_m2 / 1.3;
  s.kg_per_m = shape.kg_per_m;
  s.radius_m = shape.radius_m, s.inner_radius_m = shape.bore_m;
  s.rest_curvature_per_m = {0, shape.curvature_per_m, 0};
  rod.sections = {s};
  rod.element_lengths_m = equal_elements(rod.sections, elements);
  rod.damping = {drag, drag / 2, 1e-3};
  return rod;
}

/// Two rods at one introducer, the second nested in the first if `bound`; no weight.
struct Pair {
  Pair(const core::RodDescription& outer, const core::RodDescription& inner, bool bound,
       const std::vector<double>& inserted_m = {})
      : model(make(outer, inner, bound)),
        state(make_state_at_rest_shape(model, {core::along_x(), core::along_x()}, inserted_m)),
        scratch(model) {
    inputs.rods.resize(2);
  }
  static core::Model make(const core::RodDescription& outer, const core::RodDescription& inner, bool bound) {
    core::Model m;
    m.rods = {make_rod(outer), make_rod(inner)};
    if (bound) m.nestings = {{.outer = 0, .inner = 1}};
    m.gravity_W.setZero();
    return m;
  }
  void straighten() { state = make_state(model, {core::along_x(), core::along_x()}); }
  void step(int steps = 1) {
    for (int i = 0; i < steps; ++i) core::step(model, inputs, state, scratch, report);
  }
  Eigen::Quaterniond frame(int rod, int element) const {
    const Eigen::Vector4d q = state.rods[rod].orientation[element];
    return {q[0], q[1], q[2], q[3]};
  }
  /// Mean curvature over the elements first to last, 1/m.
  double curvature(int rod, int first, int last) const {
    const double angle = frame(rod, first).angularDistance(frame(rod, last));
    return angle / (model.rods[rod].node_from_tip_m[first] - model.rods[rod].node_from_tip_m[last]);
  }

  core::Model model;
  core::State state;
  core::Scratch scratch;
  core::Inputs inputs;
  core::StepReport report;
};

/// Nearest distance from p to the outer rod's centreline, a finely sampled cubic through its nodes.
double distance_to_centreline(const core::Rod& rod, const core::RodState& s, const Vector3d& p, bool& beyond) {
  const int first = s.first, N = rod.elements;
  const auto tangent = [&](int i) -> Vector3d {
    const int a = std::max(i - 1, first), b = std::min(i + 1, N);
    return (s.position[b] - s.position[a]) / (b - a);
  };
  double best = 1e9;
  for (int j = first; j < N; ++j) {
    const Vector3d a = s.position[j], b = s.position[j + 1], ta = tangent(j), tb = tangent(j + 1);
    if ((p - a).norm() > 3 * (b - a).norm()) continue;
    for (int k = 0; k <= 40; ++k) {
      const double x = k / 40.0, x2 = x * x, x3 = x2 * x;
      const Vector3d c = (2 * x3 - 3 * x2 + 1) * a + (x3 - 2 * x2 + x) * ta + (3 * x2 - 2 * x3) * b + (x3 - x2) * tb;
      if ((p - c).norm() >= best) continue;
      best = (p - c).norm();
      beyond = j == N - 1 && k == 40;
    }
  }
  return best;
}

data::GateResult aligned_pair(const char* name, double EI_outer, double EI_inner, double k_outer, double k_inner,
                              double clearance_m, int elements, double tolerance_percent, bool bound) {
  constexpr double wire = 0.45e-3, length = 0.3;
  Pair pair(uniform({length, EI_outer, k_outer, wire + clearance_m + 0.4e-3, wire + clearance_m, 5e-3}, elements, 2),
            uniform({length, EI_inner, k_inner, wire, 0, 4e-3}, elements, 2), bound);
  pair.straighten();
  pair.step(5000);
  const double wanted = (EI_outer * k_outer + EI_inner * k_inner) / (EI_outer + EI_inner);
  double worst = 0;
  for (int rod : {0, 1})
    worst = std::max(worst, std::fabs(pair.curvature(rod, 2 * elements / 5, 3 * elements / 5) / wanted - 1));
  return {name, 100 * worst, 0, tolerance_percent, "%"};
}

/// The largest jump, in degrees, of the inner tip relative to the outer one when the base is rolled by half a degree.
double largest_jump_deg(double ratio, bool bound) {
  constexpr double k = 20, EI = 1e-3, wire = 0.45e-3, clearance = 0.002e-3;
  constexpr int elements = 40;
  const double length = ratio * pi / 2 / (std::sqrt(1.3) * k);
  Pair pair(uniform({length, EI, k, 1e-3, wire + clearance, 5e-3}, elements, 2),
            uniform({length, EI, k, wire, 0, 5e-3}, elements, 2), bound);
  double rolled = 0, tip = 0, last = 0, window_start = 0, window_tip = 0, largest = 0;
  while (rolled < 190 * pi / 180) {
    const double rate = rolled < 172 * pi / 180 ? 1.0 : 0.05;
    pair.inputs.rods[1].base.turn_rate_W_rad_s = Vector3d(rate, 0, 0);
    pair.step();
    rolled += 1e-3 * rate;
    const Eigen::Quaterniond d = pair.frame(0, elements - 1).conjugate() * pair.frame(1, elements - 1);
    const double angle = 2 * std::atan2(d.z(), d.w());
    tip += std::remainder(angle - last, 2 * pi);
    last = angle;
    if (rolled - window_start < 0.5 * pi / 180) continue;
    if (rate < 1) largest = std::max(largest, tip - window_tip);
    window_start = rolled, window_tip = tip;
  }
  return largest * 180 / pi;
}

/// L sqrt((1 + nu) k1 k2) / (pi / 2) at which jumps begin.
data::GateResult snap(bool quick, bool bound) {
  // Just below the critical length the tip turns by up to 10 degrees, just above it by 70.
  double smooth = 0.94, jumps = 1.06;
  constexpr double jump_deg = 25;
  const bool bracketed = largest_jump_deg(smooth, bound) < jump_deg && largest_jump_deg(jumps, bound) > jump_deg;
  if (!bracketed) return {"nesting-snap", 0, 1, 0.03, "1"};
  while (jumps - smooth > (quick ? 0.03 : 0.01)) {
    const double middle = (smooth + jumps) / 2;
    (largest_jump_deg(middle, bound) > jump_deg ? jumps : smooth) = middle;
  }
  return {"nesting-snap", (smooth + jumps) / 2, 1, 0.03, "1"};
}

data::GateResult push(bool bound) {
  constexpr double R = 0.05, clearance = 0.1e-3, EI = 1e-3, wire = 0.2e-3, straight = 0.05, bend = 3 * R;
  core::RodDescription tube = uniform({bend, 500, 1 / R, 2e-3, wire + clearance, 10}, 200, 0);
  core::Section lead = tube.sections[0];
  lead.from_tip_m = bend, lead.to_tip_m = bend + straight;
  lead.rest_curvature_per_m.setZero();
  tube.sections.push_back(lead);
  tube.element_lengths_m = equal_elements(tube.sections, 200);
  const core::RodDescription inner = uniform({bend + straight + 0.05, EI, 0, wire, 0, 8e-4}, 250, 0);
  Pair pair(tube, inner, bound, {bend + straight, 0.03});
  pair.inputs.rods[1].feed_m_s = 0.05;
  double sum = 0;
  int count = 0;
  while (pair.state.rods[1].inserted_m < straight + bend - 0.002) {
    pair.step();
    if (pair.state.rods[1].inserted_m < straight + bend - 0.05) continue;
    sum += pair.report.rods[1].push_N;
    ++count;
  }
  // Along the outer or inner side of the bend, k = 1 / (R +- c): here within 0.4 % of the middle.
  const double reference = EI / (2 * R * R);
  return {"nesting-push", sum / count, reference, 0.03 * reference, "N"};
}

/// Fed and rolled as by hand: how far any node of the inner rod leaves the bore.
data::GateResult containment(bool quick, bool bound) {
  constexpr double wire = 0.45e-3, clearance = 0.15e-3;
  core::RodDescription outer = uniform({0.4, 1.5e-3, 0, 0.9e-3, wire + clearance, 4e-3}, 200, 0.007);
  core::Section tip = outer.sections[0];
  tip.to_tip_m = 0.05, tip.rest_curvature_per_m = {0, 20, 0};
  outer.sections[0].from_tip_m = 0.05;
  outer.sections.insert(outer.sections.begin(), tip);
  const core::RodDescription inner = uniform({0.6, 1e-3, 0, wire, 0, 3e-3}, 300, 0.007);
  Pair pair(outer, inner, bound, {0.35, 0.3});
  double worst = 0;
  const int steps = quick ? 1500 : 4000;
  for (int n = 0; n < steps; ++n) {
    const double t = 1e-3 * n;
    pair.inputs.rods[0].feed_m_s = 0.03 * std::sin(2 * pi * 0.5 * t);
    pair.inputs.rods[1].feed_m_s = 0.05 * std::sin(2 * pi * 0.3 * t);
    pair.inputs.rods[0].base.turn_rate_W_rad_s = Vector3d(2 * std::sin(2 * pi * 0.4 * t), 0, 0);
    pair.inputs.rods[1].base.turn_rate_W_rad_s = Vector3d(5 * std::cos(2 * pi * 0.2 * t), 0, 0);
    pair.step();
    if (n % 10 != 0 || n < 100) continue;  // the first 0.1 s release the initial shapes, which do not match
    for (int i = pair.state.rods[1].first + 1; i <= pair.model.rods[1].elements; ++i) {
      bool beyond = false;
      const double d =
          distance_to_centreline(pair.model.rods[0], pair.state.rods[0], pair.state.rods[1].position[i], beyond);
      if (beyond) break;
      worst = std::max(worst, d - clearance);
    }
  }
  return {"nesting-containment", 1e3 * worst, 0, 0.02, "mm"};
}

/// A catheter that is soft and straight is drawn back over a stiff bent wire that is held: how far the wire's tip moves
/// from its own shape, or the catheter's tip from the wire.
data::GateResult draw_back(bool quick, bool bound) {
  constexpr double wire = 0.45e-3, clearance = 0.05e-3, k = 0.4;
  const auto catheter = [&](double curvature) {
    return uniform({0.2, 4e-4, curvature, 0.8e-3, wire + clearance, 3e-3}, 100, 1);
  };
  Pair pair(catheter(k), uniform({0.25, 1e-2, k, wire, 0, 5e-3}, 125, 1), bound, {0.15, 0.2});
  pair.model.rods[0] = make_rod(catheter(0));
  pair.scratch = core::Scratch(pair.model);
  const Vector3d tip = pair.state.rods[1].position[125];
  pair.step(quick ? 1000 : 3000);
  pair.inputs.rods[0].feed_m_s = -0.05;
  double worst = 0;
  while (pair.state.rods[0].inserted_m > 0.05) {
    pair.step();
    bool beyond = false;
    const Vector3d catheter_tip = pair.state.rods[0].position[100];
    worst = std::max({worst, (pair.state.rods[1].position[125] - tip).norm(),
                      distance_to_centreline(pair.model.rods[1], pair.state.rods[1], catheter_tip, beyond)});
  }
  return {"nesting-draw-back", 1e3 * worst, 0, 0.5, "mm"};
}

}  // namespace

namespace {
data::GateResult first_pair(bool bound) {
  return aligned_pair("nesting-pair-100", 1e-3, 2e-3, 10, 5, 0.05e-3, 100, 0.5, bound);
}
}  // namespace

data::GateResult nesting_pair() { return first_pair(true); }

std::vector<data::GateResult> nesting_with(bool quick, bool bound) {
  return {
      first_pair(bound),
      aligned_pair("nesting-pair-300", 2e-3, 1e-3, 20, 8, 0.1e-3, 300, 0.5, bound),
      snap(quick, bound),
      push(bound),
      containment(quick, bound),
      draw_back(quick, bound),
      aligned_pair("nesting-stiff-wire", 5e-4, 6e-3, 25, 0, 0.1e-3, 150, 2, bound),
      aligned_pair("nesting-soft-wire", 5e-3, 1e-4, 25, 0, 0.1e-3, 150, 2, bound),
  };
}

std::vector<data::GateResult> nesting(bool quick) { return nesting_with(quick, true); }

}  // namespace ostium::app::gates
