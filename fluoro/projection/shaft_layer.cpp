#include "fluoro/projection/shaft_layer.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ostium::fluoro {

namespace {

/// Integral of sqrt(1 - x^2) from 0, tabulated.
class HalfDisc {
 public:
  HalfDisc() {
    for (int i = 0; i <= steps; ++i) {
      const double x = double(i) / steps;
      table_[std::size_t(i)] = 0.5 * (x * std::sqrt(1 - x * x) + std::asin(x));
    }
    table_[steps + 1] = table_[steps];
  }
  double operator()(double x) const {
    const double at = std::min(std::fabs(x), 1.0) * steps;
    const auto i = static_cast<std::size_t>(at);
    return std::copysign(table_[i] + (at - double(i)) * (table_[i + 1] - table_[i]), x);
  }

 private:
  static constexpr int steps = 1024;
  std::array<double, steps + 2> table_;
};

/// Chord of a rod at distance d, averaged over a pixel of that width.
double mean_chord(double radius, double d, double width) {
  static const HalfDisc half_disc;
  if (radius <= 0) return 0;
  return 2 * radius * radius * (half_disc((d + 0.5 * width) / radius) - half_disc((d - 0.5 * width) / radius)) / width;
}

/// The same of a rod that moves that far across.
double mean_chord(double radius, double d, double width, double sweep) {
  const int samples = sweep > 0 ? 1 + static_cast<int>(2 * sweep / width) : 1;
  double sum = 0;
  for (int i = 0; i < samples; ++i) sum += mean_chord(radius, d + sweep * ((i + 0.5) / samples - 0.5), width);
  return sum / samples;
}

/// A point of the axis.
struct Node {
  Eigen::Vector2d at;                             // in the picture: pixels, centres at one half
  Eigen::Vector3d ray;                            // from the source
  double pixel_m = 0;                             // width of a pixel at this depth
  double along_m = 0;                             // from the tip
  Eigen::Vector2d way = Eigen::Vector2d::Zero();  // that it goes during the pulse, pixels
};

struct Ring {
  double outer = 0, inner = 0, filling = 1;
  PerEnergy mu{};  // 1/m
};

/// A piece of a ring-shaped section: its ends, and at each end the direction along which pixels are shared with its
/// neighbour.
struct Piece {
  Node from, to;
  Eigen::Vector2d split_from, split_to;
};

class Painter {
 public:
  Painter(const View& view, ShaftLayer& out) : view_(view), axes_(view.arm), p_PS_(source(view.arm)), out_(out) {}

  std::optional<Node> node(const Eigen::Vector3d& p_P, double along_m, const Eigen::Vector3d& way_P) const {
    const Eigen::Vector3d ray = p_P - p_PS_;
    const double depth = ray.dot(axes_.outwards);
    if (depth < 0.05) return {};
    const double scale = view_.arm.source_to_detector_m / view_.field_m * view_.pixels / depth;  // pixels per metre
    return Node{{0.5 * view_.pixels + scale * ray.dot(axes_.right), 0.5 * view_.pixels - scale * ray.dot(axes_.up)},
                ray,
                1 / scale,
                along_m,
                {scale * way_P.dot(axes_.right), -scale * way_P.dot(axes_.up)}};
  }

  /// All rings cover the same pixels: their common part is computed once.
  void paint(const Piece& piece, std::span<const Ring> rings) {
    double outermost = 0;
    for (const Ring& ring : rings) outermost = std::max(outermost, ring.outer);
    const Eigen::Vector2d run = piece.to.at - piece.from.at;
    const Eigen::Vector3d axis = piece.to.ray - piece.from.ray, ray = (piece.from.ray + piece.to.ray).normalized();
    const double pixel_m = 0.5 * (piece.from.pixel_m + piece.to.pixel_m);
    const double across_ray_m = std::max((axis - axis.dot(ray) * ray).norm(), 0.02 * pixel_m);
    const double longer = axis.norm() / across_ray_m;
    const Eigen::Vector2d along = run.norm() > 1e-9 ? Eigen::Vector2d(run.normalized()) : piece.split_from;
    const Eigen::Vector2d beside(-along.y(), along.x());
    const Eigen::Vector2d way = 0.5 * (piece.from.way + piece.to.way);
    const double sweep_m = std::fabs(way.dot(beside)) * pixel_m, ramp = 1 + std::fabs(way.dot(along));
    const double reach = outermost / pixel_m + 1 + 0.5 * way.norm();  // pixels
    const auto bound = [&](double a, double b, double by) {
      return std::pair(std::max(0, int(std::floor(std::min(a, b) - by))),
                       std::min(view_.pixels - 1, int(std::ceil(std::max(a, b) + by))));
    };
    const auto [left, right] = bound(piece.from.at.x(), piece.to.at.x(), reach);
    const auto [top, bottom] = bound(piece.from.at.y(), piece.to.at.y(), reach);
    for (int row = top; row <= bottom; ++row) {
      // Only columns within reach of the axis.
      int first = left, last = right;
      if (std::fabs(beside.x()) > 1e-3) {
        const double axis_column = piece.from.at.x() - (row + 0.5 - piece.from.at.y()) * beside.y() / beside.x();
        const double off = reach / std::fabs(beside.x());
        first = std::max(first, static_cast<int>(std::floor(std::max(axis_column - off, -1.0))));
        last = std::min(last, static_cast<int>(std::ceil(std::min(axis_column + off, double(view_.pixels)))));
      }
      if (first > last) continue;
      ShaftLayer::Touched& touched = out_.touched[std::size_t(row)];
      touched = touched.from == touched.to
                    ? ShaftLayer::Touched{first, last + 1}
                    : ShaftLayer::Touched{std::min(touched.from, first), std::max(touched.to, last + 1)};
      for (int column = first; column <= last; ++column) {
        const Eigen::Vector2d pixel(column + 0.5, row + 0.5);
        const double share = share_beyond(pixel - piece.from.at, piece.split_from, ramp) -
                             share_beyond(pixel - piece.to.at, piece.split_to, ramp);
        if (!(share > 0)) continue;
        const double d = (pixel - piece.from.at).dot(beside) * pixel_m;
        for (const Ring& ring : rings) {
          if (std::fabs(d) > ring.outer + 0.5 * (pixel_m + sweep_m)) continue;
          const double chord =
              mean_chord(ring.outer, d, pixel_m, sweep_m) - mean_chord(ring.inner, d, pixel_m, sweep_m);
          const auto m = static_cast<float>(share * longer * ring.filling * chord);
          for (std::size_t b = 0; b < energies; ++b) out_.optical_depth[b](row, column) += m * ring.mu[b];
        }
      }
    }
  }

 private:
  /// The share of a pixel beyond a line across `direction`: a ramp so many pixels long, one and the way along it.
  static double share_beyond(const Eigen::Vector2d& from_line, const Eigen::Vector2d& direction, double ramp) {
    return std::clamp(from_line.dot(direction) / ramp + 0.5, 0.0, 1.0);
  }

  const View& view_;
  ImageAxes axes_;
  Eigen::Vector3d p_PS_;
  ShaftLayer& out_;
};

Eigen::Vector2d direction(const Node& from, const Node& to, const Eigen::Vector2d& otherwise) {
  const Eigen::Vector2d run = to.at - from.at;
  return run.norm() > 1e-9 ? Eigen::Vector2d(run.normalized()) : otherwise;
}

Node between(const Node& a, const Node& b, double along_m) {
  const double t = (along_m - a.along_m) / (b.along_m - a.along_m);
  return {a.at + t * (b.at - a.at), a.ray + t * (b.ray - a.ray), a.pixel_m + t * (b.pixel_m - a.pixel_m), along_m,
          a.way + t * (b.way - a.way)};
}

using Nodes = std::vector<std::optional<Node>>;

Nodes nodes_of(const Shaft& shaft, const Painter& painter, double pulse_s) {
  Nodes nodes;
  double along = 0;
  for (Eigen::Index i = 0; i < shaft.p_P.cols(); ++i) {
    if (i) along += (shaft.p_P.col(i) - shaft.p_P.col(i - 1)).norm();
    const bool moves = shaft.v_P.size() > 0;
    nodes.push_back(painter.node(shaft.p_P.col(i), along,
                                 moves ? Eigen::Vector3d(pulse_s * shaft.v_P.col(i)) : Eigen::Vector3d::Zero()));
  }
  return nodes;
}

/// Normal of the line that divides pixels: at a joint the mean direction of the two pieces, at an end `own`, the
/// piece's direction.
Eigen::Vector2d split_at(const Nodes& nodes, std::size_t joint, const Eigen::Vector2d& own) {
  if (joint == 0 || joint + 1 == nodes.size() || !nodes[joint - 1] || !nodes[joint + 1]) return own;
  const Eigen::Vector2d sum =
      direction(*nodes[joint - 1], *nodes[joint], own) + direction(*nodes[joint], *nodes[joint + 1], own);
  return sum.norm() > 0.2 ? Eigen::Vector2d(sum.normalized()) : own;
}

/// The contents of the bore between two points; outer radius 0 if there are none.
Ring bore_of(const Beam& beam, const Shaft& shaft, Eigen::Index from) {
  if (shaft.lumen_iodine_kg_m3.size() == 0) return {};
  const double kg_m3 = 0.5 * (shaft.lumen_iodine_kg_m3[from] + shaft.lumen_iodine_kg_m3[from + 1]);
  if (!(kg_m3 > 0)) return {};
  Ring bore{shaft.lumen_radius_m, 0, 1, beam.mu(Material::iodine)};
  for (float& m : bore.mu) m *= static_cast<float>(kg_m3);
  return bore;
}

void draw_shaft(const Beam& beam, const Shaft& shaft, double pulse_s, Painter& painter) {
  const Nodes nodes = nodes_of(shaft, painter, pulse_s);
  std::vector<Ring> whole;  // rings that run through the whole piece
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    if (!nodes[i] || !nodes[i + 1] || !(nodes[i + 1]->along_m > nodes[i]->along_m)) continue;
    const Node &a = *nodes[i], &b = *nodes[i + 1];
    const Eigen::Vector2d own = direction(a, b, Eigen::Vector2d::UnitX());
    const Eigen::Vector2d split_a = split_at(nodes, i, own), split_b = split_at(nodes, i + 1, own);
    whole.clear();
    if (const Ring bore = bore_of(beam, shaft, static_cast<Eigen::Index>(i)); bore.outer > 0) whole.push_back(bore);
    for (const OpaqueSection& s : shaft.sections) {
      const double from = std::max(a.along_m, s.from_tip_m), to = std::min(b.along_m, s.to_tip_m);
      if (!(to > from)) continue;
      const Ring ring{s.outer_radius_m, s.inner_radius_m, s.filling, beam.mu(s.material)};
      const bool cut_a = from > a.along_m, cut_b = to < b.along_m;
      if (!cut_a && !cut_b)
        whole.push_back(ring);
      else
        painter.paint({cut_a ? between(a, b, from) : a, cut_b ? between(a, b, to) : b, cut_a ? own : split_a,
                       cut_b ? own : split_b},
                      {&ring, 1});
    }
    if (!whole.empty()) painter.paint({a, b, split_a, split_b}, whole);
  }
}

}  // namespace

void ShaftLayer::resize(int pixels) {
  for (Plane& plane : optical_depth) plane.setZero(pixels, pixels);
  touched.assign(std::size_t(pixels), {});
}

void ShaftLayer::draw(const View& view, const Beam& beam, std::span<const Shaft> shafts, double pulse_s) {
  if (optical_depth[0].rows() != view.pixels) resize(view.pixels);
  for (std::size_t row = 0; row < touched.size(); ++row) {
    const int from = touched[row].from, count = touched[row].to - from;
    for (Plane& plane : optical_depth) plane.row(Eigen::Index(row)).segment(from, count).setZero();
    touched[row] = {};
  }
  Painter painter(view, *this);
  for (const Shaft& shaft : shafts) draw_shaft(beam, shaft, pulse_s, painter);
}

}  // namespace ostium::fluoro
