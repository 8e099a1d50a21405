/// How hands move in each part of a procedure: how often, how fast, how evenly, how directly.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/units.h"
#include "data/assessment/metric_functions.h"
#include "data/assessment/metrics.h"

namespace ostium::data {

namespace {

constexpr double moves_from_mm_s = 1, turns_from_deg_s = 10;  // slower, a hand rests
constexpr double least_rest_s = 0.25, least_movement_s = 0.1;
constexpr double hand_cut_off_Hz = 2;  // of a low pass on the speed; people move their hands more slowly

/// To the first coronary artery, from there to the first inflation, from there on.
enum class Phase { cannulation, wiring, treatment };

struct Rows {
  std::size_t from = 0, to = 0;
};

/// Rows of a phase; none where it never began.
Rows rows_of(const RunRecord& r, Phase phase) {
  constexpr std::array coronary = {"LM", "LAD", "LCx", "RCA"};
  const double end_s = static_cast<double>(r.steps) * r.step_s + 1;
  double in_s = end_s, artery_s = end_s, inflated_s = end_s;
  for (const RecordedEvent& e : events_of(r)) {
    const auto branch = static_cast<std::size_t>(e.value);
    if (e.code == EventCode::tool_in) in_s = std::min(in_s, e.time_s);
    if (e.code == EventCode::tip_enters && branch < r.branches.size() &&
        std::ranges::find(coronary, r.branches[branch]) != coronary.end())
      artery_s = std::min(artery_s, e.time_s);
    if (e.code == EventCode::inflation_begins) inflated_s = std::min(inflated_s, e.time_s);
  }
  artery_s = std::min(artery_s, inflated_s);
  const double from_s = phase == Phase::cannulation ? in_s
                        : phase == Phase::wiring    ? artery_s
                                                    : inflated_s,
               to_s = phase == Phase::cannulation ? artery_s
                      : phase == Phase::wiring    ? inflated_s
                                                  : end_s;
  Rows out{r.rows(), 0};
  for (std::size_t i = 0; i < r.rows(); ++i)
    if (const double t = SignalColumn{r, 0}[i]; t >= from_s && t < to_s)
      out.from = std::min(out.from, i), out.to = std::max(out.to, i + 1);
  return out.from < out.to ? out : Rows{};
}

struct Movements {
  int count = 0;
  double moving_s = 0, path_mm = 0;
  double path_needed_mm = 0;  ///< each tool to its deepest and back to where it ends
  double square_mm2_s4 = 0;   ///< sum of squares of the acceleration, times the spacing of rows
};

Movements movements(const RunRecord& r, Phase phase) {
  const Rows rows = rows_of(r, phase);
  const double dt = row_spacing_s(r);
  Movements out;
  if (rows.to - rows.from < 2 || !(dt > 0)) return out;
  const std::vector<SignalColumn> inserted = tool_columns(r, "inserted_mm"), turned = tool_columns(r, "turned_deg");
  const double share = 1 - std::exp(-2 * units::pi * hand_cut_off_Hz * dt);
  double low_mm_s = 0, rested_s = least_rest_s, moved_s = 0;
  for (std::size_t i = rows.from + 1; i < rows.to; ++i) {
    double fed_mm = 0, turned_deg = 0;
    for (const SignalColumn& c : inserted) fed_mm += std::fabs(c[i] - c[i - 1]);
    for (const SignalColumn& c : turned) turned_deg = std::max(turned_deg, std::fabs(c[i] - c[i - 1]));
    const double before_mm_s = low_mm_s;
    low_mm_s += share * (fed_mm / dt - low_mm_s);
    out.square_mm2_s4 += std::pow((low_mm_s - before_mm_s) / dt, 2) * dt;
    out.path_mm += fed_mm;
    if (fed_mm > moves_from_mm_s * dt || turned_deg > turns_from_deg_s * dt) {
      if (rested_s >= least_rest_s) moved_s = 0;
      const bool counted = moved_s >= least_movement_s - 1e-9;
      moved_s += dt, rested_s = 0, out.moving_s += dt;
      if (!counted && moved_s >= least_movement_s - 1e-9) ++out.count;
    } else {
      rested_s += dt;
    }
  }
  for (const SignalColumn& c : inserted) {
    double most = c[rows.from];
    for (std::size_t i = rows.from; i < rows.to; ++i) most = std::max(most, c[i]);
    out.path_needed_mm += 2 * most - c[rows.from] - c[rows.to - 1];
  }
  return out;
}

void add(Phase phase, const std::string& name, const std::string& when, std::vector<MetricDefinition>& to) {
  using enum Better;
  const auto of = [phase](double (*number)(const Movements&)) {
    return [=](const RunRecord& r) {
      const Movements m = movements(r, phase);
      return m.moving_s > 0 ? number(m) : does_not_apply;
    };
  };
  to.push_back({name + "_movements", "1", lower,
                when + ": movements of the hands, faster than 1 mm/s or 10 degrees/s, with rests of 0.25 s between",
                of([](const Movements& m) { return static_cast<double>(m.count); })});
  to.push_back({name + "_speed_mean_mm_s", "mm/s", neither, when + ": hand path over the time in which hands move",
                of([](const Movements& m) { return m.path_mm / m.moving_s; })});
  to.push_back({name + "_acceleration_mm_s2", "mm/s2", lower,
                when + ": root mean square of the speed's change, behind a low pass of 2 Hz, while hands move",
                of([](const Movements& m) { return std::sqrt(m.square_mm2_s4 / m.moving_s); })});
  to.push_back(
      {name + "_path_ratio", "1", lower, when + ": hand path over the shortest that does the same",
       of([](const Movements& m) { return m.path_needed_mm > 0 ? m.path_mm / m.path_needed_mm : does_not_apply; })});
}

}  // namespace

std::vector<MetricDefinition> movement_metrics() {
  std::vector<MetricDefinition> out;
  add(Phase::cannulation, "cannulation", "until a tip is in a coronary artery", out);
  add(Phase::wiring, "wiring", "from there to the first inflation", out);
  add(Phase::treatment, "treatment", "from the first inflation on", out);
  return out;
}

}  // namespace ostium::data
