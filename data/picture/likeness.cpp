#include "data/picture/likeness.h"

#include <cmath>

#include "core/base/quantile.h"
#include "data/picture/background.h"
#include "data/picture/vessels.h"

namespace ostium::data {

namespace {

using Range = PictureNumber::Range;

/// Deviation from a straight line along a branch, relative to the mean; the median over branches of 8 profiles or more.
std::optional<double> scatter(const std::vector<Profile>& profiles, double Profile::*member) {
  std::map<int, std::vector<double>> branches;
  for (const Profile& p : profiles) branches[p.branch].push_back(p.*member);
  std::vector<double> out;
  for (const auto& [branch, y] : branches) {
    const auto n = static_cast<double>(y.size());
    if (n < 8) continue;
    const double middle = mean(y), at = 0.5 * (n - 1);
    double up = 0, across = 0, left = 0;
    for (std::size_t i = 0; i < y.size(); ++i)
      up += (static_cast<double>(i) - at) * (y[i] - middle), across += std::pow(static_cast<double>(i) - at, 2);
    for (std::size_t i = 0; i < y.size(); ++i)
      left += std::pow(y[i] - middle - up / across * (static_cast<double>(i) - at), 2);
    out.push_back(std::sqrt(left / n) / middle);
  }
  if (out.empty()) return {};
  return core::median(out);
}

void add_vessels(const VesselTree& tree, Likeness& out) {
  out["skeleton_px"] = tree.length_px;
  out["junctions"] = tree.junctions;
  if (tree.bend_rad_px > 0) out["bend_rad_per_px"] = tree.bend_rad_px;
  if (tree.profiles.size() < 8) return;
  std::vector<double> contrast, of_3_mm, blur;
  for (const Profile& p : tree.profiles) {
    contrast.push_back(std::log(p.background / std::max(p.background - p.depth, 2.0)));
    if (p.width_px < 8 || p.width_px > 14) continue;  // about 3 mm at 0.25 to 0.3 mm a pixel
    of_3_mm.push_back(contrast.back());
    if (p.blur_px) blur.push_back(*p.blur_px);
  }
  out["lncontrast_p50"] = core::median(contrast);
  if (of_3_mm.size() >= 4) {
    out["v3_lncontrast"] = core::median(of_3_mm);
    if (blur.size() >= 3) out["v3_blur_px"] = core::median(blur);
  }
  if (const auto s = scatter(tree.profiles, &Profile::width_px)) out["width_scatter"] = *s;
  if (const auto s = scatter(tree.profiles, &Profile::depth)) out["depth_scatter"] = *s;
}

LikenessVerdict judge(const Likeness& numbers, std::optional<Range> PictureNumber::*range) {
  LikenessVerdict out;
  for (const PictureNumber& n : picture_numbers()) {
    if (!(n.*range)) continue;
    ++out.ranges;
    const auto found = numbers.find(n.name);
    if (found != numbers.end() && (n.*range)->holds(found->second))
      ++out.held;
    else
      out.misses.push_back(n.name);
  }
  return out;
}

}  // namespace

const std::vector<PictureNumber>& picture_numbers() {
  static const std::vector<PictureNumber> numbers = {
      {"p50", "median grey", Range{70, 145}, Range{94, 131}},
      {"p25", "grey, lower quartile", {}, Range{78, 113}},
      {"grad_median_rel", "median gradient, % of the spread of grey a pixel", Range{0.53, 1.4}, Range{0.60, 1.15}},
      {"texture_ratio", "detail of 4 to 8 px against 16 to 32 px", Range{0.28, 0.57}, Range{0.34, 0.51}},
      {"grad_p99_over_median", "sharpest edges against the median gradient", Range{0, 8}, Range{4.5, 7.5}},
      {"band32_mad", "detail of 16 to 32 px, grey", {}, Range{2.1, 3.6}},
      {"psd_slope_noise", "slope of the noise's spectrum", Range{-4.1, -2.1}, Range{-3.9, -2.35}},
      {"noise_rel", "noise, % of grey", {}, Range{0.9, 3.1}},
      {"grain", "correlation of noise with the next pixel", {}, Range{0.42, 0.65}},
      {"noise_dark_over_light", "noise in dark against light parts", Range{0.9, 1.75}, Range{1.0, 1.5}},
      {"border_sides", "sides with a collimator's edge", Range{2, 4}, {}},
      {"lncontrast_p50", "ln contrast of vessels", Range{0.115, 0.31}, Range{0.14, 0.22}},
      {"v3_lncontrast", "ln contrast of 3 mm vessels", Range{0.12, 0.51}, Range{0.16, 0.33}},
      {"v3_blur_px", "blur of 3 mm vessels, px", {}, Range{0.65, 1.85}},
      {"width_scatter", "unevenness of width along a vessel", {}, Range{0.053, 0.23}},
      {"depth_scatter", "unevenness of depth along a vessel", {}, Range{0.078, 0.21}},
      {"bend_rad_per_px", "winding of vessels, rad a pixel", {}, Range{0.016, 0.028}},
      {"skeleton_px", "length of visible vessels, px", {}, Range{1480, 3300}},
      {"junctions", "visible divisions", {}, Range{38, 110}},
  };
  return numbers;
}

Likeness measure_likeness(const Image& picture) {
  const Image image = to_measured_side(picture);
  const Eigen::Index n = image.rows(), margin = n / 10;  // collimator and penumbra
  Mask inner = Mask::Constant(n, n, false);
  inner.block(margin, margin, n - 2 * margin, n - 2 * margin).setConstant(true);
  Likeness out;
  const std::vector<double> grey = values_in(image, inner);
  out["p25"] = core::quantile(grey, 0.25), out["p50"] = core::median(grey);
  const VesselTree tree = find_vessels(image, inner);
  add_vessels(tree, out);
  const Background b = measure_background(image, tree.mask, inner);
  out["grad_median_rel"] = b.grad_median_rel, out["grad_p99_over_median"] = b.grad_p99_over_median;
  out["texture_ratio"] = b.texture_ratio, out["band32_mad"] = b.band32_mad;
  out["psd_slope_noise"] = b.psd_slope_noise;
  if (const Grain g = measure_grain(image, inner && !tree.mask); g.enough)
    out["noise_rel"] = g.noise_rel, out["grain"] = g.grain, out["noise_dark_over_light"] = g.noise_dark_over_light;
  out["border_sides"] = border_sides(image);
  return out;
}

Likeness median_of(const std::vector<Likeness>& pictures) {
  Likeness out;
  for (const PictureNumber& n : picture_numbers()) {
    std::vector<double> values;
    for (const Likeness& one : pictures)
      if (const auto found = one.find(n.name); found != one.end()) values.push_back(found->second);
    if (!values.empty()) out[n.name] = core::median(values);
  }
  return out;
}

LikenessVerdict judge_frame(const Likeness& numbers) { return judge(numbers, &PictureNumber::of_frame); }
LikenessVerdict judge_set(const Likeness& medians) { return judge(medians, &PictureNumber::of_set); }

}  // namespace ostium::data
