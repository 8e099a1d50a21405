#include "data/identification/estimation/learned_law.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostium::data {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double step_in_spreads = 1e-2;

/// A form of the library, and how far the law is from it.
struct Form {
  double chi2 = std::numeric_limits<double>::infinity();
  std::size_t outside = 0;  ///< points that the data reach and whose band does not hold it
  std::string words;
};

/// The closest of the forms that `try_form` is given; it returns y at a point.
class Closest {
 public:
  explicit Closest(const LearnedLaw& law) : law_(law) {}
  template <class Y>
  void look(Y&& y, const std::string& words) {
    Form form{0, 0, words};
    for (std::size_t i = 0; i < law_.sigma.size(); ++i) {
      if (!law_.reached(i)) continue;
      const double off = std::fabs(law_.curve.points[i].y() - y(law_.curve.points[i].x())) / law_.sigma[i];
      form.chi2 += off * off, form.outside += off > band_sigmas;
    }
    if (form.chi2 < best_.chi2) best_ = form;
  }
  const Form& best() const { return best_; }

 private:
  const LearnedLaw& law_;
  Form best_;
};

std::size_t reached_points(const LearnedLaw& law) {
  std::size_t out = 0;
  for (std::size_t i = 0; i < law.sigma.size(); ++i) out += law.reached(i);
  return out;
}

/// A stretch of other stiffness on a constant, or a straight line between two constants.
void stiffness_forms(const LearnedLaw& law, Closest& closest) {
  const auto& points = law.curve.points;
  const double last = points.back().x();
  constexpr int places = 15;
  const auto mean = [&](double from, double to, bool inside) {
    double sum = 0, weight = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool in = points[i].x() >= from && points[i].x() <= to;
      if (in != inside || !law.reached(i)) continue;
      const double w = 1 / (law.sigma[i] * law.sigma[i]);
      sum += w * points[i].y(), weight += w;
    }
    return weight > 0 ? sum / weight : 1.0;
  };
  for (int a = 0; a < places; ++a)
    for (int b = a + 1; b <= places; ++b) {
      const double from = last * a / places, to = last * b / places;
      const double within = mean(from, to, true), beside = mean(from, to, false);
      closest.look([&](double x) { return x >= from && x <= to ? within : beside; },
                   fmt::format("soft_section: {:.2g} times the stiffness, {:.0f} to {:.0f} mm from the tip",
                               within / beside, from, to));
      const double before = mean(from, last, false), behind = mean(to, last, true);
      closest.look(
          [&](double x) { return before + (behind - before) * std::clamp((x - from) / (to - from), 0.0, 1.0); },
          fmt::format("taper: from {:.2g} to {:.2g} between {:.0f} and {:.0f} mm from the tip", before, behind, from,
                      to));
    }
}

/// The softening of core/material/superelastic.h.
void bending_forms(const LearnedLaw& law, Closest& closest) {
  const double last = law.curve.points.back().x();
  for (double at = last; at > last / 30; at *= 0.85)
    for (double ratio = 0.02; ratio < 0.99; ratio += 0.03)
      closest.look([&](double x) { return ratio + (1 - ratio) / std::sqrt(1 + x * x / (at * at)); },
                   fmt::format("superelastic_softening beyond {:.3g} {} to {:.2g}", at, law.curve.x_unit, ratio));
}

std::string form_of(const LearnedLaw& law) {
  Closest closest(law);
  if (law.curve.id == "law:stiffness")
    stiffness_forms(law, closest);
  else
    bending_forms(law, closest);
  const std::size_t points = reached_points(law);
  return points > 0 && 10 * closest.best().outside <= points ? closest.best().words : "";
}

}  // namespace

LearnedLaw with_band(const std::function<LawCurve(const VectorXd&)>& law, const VectorXd& x, const MatrixXd& covariance,
                     const VectorXd& prior_sigma) {
  LearnedLaw out;
  out.curve = law(x);
  const auto points = static_cast<Eigen::Index>(out.curve.points.size());
  MatrixXd slope(points, x.size());
  for (Eigen::Index p = 0; p < x.size(); ++p) {
    VectorXd up = x, down = x;
    const double step = step_in_spreads * prior_sigma[p];
    up[p] += step, down[p] -= step;
    const LawCurve above = law(up), below = law(down);
    for (Eigen::Index i = 0; i < points; ++i)
      slope(i, p) =
          (above.points[static_cast<std::size_t>(i)].y() - below.points[static_cast<std::size_t>(i)].y()) / (2 * step);
  }
  for (Eigen::Index i = 0; i < points; ++i) {
    const double now = slope.row(i) * covariance * slope.row(i).transpose(),
                 before = slope.row(i).cwiseProduct(prior_sigma.transpose()).squaredNorm();
    const auto k = static_cast<std::size_t>(i);
    const double too_fine = out.curve.too_fine.empty() ? 0 : out.curve.too_fine[k] * out.curve.points[k].y();
    out.sigma.push_back(std::sqrt(std::max(now, 0.0) + too_fine * too_fine));
    out.from_data.push_back(before > 0 ? std::clamp(1 - now / before, 0.0, 1.0) : 0);
  }
  out.looks_like = form_of(out);
  return out;
}

std::string in_words(const LearnedLaw& law) {
  const auto& points = law.curve.points;
  double least = std::numeric_limits<double>::infinity(), most = -least, from = least, to = most;
  std::vector<double> widths;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!law.reached(i)) continue;
    least = std::min(least, points[i].y()), most = std::max(most, points[i].y());
    from = std::min(from, points[i].x()), to = std::max(to, points[i].x());
    widths.push_back(band_sigmas * law.sigma[i] / std::fabs(points[i].y()));
  }
  if (widths.empty()) return fmt::format("{}: the data do not reach it; it is its prior.", law.curve.id);
  std::sort(widths.begin(), widths.end());
  std::string out = fmt::format(
      "{}: {} from {:.3g} to {:.3g}, known to {:.2g} % (half the band, median), for a {} of {:.3g} to {:.3g} {}{}.",
      law.curve.id, law.curve.y, least, most, 100 * widths[widths.size() / 2], law.curve.x, from, to, law.curve.x_unit,
      widths.size() < points.size() ? "; elsewhere it is its prior" : "");
  if (!law.looks_like.empty()) out += " It looks like " + law.looks_like + ".";
  return out;
}

}  // namespace ostium::data
