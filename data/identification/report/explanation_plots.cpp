#include "data/identification/report/explanation_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "data/formats/plot.h"
#include "data/identification/forward/misfit.h"
#include "data/identification/forward/projected.h"
#include "data/identification/measurement/measured_curves.h"

namespace ostium::data {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

using units::mm;
const std::string measured_colour = "#222222", before_colour = "#d55e00", after_colour = "#0072b2";
const char* const axes[] = {"x", "y", "z"};

bool has_after(const Explanation& x) { return &x.best() != &x.declared || !x.candidates.empty(); }
/// The model shown beside the declared one: the winner, or the best candidate.
const FittedModel& after(const Explanation& x) { return x.candidates.empty() ? x.declared : x.candidates.front(); }

void name_models(Plot& plot, const Explanation& x, bool measured) {
  if (measured) plot.legend("measured", measured_colour, true);
  plot.legend("declared", before_colour);
  if (has_after(x)) plot.legend("with effect", after_colour, false);
}

Plot::Points seen(const std::vector<Vector3d>& points, int across, int up) {
  Plot::Points out;
  for (const Vector3d& p : points) out.emplace_back(p[across] / mm, p[up] / mm);
  return out;
}

/// Measured points transformed to the set's frame.
std::vector<Vector3d> in_set(const std::vector<Vector3d>& points, const MeasuredView& view) {
  std::vector<Vector3d> out;
  for (const Vector3d& p : points) out.push_back(view.R.conjugate() * (view.A.inverse() * (p - view.b_m) - view.t_m));
  return out;
}

/// The axis closest to the first base's direction, along the wire; drawn up or to the right.
int length_axis(const MeasurementSet& set) {
  const Eigen::Vector4d& q = set.experiments.front().base.q_W;
  const Vector3d d3 = Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Vector3d::UnitZ();
  int axis = 0;
  d3.cwiseAbs().maxCoeff(&axis);
  return axis;
}

int other_axis(int length, int which) { return which == 0 ? (length + 1) % 3 : (length + 2) % 3; }

}  // namespace

std::string shapes_plot(const MeasurementSet& set, const Explanation& x, int which) {
  const int length = length_axis(set), across = other_axis(length, which);
  Plot plot("Shapes", fmt::format("{}, mm", axes[length]), fmt::format("{}, mm", axes[across]));
  plot.equal_scales();
  const FittedModel& shown = x.verdict == Verdict::effect ? after(x) : x.declared;
  for (std::size_t e = 0; e < set.experiments.size(); ++e) {
    plot.line(seen(x.declared.shapes[e].points_m, length, across), before_colour, 1.1);
    if (has_after(x)) plot.line(seen(after(x).shapes[e].points_m, length, across), after_colour, 1.3);
    const bool tip = set.experiments[e].kind == Experiment::Kind::tip;
    const MeasuredView view = seen(set, set.experiments[e], shown.changes, shown.view);
    plot.dots(seen(in_set(set.experiments[e].points_m, view), length, across), measured_colour, tip ? 2.2 : 1.3);
    // A tracked point is offset from the tip: the line to the modelled tip is drawn as part of the model.
    if (set.experiments[e].kind == Experiment::Kind::tip && set.imaging.tip_offset_free) {
      const Vector3d tracked = in_set({tracked_tip(shown.shapes[e], view)}, view)[0];
      plot.line(seen({shown.shapes[e].points_m.back(), tracked}, length, across), "#999999", 0.8, "2 2");
    }
  }
  name_models(plot, x, true);
  return plot.svg();
}

std::string view_plot(const MeasurementSet& set, const Explanation& x, int v) {
  Plot plot("View " + set.views[v].id, "column, px", "row, px", 460, 420);
  plot.equal_scales();
  plot.y_downwards();
  const auto model = [&](const FittedModel& m, std::size_t e, const std::string& colour, double width) {
    const MeasuredView view = seen(set, set.experiments[e], m.changes, m.view);
    plot.line(projected_px(m.shapes[e], view, v), colour, width);
  };
  for (std::size_t e = 0; e < set.experiments.size(); ++e)
    for (const ClickedPolyline& polyline : set.experiments[e].polylines) {
      if (polyline.view != v) continue;
      model(x.declared, e, before_colour, 1.1);
      if (has_after(x)) model(after(x), e, after_colour, 1.3);
      plot.dots(polyline.points_px, measured_colour, 1.1);
    }
  name_models(plot, x, true);
  return plot.svg();
}

std::string along_wire_plot(const MeasurementSet& set, const Explanation& x) {
  Plot plot("Residual along the wire", "distance from the tip, mm", "root mean square, " + x.unit.name, 940, 260);
  plot.y_from_zero();
  constexpr int parts = 30;
  double longest = 0;
  for (const Experiment& e : set.experiments) longest = std::max(longest, e.set.back().inserted_m);
  const auto profile = [&](const FittedModel& m) {
    Eigen::VectorXd squares = Eigen::VectorXd::Zero(parts), count = squares;
    for (std::size_t e = 0; e < set.experiments.size(); ++e)
      for (const MeasuredCurve& curve : measured_curves(set.experiments[e]))
        for (std::size_t i = 0; i < curve.from_tip_m.size(); ++i) {
          const int part = std::min(parts - 1, static_cast<int>(parts * curve.from_tip_m[i] / longest));
          squares[part] += m.misfits[e].segment<3>(3 * static_cast<Eigen::Index>(curve.first + i)).squaredNorm();
          count[part] += 1;
        }
    Plot::Points points;
    for (int k = 0; k < parts; ++k)
      if (count[k] > 0)
        points.emplace_back((k + 0.5) * longest / parts / mm, std::sqrt(squares[k] / count[k]) / x.unit.size);
    return points;
  };
  plot.line(profile(x.declared), before_colour, 2);
  if (has_after(x)) plot.line(profile(after(x)), after_colour, 2);
  if (x.noise.sigma_m) plot.level(noise_floor(set, *x.noise.sigma_m) / x.unit.size, "noise");
  name_models(plot, x, false);
  return plot.svg();
}

std::string tip_residual_plot(const MeasurementSet& set, const Explanation& x, int which) {
  const int length = length_axis(set), across = other_axis(length, which);
  Plot plot("Tip residuals", fmt::format("measured minus model in {}, mm", axes[length]),
            fmt::format("in {}, mm", axes[across]));
  plot.equal_scales();
  const auto points = [&](const FittedModel& m) {
    std::vector<Vector3d> out;
    for (std::size_t e = 0; e < set.experiments.size(); ++e)
      if (set.experiments[e].kind == Experiment::Kind::tip)
        out.push_back(m.view.R.conjugate() * Vector3d(m.misfits[e]));
    return seen(out, length, across);
  };
  const Plot::Points before = points(x.declared);
  plot.dots(before, before_colour, 3);
  if (has_after(x)) {
    const Plot::Points now = points(after(x));
    for (std::size_t i = 0; i < now.size(); ++i) plot.line({before[i], now[i]}, "#cccccc", 0.8);
    plot.dots(now, after_colour, 3);
  }
  plot.legend("declared", before_colour, true);
  if (has_after(x)) plot.legend("with effect", after_colour, true);
  return plot.svg();
}

std::string radius_plot(const MeasurementSet& set, const Explanation& x) {
  bool timed = false;
  for (const Experiment& e : set.experiments) timed = timed || e.elapsed_s.value_or(0) > 0;
  Plot plot("Radius of curvature", timed ? "time in position, min" : "experiment", "radius, mm", 940, 320);
  struct Curve {
    Plot::Points measured, before, now;
  };
  std::vector<std::pair<std::string, Curve>> curves;
  for (std::size_t e = 0; e < set.experiments.size(); ++e) {
    const Experiment& m = set.experiments[e];
    if (m.kind != Experiment::Kind::radius) continue;
    if (curves.empty() || curves.back().first != m.group) curves.push_back({m.group, {}});
    const double at = timed ? m.elapsed_s.value_or(0) / 60 : static_cast<double>(e), radius = m.radius_m / mm;
    curves.back().second.measured.emplace_back(at, radius);
    curves.back().second.before.emplace_back(at, radius - x.declared.misfits[e][0] / mm);
    curves.back().second.now.emplace_back(at, radius - after(x).misfits[e][0] / mm);
  }
  for (const auto& [group, curve] : curves) {
    plot.line(curve.before, before_colour);
    if (has_after(x)) plot.line(curve.now, after_colour);
    plot.line(curve.measured, "#bbbbbb", 0.8);
    plot.dots(curve.measured, measured_colour, 2.6);
  }
  name_models(plot, x, true);
  return plot.svg();
}

std::string experiments_plot(const MeasurementSet& set, const Explanation& x) {
  Plot plot("Residual of each experiment", "", "root mean square, " + x.unit.name, 940, 280);
  std::vector<std::string> names;
  std::vector<std::vector<double>> series(has_after(x) ? 2 : 1);
  for (std::size_t e = 0; e < set.experiments.size(); ++e) {
    names.push_back(set.experiments[e].id);
    series[0].push_back(x.declared.experiment_rms_m[e] / x.unit.size);
    if (has_after(x)) series[1].push_back(after(x).experiment_rms_m[e] / x.unit.size);
  }
  plot.bars(names, series, {before_colour, after_colour});
  name_models(plot, x, false);
  return plot.svg();
}

}  // namespace ostium::data
