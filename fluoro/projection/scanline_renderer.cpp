/// A rasteriser for path lengths only. Each triangle is cut into spans of pixel centres; a span adds depth where rays
/// exit and subtracts it where they enter.
///
/// No gaps between triangles: the crossing of a row of pixel centres with an edge is computed from the upper end of
/// that edge, so that both its triangles get the same bits, and a span's sign depends on which of its two crossings is
/// on the left. So entries and exits of a closed surface cancel exactly in every pixel.
///
/// Most spans are some pixels long, so what counts is their number, and that nothing in them is guessed by the
/// processor: eight rows are cut at once, eight pixels written at once, and those beyond a span's end get nothing
/// added. A body is summed in whole numbers, whose sum is the same in any order.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "fluoro/base/lanes.h"
#include "fluoro/projection/path_lengths.h"

namespace ostium::fluoro {

namespace {

bool any(const Ints& value) {
  std::array<std::int64_t, 4> quarters;
  std::memcpy(&quarters, &value, sizeof value);
  return (quarters[0] | quarters[1] | quarters[2] | quarters[3]) != 0;
}
/// Adds the first of the lanes to a row of pixels.
void increase(const Floats& value, int count, float* to) { store(load(to, count) + value, to, count); }

/// A vertex on the picture: column and row in pixels (centres at one half), depth from the source and its inverse,
/// which is linear in the picture.
struct Corner {
  float x, y, depth, inverse;
};

/// Contrast of a vertex: concentration times depth from its centreline, and the integral along that, kg/m2.
using Filling = float;

/// value = at + per_x (x - a.x) + per_y (y - a.y), between the least and the most at its corners: of a sliver the
/// slopes are steep and what is rounded matters.
struct Linear {
  float at, per_x, per_y, few, many;

  Linear(const Corner& a, const Corner& b, const Corner& c, float va, float vb, float vc) : at(va) {
    const float x1 = b.x - a.x, y1 = b.y - a.y, x2 = c.x - a.x, y2 = c.y - a.y, area = x1 * y2 - x2 * y1;
    const float over_area = std::fabs(area) > 1e-9f ? 1 / area : 0;
    per_x = ((vb - va) * y2 - (vc - va) * y1) * over_area;
    per_y = ((vc - va) * x1 - (vb - va) * x2) * over_area;
    few = std::min({va, vb, vc}), many = std::max({va, vb, vc});
  }
};

/// Where an edge crosses the middles of rows; bit-identical for both triangles.
struct Edge {
  float x, y, slope;
  Edge(const Corner& upper, const Corner& lower)
      : x(upper.x), y(upper.y), slope((lower.x - upper.x) / (lower.y - upper.y)) {}
  Floats crossing(const Floats& at_y) const { return x + slope * (at_y - y); }
};

/// The first pixel centre at or after a position, 0 to pixels; also of what is no number: 0.
int first_centre_from(float position, float pixels) {
  const float centre = std::ceil(position - 0.5f), positive = centre > 0 ? centre : 0;
  return static_cast<int>(positive < pixels ? positive : pixels);
}
Ints first_centres_from(const Floats& position, float pixels) {
  const Floats after = position - 0.5f, positive = least(most(after, Floats{}), all(pixels));
  const Ints below = truncated(positive);
  return below - (to_floats(below) < positive);  // true is -1
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

/// Sums over one body, in whole units. What is no part of a closed surface leaves whole turns: for each exit one is
/// added, for each entry one subtracted.
struct Sums {
  float unit;     ///< of a whole number
  int turn_log2;  ///< a turn in units: more than twice the largest sum of a closed surface
  int stride = 0;
  std::vector<std::int32_t> sum{};         ///< rows of `stride` pixels, those beyond the picture for whole lanes
  std::vector<std::int32_t> from{}, to{};  ///< columns touched in each row; and some rows beyond the picture

  void resize(int pixels) {
    if (stride == pixels + lanes) return;
    stride = pixels + lanes;
    const auto rows = static_cast<std::size_t>(pixels);
    sum.assign(rows * static_cast<std::size_t>(stride), 0);
    from.assign(rows + lanes, stride), to.assign(rows + lanes, 0);
  }
};

class ScanlineRenderer final : public PathLengthRenderer {
 public:
  void add(const View& view, std::span<const Body> bodies, PathLengths& out, Parts parts) override {
    isocentre_ = static_cast<float>(view.arm.source_to_isocentre_m);
    for (Sums* sums : {&depth_m_, &iodine_kg_m2_}) sums->resize(out.side());
    for (const Body& body : bodies) {
      const Tissue net{body.tissue.soft - body.within.soft, body.tissue.bone - body.within.bone};
      const bool has_tissue = net.soft != 0 || net.bone != 0, filled = parts != Parts::still && is_seen(body.contrast);
      const auto all = static_cast<int>(body.triangles->cols());
      const int still = parts == Parts::all ? 0 : body.still, first = parts == Parts::still ? 0 : still,
                last = parts == Parts::still ? still : all;
      if (first == last || (!has_tissue && !filled)) continue;
      project(view, body, still > 0 && parts == Parts::moving && !filled ? body.corners.get() : nullptr);
      // An entry or exit is counted where its tissue is drawn; where there is none, with its contrast.
      if (has_tissue) {
        draw<Quantity::depth>(body, first, last, true, depth_m_, out.side());
        take(depth_m_, out, out.soft_m(), net.soft, net.bone != 0 ? &out.bone_m() : nullptr, net.bone);
      }
      if (filled) {
        project_contrast(view, body);
        draw<Quantity::iodine>(body, 0, all, !has_tissue, iodine_kg_m2_, out.side());
        take(iodine_kg_m2_, out, out.iodine_kg_m2(), 1, nullptr, 0);
      }
    }
  }

  const char* name() const override { return "scanline"; }

 private:
  static constexpr float nearest_m = 0.05f;  // no part of a patient is nearer to the source
  enum class Quantity { depth, iodine };

  /// All vertices, or those listed. Each comes out with the same bits in any list: no operations are fused.
  void project(const View& view, const Body& body, const std::vector<int>* listed) {
    constexpr int block = 128;
    const ImageAxes axes(view.arm);
    const Eigen::Vector3d s = source(view.arm), &r = axes.right, &u = axes.up, &o = axes.outwards;
    const double scale = view.arm.source_to_detector_m / view.field_m * view.pixels, half = 0.5 * view.pixels;
    const auto pixels = static_cast<float>(view.pixels);
    const std::size_t vertices = static_cast<std::size_t>(body.p_P.cols()), count = listed ? listed->size() : vertices;
    corners_.resize(vertices);
    cells_.resize(vertices);
    std::array<double, block> x, y, z, depth;
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
      }
      for (int i = 0; i < n; ++i) {
        Corner& corner = corners_[vertex(i)];
        corner = {static_cast<float>(x[i]), static_cast<float>(y[i]), static_cast<float>(depth[i]),
                  static_cast<float>(1 / depth[i])};
        cells_[vertex(i)] = {static_cast<std::int16_t>(first_centre_from(corner.y, pixels)),
                             static_cast<std::int16_t>(first_centre_from(corner.x, pixels))};
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

  template <Quantity quantity>
  void draw(const Body& body, int first, int last, bool counted, Sums& sums, int side) {
    for (int n = first; n < last; ++n) {
      const auto t = body.triangles->col(n);
      const auto i = std::size_t(t[0]), j = std::size_t(t[1]), k = std::size_t(t[2]);
      if (!meets_a_centre(cells_[i], cells_[j], cells_[k])) continue;
      const Corner &a = corners_[i], &b = corners_[j], &c = corners_[k];
      if (std::min({a.depth, b.depth, c.depth}) < nearest_m) continue;
      const Linear value = quantity == Quantity::depth ? Linear(a, b, c, a.inverse, b.inverse, c.inverse)
                                                       : Linear(a, b, c, fillings_[i], fillings_[j], fillings_[k]);
      add_triangle<quantity>(a, b, c, value, counted ? 1 << sums.turn_log2 : 0, sums, side);
    }
  }

  template <Quantity quantity>
  void add_triangle(const Corner& a, const Corner& b, const Corner& c, const Linear& value, int turn, Sums& sums,
                    int side) const {
    const Corner* top = &a;
    const Corner* middle = &b;
    const Corner* bottom = &c;
    int entry = 0;  // -1: the triangle is clockwise if its longest edge is on the left
    const auto order = [&](const Corner*& upper, const Corner*& lower) {
      if (lower->y < upper->y) {
        std::swap(upper, lower);
        entry = ~entry;
      }
    };
    order(top, middle);
    order(middle, bottom);
    order(top, middle);
    const auto pixels = static_cast<float>(side);
    const int first = first_centre_from(top->y, pixels), last = first_centre_from(bottom->y, pixels);
    const int bend = first_centre_from(middle->y, pixels);
    const Edge whole(*top, *bottom), above(*top, *middle), below(*middle, *bottom);
    for (int row = first; row < last; row += lanes) {
      const Ints rows = row + counting_ints;
      const Floats y = static_cast<float>(row) + 0.5f + counting;
      const Ints one = first_centres_from(whole.crossing(y), pixels),
                 other = first_centres_from(rows < bend ? above.crossing(y) : below.crossing(y), pixels);
      const Ints from = one < other ? one : other, to = one < other ? other : one;
      // The sign is +1 where the ray exits: the triangle is anticlockwise in the picture.
      const Ints negative = (one < other) ^ entry;
      const Ints count = rows < last ? to - from : Ints{};
      const Floats start = value.at + value.per_x * (to_floats(from) + 0.5f - a.x) + value.per_y * (y - a.y);
      const Ints touched = count > 0;
      std::int32_t *const least_from = &sums.from[static_cast<std::size_t>(row)],
                          *const most_to = &sums.to[static_cast<std::size_t>(row)];
      const Ints so_far_from = load(least_from), so_far_to = load(most_to);
      store((touched & (from < so_far_from)) ? from : so_far_from, least_from);
      store((touched & (to > so_far_to)) ? to : so_far_to, most_to);
      const int here = std::min(lanes, last - row);
      for (int k = 0; k < here; ++k)
        if (count[k] > 0)
          add_span<quantity>(value, start[k], count[k], negative[k], turn,
                             sums.sum.data() + std::ptrdiff_t(row + k) * sums.stride + from[k], sums.unit);
    }
  }

  template <Quantity quantity>
  void add_span(const Linear& value, float start, int count, int negative, int turn, std::int32_t* to,
                float unit) const {
    const float per_unit = 1 / unit;
    for (int done = 0; done < count; done += lanes, to += lanes) {
      Floats v = start + value.per_x * (static_cast<float>(done) + counting);
      v = least(most(v, all(value.few)), all(value.many));
      if (quantity == Quantity::depth) v = 1 / v - isocentre_;
      const Ints added = ((truncated(v * per_unit) + turn) ^ negative) - negative;
      store(load(to) + (added & (counting_ints < count - done)), to);
    }
  }

  /// Adds what was summed to up to two planes, each with its share, and sets it to zero.
  static void take(Sums& sums, PathLengths& out, Plane& first, float first_share, Plane* second, float second_share) {
    const std::int32_t half = 1 << (sums.turn_log2 - 1);
    for (int row = 0; row < out.side(); ++row) {
      auto &from = sums.from[static_cast<std::size_t>(row)], &to = sums.to[static_cast<std::size_t>(row)];
      std::int32_t* const sum = sums.sum.data() + std::ptrdiff_t(row) * sums.stride;
      float *const one = first.row(row).data(), *const other = second ? second->row(row).data() : nullptr,
                   *const unmatched = out.unmatched().row(row).data();
      for (int column = from; column < to; column += lanes) {  // beyond `to` and beyond the picture the sum is zero
        const Ints sums_here = load(sum + column), turns = (sums_here + half) >> sums.turn_log2;
        const Floats rest = sums.unit * to_floats(sums_here - (turns << sums.turn_log2));
        store(Ints{}, sum + column);
        const int here = std::min(lanes, out.side() - column);
        increase(first_share * rest, here, one + column);
        if (other) increase(second_share * rest, here, other + column);
        if (any(turns)) increase(to_floats(turns), here, unmatched + column);
      }
      from = sums.stride, to = 0;
    }
  }

  std::vector<Corner> corners_;
  std::vector<Cell> cells_;
  std::vector<Filling> fillings_;
  Sums depth_m_{0x1p-24f, 27}, iodine_kg_m2_{0x1p-20f, 29};  // turns of 8 m and 512 kg/m2
  float isocentre_ = 0;
};

}  // namespace

std::unique_ptr<PathLengthRenderer> make_scanline_renderer() { return std::make_unique<ScanlineRenderer>(); }

}  // namespace ostium::fluoro
