/// A rasteriser for path lengths only. Each triangle is cut into spans of pixel centres; a span adds depth where rays
/// exit and subtracts it where they enter.
///
/// No gaps between triangles: the crossing of a row of pixel centres with an edge is computed from the upper end of
/// that edge, so that both its triangles get the same bits, and a span's sign depends on which of its two crossings is
/// on the left. So entries and exits of a closed surface cancel exactly in every pixel.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "fluoro/projection/path_lengths.h"

namespace ostium::fluoro {

namespace {

/// A vertex on the picture: column and row in pixels (centres at one half), depth from the source.
struct Corner {
  double x, y;
  float depth;
};

/// Contrast of a vertex: concentration times depth from its centreline, and the integral along that, kg/m2.
using Filling = float;

/// value = at + per_x column + per_y row, in whole pixels.
struct Linear {
  double at = 0, per_x = 0, per_y = 0;
  double operator()(int column, int row) const { return at + per_x * column + per_y * row; }
};

struct Slopes {
  double x1, y1, x2, y2, over_area;  // of two edges

  Slopes(const Corner& a, const Corner& b, const Corner& c)
      : x1(b.x - a.x), y1(b.y - a.y), x2(c.x - a.x), y2(c.y - a.y) {
    const double area = x1 * y2 - x2 * y1;
    over_area = std::fabs(area) > 1e-9 ? 1 / area : 0;  // for a sliver: constant, the first corner's value
  }

  Linear through(const Corner& a, double va, double vb, double vc) const {
    const double per_x = ((vb - va) * y2 - (vc - va) * y1) * over_area;
    const double per_y = ((vc - va) * x1 - (vb - va) * x2) * over_area;
    return {va - per_x * (a.x - 0.5) - per_y * (a.y - 0.5), per_x, per_y};
  }
};

/// Where an edge crosses the middle of a row; bit-identical for both triangles.
struct Edge {
  double x, y, slope;
  Edge(const Corner& upper, const Corner& lower)
      : x(upper.x), y(upper.y), slope((lower.x - upper.x) / (lower.y - upper.y)) {}
  double crossing(int row) const { return x + slope * (row + 0.5 - y); }
};

/// Also of what is no number: 0.
int first_centre_from(double position, double pixels) {
  const double centre = std::ceil(position - 0.5), positive = centre > 0 ? centre : 0;
  return static_cast<int>(positive < pixels ? positive : pixels);
}

/// The first row and column of pixel centres at or after a vertex.
struct Cell {
  std::int16_t row, column;
};

/// Whether a triangle can contain a pixel centre. Most triangles of a fine mesh cannot, and are rejected here.
bool meets_a_centre(Cell a, Cell b, Cell c) {
  const auto differ = [](int x, int y, int z) { return x != y || y != z; };
  return differ(a.row, b.row, c.row) && differ(a.column, b.column, c.column);
}

/// Calls span(row, from, to, sign) for each row; sign is +1 where the ray exits: the triangle is anticlockwise in the
/// picture.
template <typename Span>
void for_each_span(const Corner& a, const Corner& b, const Corner& c, int pixels, Span&& span) {
  const Corner* top = &a;
  const Corner* middle = &b;
  const Corner* bottom = &c;
  float parity = 1;
  const auto order = [&](const Corner*& upper, const Corner*& lower) {
    if (lower->y < upper->y) {
      std::swap(upper, lower);
      parity = -parity;
    }
  };
  order(top, middle);
  order(middle, bottom);
  order(top, middle);
  const int first = first_centre_from(top->y, pixels), last = first_centre_from(bottom->y, pixels);
  if (first >= last) return;
  const int turn = first_centre_from(middle->y, pixels);
  const Edge whole(*top, *bottom);
  const auto rows = [&](int from, int to, const Edge& broken) {
    for (int row = from; row < to; ++row) {
      const int l = first_centre_from(whole.crossing(row), pixels), r = first_centre_from(broken.crossing(row), pixels);
      if (l < r) span(row, l, r, -parity);
      if (r < l) span(row, r, l, parity);
    }
  };
  if (first < turn) rows(first, turn, Edge(*top, *middle));
  if (turn < last) rows(turn, last, Edge(*middle, *bottom));
}

using Four = Eigen::Array4f;
using Eight = Eigen::Array<float, 8, 1>;  // two pixels fill one register and need one store

/// Adds first, first + step, first + 2 step ... to n pixels.
void add_ramp(float* pixel, int n, const Four& first, const Four& step) {
  if (n == 1) {
    Eigen::Map<Four>(pixel) += first;
    return;
  }
  Eight value, by;
  value << first, first + step;
  by << 2 * step, 2 * step;
  for (; n >= 2; n -= 2, pixel += 8) {
    Eigen::Map<Eight>(pixel) += value;
    value += by;
  }
  if (n) Eigen::Map<Four>(pixel) += value.head<4>();
}

/// A triangle of fewer millimetres of depth is drawn with a depth that is linear in the picture, rather than its
/// inverse: off by a quarter of the square of this over the distance, 1.3 um.
constexpr float flat_m = 2e-3f;

class ScanlineRenderer final : public PathLengthRenderer {
 public:
  void add(const View& view, std::span<const Body> bodies, PathLengths& out, Parts parts) override {
    isocentre_ = view.arm.source_to_isocentre_m;
    for (const Body& body : bodies) {
      const Tissue net{body.tissue.soft - body.within.soft, body.tissue.bone - body.within.bone};
      const bool has_tissue = net.soft != 0 || net.bone != 0, filled = parts != Parts::still && is_seen(body.contrast);
      const auto all = static_cast<int>(body.triangles->cols());
      const int still = parts == Parts::all ? 0 : body.still, first = parts == Parts::still ? 0 : still,
                last = parts == Parts::still ? still : all;
      if (first == last || (!has_tissue && !filled)) continue;
      project(view, body, still > 0 && parts == Parts::moving && !filled ? body.corners.get() : nullptr);
      if (filled) project_contrast(view, body);
      // An entry or exit is counted where its tissue is drawn; where there is none, with its contrast.
      if (has_tissue && filled) draw<true, true>(body, first, last, net, 1, out);
      if (has_tissue && !filled) draw<true, false>(body, first, last, net, 1, out);
      if (!has_tissue) draw<false, true>(body, first, last, net, 1, out);
      if (has_tissue && filled && first > 0) draw<false, true>(body, 0, first, net, 0, out);
    }
  }

  const char* name() const override { return "scanline"; }

 private:
  static constexpr float nearest_m = 0.05f;  // no part of a patient is nearer to the source

  /// All vertices, or those listed. Each comes out with the same bits in any list: no operations are fused.
  void project(const View& view, const Body& body, const std::vector<int>* listed) {
    constexpr int block = 128;
    const ImageAxes axes(view.arm);
    const Eigen::Vector3d s = source(view.arm), &r = axes.right, &u = axes.up, &o = axes.outwards;
    const double scale = view.arm.source_to_detector_m / view.field_m * view.pixels, half = 0.5 * view.pixels,
                 pixels = view.pixels;
    const std::size_t vertices = static_cast<std::size_t>(body.p_P.cols()), count = listed ? listed->size() : vertices;
    corners_.resize(vertices);
    cells_.resize(vertices);
    std::array<double, block> x, y, z, depth;
    std::array<std::int32_t, block> row, column;
    for (std::size_t begin = 0; begin < count; begin += block) {
      const int n = static_cast<int>(std::min<std::size_t>(block, count - begin));
      const auto vertex = [&](int i) {
        const std::size_t k = begin + static_cast<std::size_t>(i);
        return listed ? static_cast<std::size_t>((*listed)[k]) : k;
      };
      for (int i = 0; i < n; ++i) {
        const float* const p = body.p_P.data() + 3 * vertex(i);
        x[i] = p[0], y[i] = p[1], z[i] = p[2];
      }
      for (int i = 0; i < n; ++i) {
        const double a = x[i] - s[0], b = y[i] - s[1], c = z[i] - s[2];
        depth[i] = a * o[0] + b * o[1] + c * o[2];
        const double over = scale / depth[i];
        x[i] = half + over * (a * r[0] + b * r[1] + c * r[2]);
        y[i] = half - over * (a * u[0] + b * u[1] + c * u[2]);
        column[i] = first_centre_from(x[i], pixels);
        row[i] = first_centre_from(y[i], pixels);
      }
      for (int i = 0; i < n; ++i) {
        corners_[vertex(i)] = {x[i], y[i], static_cast<float>(depth[i])};
        cells_[vertex(i)] = {static_cast<std::int16_t>(row[i]), static_cast<std::int16_t>(column[i])};
      }
    }
  }

  void project_contrast(const View& view, const Body& body) {
    const Eigen::Vector3f outwards = towards_detector(view.arm).cast<float>();
    const Contrast& c = body.contrast;
    fillings_.resize(corners_.size());
    for (Eigen::Index i = 0; i < body.p_P.cols(); ++i) {
      float& filling = fillings_[static_cast<std::size_t>(i)];
      filling = c.iodine_kg_m3[i] > 0 ? c.iodine_kg_m3[i] * outwards.dot(body.p_P.col(i) - c.p_PC.col(i)) : 0.0f;
      if (c.along_kg_m2.size() > 0) filling += outwards.dot(c.along_kg_m2.col(i));
    }
  }

  template <bool has_tissue, bool filled>
  void draw(const Body& body, int first, int last, Tissue net, float counted, PathLengths& out) {
    for (int n = first; n < last; ++n) {
      const auto t = body.triangles->col(n);
      const auto i = std::size_t(t[0]), j = std::size_t(t[1]), k = std::size_t(t[2]);
      if (!meets_a_centre(cells_[i], cells_[j], cells_[k])) continue;
      const Corner &a = corners_[i], &b = corners_[j], &c = corners_[k];
      const auto [least, most] = std::minmax({a.depth, b.depth, c.depth});
      if (least < nearest_m) continue;
      if (has_tissue && most - least > flat_m) {
        add_deep(a, b, c, net, counted, out);
        if (filled) add_flat<false, true>(a, b, c, {fillings_[i], fillings_[j], fillings_[k]}, net, 0, out);
      } else {
        add_flat<has_tissue, filled>(a, b, c, filled ? Three{fillings_[i], fillings_[j], fillings_[k]} : Three{}, net,
                                     counted, out);
      }
    }
  }

  using Three = std::array<float, 3>;

  /// What is crossed is linear in the picture. Vessels are finely meshed: that holds for their contrast to a
  /// thousandth.
  template <bool has_tissue, bool filled>
  void add_flat(const Corner& a, const Corner& b, const Corner& c, const Three& filling, Tissue net, float counted,
                PathLengths& out) {
    const Slopes slopes(a, b, c);
    const Linear depth = has_tissue ? slopes.through(a, a.depth, b.depth, c.depth) : Linear{};
    const Linear iodine = filled ? slopes.through(a, filling[0], filling[1], filling[2]) : Linear{};
    // Of a sliver the slopes are steep and what is rounded matters: nothing beyond the corners' values is added.
    const auto [near, far] = std::minmax({a.depth, b.depth, c.depth});
    const auto [few, many] = std::minmax({filling[0], filling[1], filling[2]});
    const float near_ = near, far_ = far, few_ = few, many_ = many;
    const auto isocentre = static_cast<float>(isocentre_);
    const int side = out.side();
    float* const pixels = out.pixels().data();
    const auto per_x = static_cast<float>(depth.per_x), iodine_per_x = static_cast<float>(iodine.per_x);
    const Four step(net.soft * per_x, net.bone * per_x, iodine_per_x, 0);
    // Captured by value, so that the compiler need not reload them after each store into a pixel.
    for_each_span(a, b, c, side, [=](int row, int from, int to, float sign) {
      Four first(0, 0, 0, counted);
      if (has_tissue) {
        const float m = std::clamp(static_cast<float>(depth(from, row)), near_, far_) - isocentre;
        first[0] = net.soft * m, first[1] = net.bone * m;
      }
      if (filled) first[2] = std::clamp(static_cast<float>(iodine(from, row)), few_, many_);
      add_ramp(pixels + 4 * (std::ptrdiff_t(row) * side + from), to - from, sign * first, sign * step);
    });
  }

  /// The inverse of the depth is linear in the picture.
  void add_deep(const Corner& a, const Corner& b, const Corner& c, Tissue net, float counted, PathLengths& out) {
    const Linear inverse = Slopes(a, b, c).through(a, 1.0 / a.depth, 1.0 / b.depth, 1.0 / c.depth);
    const auto [near, far] = std::minmax({a.depth, b.depth, c.depth});
    const float near_ = near, far_ = far, per_x = static_cast<float>(inverse.per_x);
    const auto isocentre = static_cast<float>(isocentre_);
    const int side = out.side();
    float* const pixels = out.pixels().data();
    for_each_span(a, b, c, side, [=](int row, int from, int to, float sign) {
      constexpr int at_once = 8;
      static const Eight steps{{0, 1, 2, 3, 4, 5, 6, 7}};
      const auto start = static_cast<float>(inverse(from, row));
      const Four per_m(sign * net.soft, sign * net.bone, 0, 0), once(0, 0, 0, sign * counted);
      Eight per_m_twice, once_twice;
      per_m_twice << per_m, per_m;
      once_twice << once, once;
      float* pixel = pixels + 4 * (std::ptrdiff_t(row) * side + from);
      for (int x = 0; x < to - from; x += at_once, pixel += 4 * at_once) {
        const Eight depth =
            (start + per_x * (static_cast<float>(x) + steps)).inverse().max(near_).min(far_) - isocentre;
        const int n = std::min(at_once, to - from - x);
        for (int i = 0; i + 2 <= n; i += 2) {
          Eight twice;
          twice << depth[i], depth[i], depth[i], depth[i], depth[i + 1], depth[i + 1], depth[i + 1], depth[i + 1];
          Eigen::Map<Eight>(pixel + 4 * i) += per_m_twice * twice + once_twice;
        }
        if (n % 2) Eigen::Map<Four>(pixel + 4 * (n - 1)) += per_m * depth[n - 1] + once;
      }
    });
  }

  std::vector<Corner> corners_;
  std::vector<Cell> cells_;
  std::vector<Filling> fillings_;
  double isocentre_ = 0;
};

}  // namespace

std::unique_ptr<PathLengthRenderer> make_scanline_renderer() { return std::make_unique<ScanlineRenderer>(); }

}  // namespace ostium::fluoro
