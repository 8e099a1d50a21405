#include "data/picture/vessels.h"

#include <algorithm>
#include <cmath>

#include "data/picture/profile.h"

namespace ostium::data {

namespace {

using Eigen::Index, Eigen::Vector2d, Eigen::Vector2i;

constexpr double scales[] = {1.4, 2.0, 2.8, 4.0, 5.6};
constexpr double strong = 0.040, weak = 0.018;  // sigma^2 times the curvature of ln(grey)
constexpr int shortest_spur = 10, shortest_branch = 15, longest_bent = 40;

struct Ridges {
  Image strength, scale;
};

/// Curvature across, scaled, where it is a valley of grey on both sides (Lindeberg 1998, Int J Comput Vis 30:117).
Ridges ridges_of(const Image& image) {
  const Image j = image.max(6.0).log();
  Ridges out{Image::Zero(j.rows(), j.cols()), Image::Zero(j.rows(), j.cols())};
  for (double s : scales) {
    const Image xx = gaussian(j, s, 0, 2), yy = gaussian(j, s, 2, 0), xy = gaussian(j, s, 1, 1),
                smooth = gaussian(j, s);
    for (Index y = 0; y < j.rows(); ++y)
      for (Index x = 0; x < j.cols(); ++x) {
        const double middle = 0.5 * (xx(y, x) + yy(y, x)), half = std::hypot(0.5 * (xx(y, x) - yy(y, x)), xy(y, x));
        const double most = middle + half, least = middle - half;
        if (most <= 0 || std::fabs(least) >= 0.6 * most) continue;
        const double r = s * s * (most - std::max(least, 0.0));
        if (r <= weak || r <= out.strength(y, x)) continue;
        const double angle = 0.5 * std::atan2(2 * xy(y, x), xx(y, x) - yy(y, x)), k = 2.2 * s;
        const double dy = k * std::sin(angle), dx = k * std::cos(angle), yd = static_cast<double>(y),
                     xd = static_cast<double>(x);
        // A ridge falls off to both sides, an outline to one.
        if (std::min(sample(smooth, yd + dy, xd + dx), sample(smooth, yd - dy, xd - dx)) - smooth(y, x) < 0.9 * r)
          continue;
        out.strength(y, x) = r, out.scale(y, x) = s;
      }
  }
  return out;
}

/// Weak ridges that hang together with a strong one.
Mask kept(const Ridges& ridges, const Mask& inner) {
  const Parts parts = parts_of(ridges.strength > weak && inner);
  std::vector<bool> keep(static_cast<std::size_t>(parts.count) + 1, false);
  for (Index i = 0; i < inner.size(); ++i)
    if (inner.data()[i] && ridges.strength.data()[i] > strong)
      keep[static_cast<std::size_t>(parts.label.data()[i])] = true;
  keep[0] = false;
  Mask out(inner.rows(), inner.cols());
  for (Index i = 0; i < inner.size(); ++i) out.data()[i] = keep[static_cast<std::size_t>(parts.label.data()[i])];
  return closed(out) && inner;
}

std::vector<Vector2d> smoothed(const std::vector<Vector2i>& pixels) {
  std::vector<double> y, x;
  for (const Vector2i& p : pixels) y.push_back(p[0]), x.push_back(p[1]);
  y = gaussian(y, 3, false), x = gaussian(x, 3, false);
  std::vector<Vector2d> out;
  for (std::size_t i = 0; i < y.size(); ++i) out.emplace_back(y[i], x[i]);
  return out;
}

/// Length and turning of a line.
std::pair<double, double> length_and_turning(const std::vector<Vector2d>& line) {
  double length = 0, turning = 0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vector2d a = line[i] - line[i - 1];
    length += a.norm();
    if (i + 1 == line.size()) break;
    const Vector2d b = line[i + 1] - line[i];
    turning += std::fabs(std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b)));
  }
  return {length, turning};
}

}  // namespace

VesselTree find_vessels(const Image& image, const Mask& inner) {
  const Ridges ridges = ridges_of(image);
  const Mask mask = kept(ridges, inner), skeleton = pruned(thinned(mask), shortest_spur);
  const auto [parts, junctions] = branches_of(skeleton);
  VesselTree out;
  out.mask = dilated(mask && dilated(skeleton, 8), 4);
  out.length_px = 1.12 * static_cast<double>(skeleton.count());  // pixels on a slant are longer
  out.junctions = parts_of(dilated(junctions, 2)).count;
  std::vector<std::vector<Vector2i>> pixels(static_cast<std::size_t>(parts.count) + 1);
  for (int y = 0; y < inner.rows(); ++y)
    for (int x = 0; x < inner.cols(); ++x)
      if (parts.label(y, x)) pixels[static_cast<std::size_t>(parts.label(y, x))].push_back({y, x});
  double lengths = 0, turnings = 0;
  std::vector<Across> profiles;
  for (std::size_t b = 1; b < pixels.size(); ++b) {
    if (static_cast<int>(pixels[b].size()) < shortest_branch) continue;
    const std::vector<Vector2d> line = smoothed(in_order(pixels[b]));
    if (static_cast<int>(line.size()) >= longest_bent) {
      const auto [length, turning] = length_and_turning(line);
      lengths += length, turnings += turning;
    }
    for (std::size_t n = 4; n + 4 < line.size(); n += 6) {
      const Vector2d way = line[std::min(n + 4, line.size() - 1)] - line[n - 4];
      if (way.norm() < 1) continue;
      const double scale = ridges.scale(static_cast<Index>(line[n][0]), static_cast<Index>(line[n][1]));
      const Across a = across(image, line[n], way.normalized(), scale > 0 ? 10 + 3.5 * scale : 16);
      std::optional<Profile> profile = measure(a);
      if (!profile) continue;
      profile->branch = static_cast<int>(b);
      out.profiles.push_back(*profile), profiles.push_back(a);
    }
  }
  if (lengths > 0) out.bend_rad_px = turnings / lengths;
  // Blur of some vessels of about 3 mm.
  std::vector<std::size_t> of_3_mm;
  for (std::size_t i = 0; i < profiles.size(); ++i)
    if (const double w = out.profiles[i].width_px; w >= 8 && w <= 14) of_3_mm.push_back(i);
  for (std::size_t k = 0; k < of_3_mm.size(); k += std::max<std::size_t>(1, of_3_mm.size() / 16))
    out.profiles[of_3_mm[k]].blur_px = fitted_blur(profiles[of_3_mm[k]], out.profiles[of_3_mm[k]]);
  return out;
}

}  // namespace ostium::data
