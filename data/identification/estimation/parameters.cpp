#include "data/identification/estimation/parameters.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/base/units.h"
#include "core/math/alignment.h"

namespace ostium::data {

namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

using units::mm, units::degree;

/// A declared stiffness is uncertain by perhaps 30 %.
constexpr double stiffness_spread = 0.3, least_scale = 0.1, most_scale = 10;
/// Finite-difference step of an effect, relative to its prior's spread: positions along the instrument must move by
/// more than the shape's sensitivity to element boundaries.
constexpr double effect_step = 1e-2;
/// Weak priors: they only decide what the data leave open.
constexpr double rotation_spread_deg = 60, translation_spread_mm = 300, offset_spread_mm = 15;
constexpr double most_rotation_deg = 170, most_translation_mm = 2000, most_offset_mm = 60;

double inside(const Parameter& p, double value) { return p.logarithmic ? std::log(value) : value; }

Eigen::Quaterniond rotation(const Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

}  // namespace

Parameters::Parameters(const MeasurementSet& set, const std::vector<ActiveEffect>& declared,
                       const std::vector<ActiveEffect>& tried)
    : declared_(declared), tried_(tried), index_of_(tried.size()) {
  add_stiffness(set);
  for (std::size_t e = 0; e < tried.size(); ++e)
    if (tried[e].effect->apply) add_effect(set, e);
  shape_parameters_ = size();
  for (std::size_t e = 0; e < tried.size(); ++e)
    if (!tried[e].effect->apply) add_effect(set, e);
  add_view(set.imaging);
}

void Parameters::add_stiffness(const MeasurementSet& set) {
  for (std::size_t i = 0; i < set.instruments.size(); ++i) {
    const MeasuredInstrument& instrument = set.instruments[i];
    std::vector<int> scales;
    const int first = size();
    for (std::size_t s = 0; s < instrument.sections.size(); ++s) {
      const core::Section& section = instrument.sections[s];
      int same = -1;
      for (std::size_t t = 0; t < s && same < 0; ++t)
        if (instrument.sections[t].EI1_N_m2 == section.EI1_N_m2 && instrument.sections[t].GJ_N_m2 == section.GJ_N_m2)
          same = scales[t];
      if (same < 0) {
        same = size();
        list_.push_back({fmt::format("EI_scale[{}][{}]", i, s),
                         fmt::format("stiffness of {}, {:g} to {:g} mm from the tip", instrument.name,
                                     section.from_tip_m / mm, section.to_tip_m / mm),
                         "1", 1, stiffness_spread, least_scale, most_scale, true, true});
      }
      scales.push_back(same);
    }
    if (size() == first + 1) {
      list_[first].name = fmt::format("EI_scale[{}]", i);
      list_[first].label = "stiffness of " + instrument.name;
    }
    scale_of_.push_back(scales);
  }
}

void Parameters::add_effect(const MeasurementSet& set, std::size_t tried) {
  const ActiveEffect& active = tried_[tried];
  const auto parameters = parameters_of(*active.effect, set, active.instrument);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!active.held.empty() && active.held[i]) {
      index_of_[tried].push_back(-1);
      continue;
    }
    const EffectParameter& p = parameters[i];
    std::string name = active.effect->id;
    if (active.instrument) name += fmt::format("[{}]", *active.instrument);
    // The same effect on two stretches.
    for (std::size_t other = 0; other < tried; ++other)
      if (tried_[other].effect == active.effect && tried_[other].instrument == active.instrument)
        name += " (" + active.form + ")";
    index_of_[tried].push_back(size());
    list_.push_back({name + "." + p.name, p.what, p.unit, p.prior, p.spread, p.least, p.most, p.logarithmic,
                     active.effect->apply != nullptr, effect_step * p.spread});
  }
}

void Parameters::add_view(const Imaging& imaging) {
  const auto three = [&](const std::string& name, const std::string& label, const std::string& unit, double spread,
                         double most) {
    for (const char* axis : {"x", "y", "z"})
      list_.push_back({name + axis + "_" + unit, label + " " + axis, unit, 0, spread, -most, most, false, false});
  };
  if (imaging.registration_free) {
    registration_ = size();
    three("registration.r", "turn of the measuring frame about", "deg", rotation_spread_deg, most_rotation_deg);
    three("registration.", "shift of the measuring frame along", "mm", translation_spread_mm, most_translation_mm);
  }
  if (imaging.tip_offset_free) {
    offset_ = size();
    three("tip_offset.", "tracked point off the tip along director", "mm", offset_spread_mm, most_offset_mm);
  }
}

VectorXd Parameters::start() const {
  VectorXd x(size());
  for (int i = 0; i < size(); ++i) x[i] = inside(list_[i], list_[i].start);
  return x;
}

double Parameters::value(int i, double x) const { return list_[i].logarithmic ? std::exp(x) : x; }
double Parameters::inner(int i, double value) const { return inside(list_[i], value); }

double Parameters::within(int i, double part) const {
  const Parameter& p = list_[i];
  const double middle = inside(p, p.start), least = std::max(inside(p, p.least), middle - 2 * p.spread),
               most = std::min(inside(p, p.most), middle + 2 * p.spread);
  return least + part * (most - least);
}

void Parameters::widen_last_effect(double factor) {
  if (index_of_.empty()) return;
  for (int i : index_of_.back())
    if (i >= 0) list_[i].spread *= factor, list_[i].step *= factor;
}

void Parameters::coarsen_steps() {
  for (int i = 0; i < shape_parameters_; ++i) list_[i].step = 0.1 * list_[i].spread;
}

double Parameters::sigma(int i, double x, double sigma_x) const {
  return list_[i].logarithmic ? std::exp(x) * sigma_x : sigma_x;
}

Changes Parameters::changes(const VectorXd& x) const {
  Changes changes;
  for (const auto& scales : scale_of_) {
    changes.stiffness_scale.emplace_back();
    for (int index : scales) changes.stiffness_scale.back().push_back(value(index, x[index]));
  }
  changes.effects = declared_;
  for (std::size_t e = 0; e < tried_.size(); ++e) {
    changes.effects.push_back(tried_[e]);
    for (std::size_t p = 0; p < index_of_[e].size(); ++p)
      if (const int index = index_of_[e][p]; index >= 0) changes.effects.back().values[p] = value(index, x[index]);
  }
  return changes;
}

MeasuredView Parameters::view(const VectorXd& x) const {
  MeasuredView view = nominal_;
  if (registration_ >= 0) {
    const Vector3d turn = x.segment<3>(registration_) * degree, shift = x.segment<3>(registration_ + 3) * mm;
    view.R = rotation(turn) * nominal_.R;
    view.t_m = nominal_.t_m + shift;
  }
  if (offset_ >= 0) view.tip_offset_m = x.segment<3>(offset_) * mm;
  return view;
}

MeasuredView registered(const MeasurementSet& set, const std::vector<PredictedShape>& shapes) {
  MeasuredView view;
  if (!set.imaging.registration_free) return view;
  std::vector<Vector3d> model, measured;
  for (std::size_t e = 0; e < shapes.size(); ++e) {
    const auto& points = set.experiments[e].points_m;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double fraction = points.size() == 1 ? 1 : static_cast<double>(i) / static_cast<double>(points.size() - 1);
      const auto& curve = shapes[e].points_m;
      model.push_back(curve[static_cast<std::size_t>(std::lround(fraction * static_cast<double>(curve.size() - 1)))]);
      measured.push_back(points[i]);
    }
  }
  if (model.empty()) return view;
  const auto n = static_cast<double>(model.size());
  Vector3d mean_model = Vector3d::Zero(), mean_measured = Vector3d::Zero();
  for (std::size_t i = 0; i < model.size(); ++i) mean_model += model[i] / n, mean_measured += measured[i] / n;
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < model.size(); ++i)
    H += (measured[i] - mean_measured) * (model[i] - mean_model).transpose();
  view.R = Eigen::Quaterniond(core::nearest_rotation(H));
  view.t_m = mean_measured - view.R * mean_model;
  return view;
}

}  // namespace ostium::data
