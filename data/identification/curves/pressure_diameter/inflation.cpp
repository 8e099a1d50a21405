// Boost's pchip.hpp takes isnan from here.
#include <math.h>  // NOLINT(modernize-deprecated-headers)

#include <algorithm>
#include <boost/math/interpolators/pchip.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "data/identification/curves/pressure_diameter/pressure_diameter.h"

namespace ostium::data::pressure_diameter {

namespace {

using Eigen::VectorXd;

double wall_Pa(const Vessel& vessel, double counter_Pa, double diameter_m) {
  double out = counter_Pa + vessel.stiffness_Pa * (diameter_m - vessel.rest_m) / vessel.healthy_m;
  const double x = diameter_m / vessel.healthy_m;
  if (x > 1) out += vessel.media_Pa * (std::exp(std::min(30.0, vessel.media_k * (x * x - 1))) - 1);
  return out;
}

/// Of the middle, with pressure `true_Pa`; `grown`: the balloon's size by creep.
double held_m(const Setup& setup, const Vessel* vessel, double true_Pa, double grown) {
  const auto balloon = [&](double net_Pa) {
    return grown * (setup.chart_scale * setup.chart(net_Pa) + setup.chart_more_m);
  };
  const double free = balloon(true_Pa);
  if (!vessel || free <= vessel->rest_m) return free;
  const auto off = [&](double d) { return balloon(true_Pa - wall_Pa(*vessel, setup.counter_Pa, d)) - d; };
  const double at_rest = off(vessel->rest_m), at_free = off(free);
  if (at_rest <= 0) return vessel->rest_m;
  if (at_free >= 0) return free;
  std::uintmax_t most = 60;
  const auto [low, high] = boost::math::tools::toms748_solve(off, vessel->rest_m, free, at_rest, at_free,
                                                             boost::math::tools::eps_tolerance<double>(40), most);
  return (low + high) / 2;
}

/// Of the middle, over an inflation.
VectorXd diameter_m(const Setup& setup, const Inflation& run) {
  const Vessel* vessel = run.vessel < 0 ? nullptr : &setup.vessels[static_cast<std::size_t>(run.vessel)];
  VectorXd out(run.time_s.size());
  double grown = 1, largest = 0, pressed_Pa = 0;
  for (Eigen::Index k = 0; k < out.size(); ++k) {
    const double p = run.pressure_Pa[k] + setup.gauge_Pa;
    if (k > 0)
      grown += setup.creep_per_Pa_s * (run.time_s[k] - run.time_s[k - 1]) *
               (std::max(run.pressure_Pa[k], 0.0) + std::max(run.pressure_Pa[k - 1], 0.0)) / 2;
    out[k] = held_m(setup, vessel, p, grown);
    if (out[k] >= largest) {
      largest = out[k], pressed_Pa = p;
    } else if (run.stented) {
      const double left = pressed_Pa > 0 ? std::clamp(p / pressed_Pa, 0.0, 1.0) : 1;
      out[k] = std::max(out[k], largest * (1 - setup.recoil * (1 - left)));
    }
  }
  return out;
}

}  // namespace

Chart::Chart(std::vector<double> pressure_Pa, std::vector<double> diameter_m) {
  least_ = pressure_Pa.front(), most_ = pressure_Pa.back();
  at_least_ = diameter_m.front(), at_most_ = diameter_m.back();
  const auto curve = std::make_shared<boost::math::interpolators::pchip<std::vector<double>>>(std::move(pressure_Pa),
                                                                                              std::move(diameter_m));
  inside_ = [curve](double p) { return (*curve)(p); };
  prime_ = [curve](double p) { return curve->prime(p); };
  slope_least_ = prime_(least_), slope_most_ = prime_(most_);
}

double Chart::operator()(double p) const {
  if (p <= least_) return at_least_ + (p - least_) * slope_least_;
  return p >= most_ ? at_most_ + (p - most_) * slope_most_ : inside_(p);
}

double Chart::slope(double p) const { return prime_(std::clamp(p, least_, most_)); }

std::vector<curves::Curves> diameters(const Setup& setup) {
  std::vector<curves::Curves> out;
  for (const Inflation& run : setup.inflations) {
    const VectorXd middle = diameter_m(setup, run);
    out.emplace_back();
    for (const double place : setup.place_m)
      out.back().push_back((middle.array() + setup.taper * place).matrix() / 1e-3);
  }
  return out;
}

}  // namespace ostium::data::pressure_diameter
