#include "data/identification/characterisation/wire_check.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/math/dense.h"
#include "data/identification/curves/kinds.h"
#include "data/identification/curves/set/run_table.h"
#include "data/identification/effects/effect_list.h"
#include "data/identification/estimation/measured_push.h"
#include "data/identification/forward/insertion.h"
#include "data/identification/forward/misfit.h"
#include "data/identification/measurement/measurement_reader.h"

namespace ostium::data {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using units::mm;

/// Misfits of one run over their noise, and how many independent numbers they are.
struct Misfits {
  std::string id;
  VectorXd over_noise;
  double numbers = 0;
};

std::vector<Misfits> of_curves(const JsonValue& root) {
  const auto set = curves::read_set(curves::with_tables(root));
  if (!set->noise().declared) root.fail("its noise is not declared, so nothing says what is far off");
  std::vector<double> free;
  for (const EffectParameter& p : set->free()) free.push_back(p.prior);
  const std::vector<curves::Curves> predicted = set->predict(free, {});
  std::vector<Misfits> out;
  for (std::size_t r = 0; r < predicted.size(); ++r) {
    Misfits m{set->runs()[r].id, {}, 0};
    for (std::size_t c = 0; c < predicted[r].size(); ++c) {
      const curves::Channel& channel = set->runs()[r].channels[c];
      const VectorXd off = (channel.measured - predicted[r][c]).cwiseQuotient(channel.sigma);
      m.over_noise.conservativeResize(m.over_noise.size() + off.size());
      m.over_noise.tail(off.size()) = off;
    }
    m.numbers = static_cast<double>(m.over_noise.size());
    out.push_back(std::move(m));
  }
  return out;
}

std::vector<Misfits> of_shapes(const JsonValue& root) {
  const MeasurementSet set = read_measurement(*root.file, to_json(root));
  require_known(set);
  if (!set.imaging.noise_sigma_m) root.fail("its noise is not declared, so nothing says what is far off");
  if (set.imaging.registration_free || set.imaging.tip_offset_free)
    root.fail("its measuring frame or tracked point is free: a prediction of it has nothing to stand on");
  Changes declared;
  declared.effects = declared_effects(set);
  std::vector<StaticEquilibrium> anchors;
  std::vector<PredictedShape> inserted;
  if (set.vessel)
    inserted = insert(set, declared);
  else
    anchors = walk(set, declared);
  const std::optional<double> push_sigma = push_sigma_N(set);
  std::vector<Misfits> out;
  for (std::size_t i = 0; i < set.experiments.size(); ++i) {
    const Experiment& e = set.experiments[i];
    const ExperimentSetup setup = setup_of(set, e, declared);
    PredictedShape shape = set.vessel ? inserted[i] : shape_from(setup, anchors[i]);
    if (!set.vessel) add_later_views(set, e, declared, fine_elements_m, anchors[i], shape);
    if (!shape.converged) throw LoadError(no_static_shape(set, e, setup));
    Misfits m{e.id, misfit(e, shape, seen(set, e, declared, {})) / *set.imaging.noise_sigma_m,
              static_cast<double>(numbers_measured(e))};
    if (const auto push = push_misfit_N(e, shape); push && push_sigma) {
      m.over_noise.conservativeResize(m.over_noise.size() + 1);
      m.over_noise[m.over_noise.size() - 1] = *push / *push_sigma;
      m.numbers += 1;
    }
    out.push_back(std::move(m));
  }
  return out;
}

std::vector<Misfits> misfits_of(const JsonValue& root, const WireInSet& wire) {
  const JsonValue with = set_with(root, wire);
  return curves::kind_of(with) ? of_curves(with) : of_shapes(with);
}

VectorXd all_of(const std::vector<Misfits>& list) {
  Eigen::Index rows = 0;
  for (const Misfits& m : list) rows += m.over_noise.size();
  VectorXd out(rows);
  rows = 0;
  for (const Misfits& m : list) out.segment(rows, m.over_noise.size()) = m.over_noise, rows += m.over_noise.size();
  return out;
}

/// The wire with one of its numbers larger by its standard error.
struct OneOff {
  std::string what;
  WireInSet wire;
};

/// For each of the measured numbers. One estimate that covers several stretches moves them together.
std::vector<OneOff> one_error_off(const CharacterisedWire& wire) {
  std::vector<OneOff> out;
  const auto add = [&](const std::string& name, auto stiffness, auto change) {
    std::vector<const Combined*> done;
    for (const Stretch& s : wire.stretches) {
      const Combined& c = stiffness(s);
      const auto same = [&](const Combined* d) { return d->value == c.value && d->sets == c.sets; };
      if (!c.measured() || std::any_of(done.begin(), done.end(), same)) continue;
      done.push_back(&c);
      OneOff moved{"", in_set(wire)};
      double to_m = s.to_tip_m;
      for (std::size_t i = 0; i < moved.wire.stretches.size(); ++i)
        if (same(&stiffness(wire.stretches[i])))
          change(moved.wire.stretches[i], std::exp(c.sigma)), to_m = wire.stretches[i].to_tip_m;
      moved.what = fmt::format("{}, {:g} to {:g} mm from the tip", name, s.from_tip_m / mm, to_m / mm);
      out.push_back(std::move(moved));
    }
  };
  add(
      "EI", [](const Stretch& s) -> const Combined& { return s.EI_N_m2; },
      [](DeclaredStretch& s, double by) { s.EI_N_m2 *= by; });
  add(
      "GJ", [](const Stretch& s) -> const Combined& { return s.GJ_N_m2; },
      [](DeclaredStretch& s, double by) { s.GJ_N_m2 *= by; });
  if (wire.friction.measured()) {
    OneOff moved{"friction", in_set(wire)};
    *moved.wire.friction *= std::exp(wire.friction.sigma);
    out.push_back(std::move(moved));
  }
  return out;
}

}  // namespace

WireInSet in_set(const CharacterisedWire& wire) {
  WireInSet out;
  for (const Stretch& s : wire.stretches)
    out.stretches.push_back({s.from_tip_m, s.to_tip_m, s.EI_N_m2.value, s.GJ_N_m2.value});
  if (wire.friction.measured()) out.friction = wire.friction.value;
  return out;
}

WireCheck check(const JsonValue& root, const CharacterisedWire& wire,
                const std::function<void(const std::string&)>& progress) {
  const std::vector<Misfits> found = misfits_of(root, in_set(wire));
  const VectorXd r = all_of(found);
  double numbers = 0;
  WireCheck out;
  for (const Misfits& m : found) {
    out.runs.push_back({m.id, std::sqrt(m.over_noise.squaredNorm() / m.numbers)});
    numbers += m.numbers;
  }
  out.over_noise = std::sqrt(r.squaredNorm() / numbers);
  const std::vector<OneOff> moved = one_error_off(wire);
  MatrixXd D(r.size(), static_cast<Eigen::Index>(moved.size()));
  for (std::size_t k = 0; k < moved.size(); ++k) {
    if (progress) progress(fmt::format("what errors do: {} of {}", k + 1, moved.size()));
    D.col(static_cast<Eigen::Index>(k)) = all_of(misfits_of(root, moved[k].wire)) - r;
  }
  const VectorXd Dr = D.transpose() * r;
  const MatrixXd inner = MatrixXd::Identity(D.cols(), D.cols()) + D.transpose() * D;
  const VectorXd asked = -core::solve_symmetric(inner, Dr);
  out.beyond_errors = std::sqrt(std::max(r.squaredNorm() + Dr.dot(asked), 0.0) / numbers);
  for (std::size_t k = 0; k < moved.size(); ++k)
    out.moves.push_back({moved[k].what, asked[static_cast<Eigen::Index>(k)]});
  std::sort(out.moves.begin(), out.moves.end(),
            [](const AskedMove& a, const AskedMove& b) { return std::fabs(a.errors) > std::fabs(b.errors); });
  return out;
}

}  // namespace ostium::data
