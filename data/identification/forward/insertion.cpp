#include "data/identification/forward/insertion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/rod/initial_state.h"
#include "core/rod/introducer.h"
#include "core/step/step.h"

namespace ostium::data {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// With steps of 2 ms at this speed, a wire drawn back with friction slips where it should stick.
constexpr double feed_m_s = 0.02, turn_rad_s = units::pi / 2, step_s = 1e-3;
/// The feed slows down before it stops: a wire stopped abruptly slides back on its friction by the distance it was
/// moving in a step.
constexpr double slowing_s = 0.2;
/// Damping that makes motion quasi-static: far more than blood's, yet only a tenth of a millinewton while a wire is
/// fed.
constexpr core::Damping slow{0.1, 0.02, 2e-3};
constexpr double element_m = 2e-3, element_rad = 0.1, reserve_m = 20e-3;
constexpr double rest_speed_m_s = 2e-4, least_rest_s = 0.1, most_rest_s = 2;
constexpr double bore_friction = 0.05;

/// A tip meets a wall at an angle: if the wall is compliant, only the last few millimetres are in contact.
constexpr double tip_m = 6e-3, tip_element_m = 0.5e-3;

std::vector<double> elements_of(const core::ConcentricPart& part, double length) {
  double longest = element_m;
  for (const core::Section& s : part.sections)
    longest = std::min(longest, element_rad / std::max(s.rest_curvature_per_m.norm(), 1e-6));
  const double tip = std::min(tip_m, 0.5 * length);
  const int count = std::max(16, static_cast<int>(std::ceil((length - tip) / longest)));
  const int at_tip = static_cast<int>(std::ceil(tip / std::min(tip_element_m, longest)));
  std::vector<double> out(count, (length - tip) / count);
  out.insert(out.end(), at_tip, tip / at_tip);
  return out;
}

class History {
 public:
  History(const MeasurementSet& set, const Changes& changes) : set_(set) {
    for (const Experiment& e : set.experiments) setups_.push_back(setup_of(set, e, changes));
    const ExperimentSetup& first = setups_.front();
    for (std::size_t i = 0; i < set.instruments.size(); ++i) {
      double longest = 0;
      for (const ExperimentSetup& s : setups_) longest = std::max(longest, s.nest.parts[i].inserted_m);
      const core::ConcentricPart& part = first.nest.parts[i];
      const double length = std::min(longest + reserve_m, part.sections.back().to_tip_m);
      model_.rods.push_back(
          core::make_rod({set.instruments[i].name, part.sections, elements_of(part, length), slow, {}}));
      if (i > 0)
        model_.nestings.push_back(
            {.outer = static_cast<int>(i) - 1, .inner = static_cast<int>(i), .friction = bore_friction});
    }
    core::SurfaceDescription wall = *set.vessel->wall;
    wall.friction = first.wall_friction.value_or(set.vessel->friction);
    wall.stiffness_N_m2 = first.wall_stiffness_N_m2;
    model_.surfaces = {std::make_shared<core::Surface>(make_surface(wall))};
    model_.gravity_W = first.gravity_m_s2;
    model_.step_s = step_s;
    check(model_);

    std::vector<core::EndState> bases;
    std::vector<double> inserted;
    for (std::size_t i = 0; i < model_.rods.size(); ++i) {
      core::EndState base = first.base;
      const Quaterniond q = frame(first, i, 1, nullptr);
      base.q_W = {q.w(), q.x(), q.y(), q.z()};
      bases.push_back(base);
      inserted.push_back(std::min(1.2 * least_inserted_m(model_.rods[i]), first.nest.parts[i].inserted_m));
      at_.push_back(inserted.back());
    }
    state_ = make_state(model_, bases, inserted);
    scratch_.emplace(model_);
    inputs_.rods.resize(model_.rods.size());
    inputs_.surfaces.resize(1);
  }

  PredictedShape reach(std::size_t e) {
    const ExperimentSetup& to = setups_[e];
    const ExperimentSetup& from = setups_[e > 0 ? e - 1 : 0];
    double seconds = 0;
    for (std::size_t i = 0; i < at_.size(); ++i)
      seconds = std::max({seconds, std::fabs(to.nest.parts[i].inserted_m - at_[i]) / feed_m_s,
                          std::fabs(to.nest.parts[i].roll_rad - from.nest.parts[i].roll_rad) / turn_rad_s});
    const int steps = static_cast<int>(std::ceil((seconds + slowing_s) / step_s));
    std::vector<double> way(at_.size());
    for (std::size_t i = 0; i < at_.size(); ++i)
      way[i] = to.nest.parts[i].inserted_m - at_[i], at_[i] = to.nest.parts[i].inserted_m;
    for (int k = 0; k < steps && !lost_; ++k) {
      const double done = part_done(k, steps), next = part_done(k + 1, steps);
      for (std::size_t i = 0; i < at_.size(); ++i) {
        inputs_.rods[i].feed_m_s = (next - done) / step_s * way[i];
        // Angular velocity of the base, from its roll and its tilt.
        const Quaterniond a = frame(to, i, done, &from), b = frame(to, i, next, &from);
        const Eigen::AngleAxisd turn(b * a.conjugate());
        inputs_.rods[i].base.turn_rate_W_rad_s = turn.angle() / step_s * turn.axis();
      }
      inputs_.rods.back().tip_force_W_N = from.tip_force_N + next * (to.tip_force_N - from.tip_force_N);
      advance();
    }
    come_to_rest();
    return shape(to);
  }

 private:
  /// Share of the path done after k of `steps` steps: constant speed, then slowing down at the end.
  static double part_done(int k, int steps) {
    const double all = steps * step_s, left = all - k * step_s, even = all - slowing_s / 2;
    return 1 - (left > slowing_s ? left - slowing_s / 2 : left * left / (2 * slowing_s)) / even;
  }

  /// The base frame of instrument i, `part` of the way between two setups.
  static Quaterniond frame(const ExperimentSetup& to, std::size_t i, double part, const ExperimentSetup* from) {
    const ExperimentSetup& before = from ? *from : to;
    const double roll = (1 - part) * before.nest.parts[i].roll_rad + part * to.nest.parts[i].roll_rad;
    return quaternion(before.base.q_W).slerp(part, quaternion(to.base.q_W)) *
           Eigen::AngleAxisd(roll, Vector3d::UnitZ());
  }

  void advance() {
    step(model_, inputs_, state_, *scratch_, report_);
    constexpr std::uint32_t fatal = core::motion_lost | core::no_solution | core::joint_overturned;
    lost_ = lost_ || (report_.trouble & fatal & ~core::motion_lost) != 0;
    for (const core::RodState& rod : state_.rods)
      if (!rod.position[rod.position.size() - 1].allFinite()) lost_ = true;
  }

  void come_to_rest() {
    for (core::RodInputs& rod : inputs_.rods) rod.feed_m_s = 0, rod.base.turn_rate_W_rad_s.setZero();
    for (double t = 0; t < most_rest_s && !lost_; t += step_s) {
      advance();
      if (t > least_rest_s && fastest() < rest_speed_m_s) break;
    }
  }

  double fastest() const {
    double most = 0;
    for (std::size_t r = 0; r < state_.rods.size(); ++r)
      for (int i = state_.rods[r].first; i < state_.rods[r].velocity.size(); ++i)
        most = std::max(most, state_.rods[r].velocity[i].norm());
    return most;
  }

  /// The shape of the innermost instrument, which reaches furthest.
  PredictedShape shape(const ExperimentSetup& to) const {
    PredictedShape out;
    out.converged = !lost_;
    const core::RodState& rod = state_.rods.back();
    out.points_m.push_back(to.base.p_W);
    for (int i = rod.first + 1; i < rod.position.size(); ++i) out.points_m.push_back(rod.position[i]);
    out.tip_q = rod.orientation[rod.orientation.size() - 1];
    const Quaterniond q = quaternion(out.tip_q) * Eigen::AngleAxisd(-to.material_turn_rad, Vector3d::UnitZ());
    out.tip_q = {q.w(), q.x(), q.y(), q.z()};
    if (!report_.rods.empty())
      for (const core::RodReport& r : report_.rods) out.base_push_N += r.push_N;
    return out;
  }

  const MeasurementSet& set_;
  std::vector<ExperimentSetup> setups_;
  core::Model model_;
  core::State state_;
  std::optional<core::Scratch> scratch_;
  core::Inputs inputs_;
  core::StepReport report_;
  std::vector<double> at_;
  bool lost_ = false;
};

}  // namespace

std::vector<PredictedShape> insert(const MeasurementSet& set, const Changes& changes,
                                   const std::function<void(std::size_t, std::size_t)>& progress) {
  History history(set, changes);
  std::vector<PredictedShape> shapes;
  for (std::size_t e = 0; e < set.experiments.size(); ++e) {
    shapes.push_back(history.reach(e));
    if (progress) progress(e + 1, set.experiments.size());
  }
  return shapes;
}

}  // namespace ostium::data
