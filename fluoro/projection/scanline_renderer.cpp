/// A rasteriser for path lengths only. Each triangle is cut into spans of pixel centres; a span adds depth where rays
/// exit and subtracts it where they enter.
///
/// No gaps between triangles: the crossing of a row of pixel centres with an edge is computed from the upper end of
/// that edge, so that both its triangles get the same bits, and a span's sign depends on which of its two crossings is
/// on the left. So entries and exits of a closed surface cancel exactly in every pixel.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "fluoro/projection/path_lengths.h"

namespace ostium::fluoro {

namespace {

/// A vertex on the picture: column and row in pixels (centres at one half), depth from the source.
struct Corner {
  double x, y;
  float depth;
  float iodine, from_centreline;  // of contrast: concentration; depth minus that of its centreline;
  float along;                    // and the integral along the centreline, kg/m2
};

/// value = at + per_x column + per_y row.
struct Linear {
  float at = 0, per_x = 0, per_y = 0;
};

struct Slopes {
  double x1, y1, x2, y2, over_area;  // of two edges

  Slopes(const Corner& a, const Corner& b, const Corner& c)
      : x1(b.x - a.x), y1(b.y - a.y), x2(c.x - a.x), y2(c.y - a.y) {
    const double area = x1 * y2 - x2 * y1;
    over_area = std::fabs(area) > 1e-12 ? 1 / area : 0;  // for a sliver: constant, the first corner's value
  }

  Linear through(const Corner& a, double va, double vb, double vc) const {
    const double per_x = ((vb - va) * y2 - (vc - va) * y1) * over_area;
    const double per_y = ((vc - va) * x1 - (vb - va) * x2) * over_area;
    return {static_cast<float>(va - per_x * (a.x - 0.5) - per_y * (a.y - 0.5)), static_cast<float>(per_x),
            static_cast<float>(per_y)};
  }
};

/// Where an edge crosses the middle of a row; bit-identical for both triangles.
struct Edge {
  double x, y, slope;
  Edge(const Corner& upper, const Corner& lower)
      : x(upper.x), y(upper.y), slope((lower.x - upper.x) / (lower.y - upper.y)) {}
  double crossing(int row) const { return x + slope * (row + 0.5 - y); }
};

int first_centre_from(double position, int pixels) {
  return static_cast<int>(std::clamp(std::ceil(position - 0.5), 0.0, static_cast<double>(pixels)));
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

class ScanlineRenderer final : public PathLengthRenderer {
 public:
  void add(const View& view, std::span<const Body> bodies, PathLengths& out) override {
    for (const Body& body : bodies) {
      const Tissue net{body.tissue.soft - body.within.soft, body.tissue.bone - body.within.bone};
      const bool filled = is_seen(body.contrast);
      if (net.soft == 0 && net.bone == 0 && !filled) continue;
      project(view, body, filled);
      isocentre_ = static_cast<float>(view.arm.source_to_isocentre_m);
      for (const auto& t : body.triangles->colwise()) {
        const auto i = std::size_t(t[0]), j = std::size_t(t[1]), k = std::size_t(t[2]);
        if (!meets_a_centre(cells_[i], cells_[j], cells_[k])) continue;
        const Corner &a = corners_[i], &b = corners_[j], &c = corners_[k];
        if (a.depth < nearest_m || b.depth < nearest_m || c.depth < nearest_m) continue;
        if (net.soft != 0 || net.bone != 0) add_tissue(a, b, c, net, out);
        if (filled) add_iodine(a, b, c, out);
      }
    }
  }

  const char* name() const override { return "scanline"; }

 private:
  static constexpr float nearest_m = 0.05f;  // no part of a patient is nearer to the source

  void project(const View& view, const Body& body, bool filled) {
    const ImageAxes axes(view.arm);
    const Eigen::Vector3d p_PS = source(view.arm);
    const double scale = view.arm.source_to_detector_m / view.field_m * view.pixels, half = 0.5 * view.pixels;
    corners_.resize(static_cast<std::size_t>(body.p_P.cols()));
    cells_.resize(corners_.size());
    for (Eigen::Index i = 0; i < body.p_P.cols(); ++i) {
      const Eigen::Vector3d ray = body.p_P.col(i).cast<double>() - p_PS;
      const double depth = ray.dot(axes.outwards), over = scale / depth;
      Corner& corner = corners_[std::size_t(i)];
      corner = {half + over * ray.dot(axes.right), half - over * ray.dot(axes.up), static_cast<float>(depth), 0, 0, 0};
      cells_[std::size_t(i)] = {static_cast<std::int16_t>(first_centre_from(corner.y, view.pixels)),
                                static_cast<std::int16_t>(first_centre_from(corner.x, view.pixels))};
      if (filled) {
        corner.iodine = body.contrast.iodine_kg_m3[i];
        corner.from_centreline =
            static_cast<float>(depth - axes.outwards.dot(body.contrast.p_PC.col(i).cast<double>() - p_PS));
        if (body.contrast.along_kg_m2.size() > 0)
          corner.along = static_cast<float>(axes.outwards.dot(body.contrast.along_kg_m2.col(i).cast<double>()));
      }
    }
  }

  /// The inverse of the depth is linear in the picture.
  void add_tissue(const Corner& a, const Corner& b, const Corner& c, Tissue net, PathLengths& out) {
    const Linear inverse = Slopes(a, b, c).through(a, 1.0 / a.depth, 1.0 / b.depth, 1.0 / c.depth);
    const float nearest = std::min({a.depth, b.depth, c.depth}), farthest = std::max({a.depth, b.depth, c.depth});
    // Two pixels fill one register and need one store.
    using Pair = Eigen::Array<float, 8, 1>;
    const Pair per_depth{{net.soft, net.bone, 0, 0, net.soft, net.bone, 0, 0}}, once{{0, 0, 0, 1, 0, 0, 0, 1}};
    const float isocentre = isocentre_;
    const int side = out.side();
    float* const pixels = out.pixels().data();
    // Captured by value, so that the compiler need not reload them after each store into a pixel.
    for_each_span(a, b, c, side, [=](int row, int from, int to, float sign) {
      const float start = inverse.at + inverse.per_y * static_cast<float>(row);
      const auto depth_at = [&](float x) {
        return std::min(std::max(1 / (start + inverse.per_x * x), nearest), farthest) - isocentre;
      };
      float* pixel = pixels + 4 * (std::ptrdiff_t(row) * side + from);
      int x = from;
      const Pair per_m = sign * per_depth, exits = sign * once;
      for (; x + 2 <= to; x += 2, pixel += 8) {
        const float first = depth_at(static_cast<float>(x)), second = depth_at(static_cast<float>(x + 1));
        const Pair depth{{first, first, first, first, second, second, second, second}};
        Eigen::Map<Pair> sums(pixel);
        sums += per_m * depth + exits;
      }
      if (x == to) return;
      Eigen::Map<Eigen::Array4f> sums(pixel);
      sums += per_m.head<4>() * depth_at(static_cast<float>(x)) + exits.head<4>();
    });
  }

  /// Vessels are finely meshed: taking the depth from the centreline as linear in the picture is accurate to a
  /// micrometre.
  void add_iodine(const Corner& a, const Corner& b, const Corner& c, PathLengths& out) {
    const Slopes slopes(a, b, c);
    const Linear iodine = slopes.through(a, a.iodine, b.iodine, c.iodine);
    const Linear depth = slopes.through(a, a.from_centreline, b.from_centreline, c.from_centreline);
    const Linear along = slopes.through(a, a.along, b.along, c.along);
    const auto [few, many] = std::minmax({a.along, b.along, c.along});
    const float few_ = few, many_ = many;
    const auto [least, most] = std::minmax({a.from_centreline, b.from_centreline, c.from_centreline});
    const auto [thin, dense] = std::minmax({a.iodine, b.iodine, c.iodine});
    const float thin_ = thin, dense_ = dense, least_ = least, most_ = most;
    const int side = out.side();
    float* const pixels = out.pixels().data();
    for_each_span(a, b, c, side, [=](int row, int from, int to, float sign) {
      const auto y = static_cast<float>(row);
      float* pixel = pixels + 4 * (std::ptrdiff_t(row) * side + from);
      for (int column = from; column < to; ++column, pixel += 4) {
        const auto x = static_cast<float>(column);
        const float kg_m3 = std::min(std::max(iodine.at + iodine.per_x * x + iodine.per_y * y, thin_), dense_);
        const float m = std::min(std::max(depth.at + depth.per_x * x + depth.per_y * y, least_), most_);
        const float kg_m2 = std::min(std::max(along.at + along.per_x * x + along.per_y * y, few_), many_);
        pixel[2] += sign * (kg_m3 * m + kg_m2);
        pixel[3] += sign;
      }
    });
  }

  std::vector<Corner> corners_;
  std::vector<Cell> cells_;
  float isocentre_ = 0;
};

}  // namespace

std::unique_ptr<PathLengthRenderer> make_scanline_renderer() { return std::make_unique<ScanlineRenderer>(); }

}  // namespace ostium::fluoro
