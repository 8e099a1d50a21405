#include "data/picture/skeleton.h"

#include <algorithm>
#include <array>
#include <deque>
#include <map>

namespace ostium::data {

using Eigen::Index;
using Eigen::Vector2i;

namespace {

/// Clockwise from the one above.
constexpr std::array<std::array<int, 2>, 8> around{
    {{-1, 0}, {-1, 1}, {0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, -1}}};

bool in(const Mask& mask, Index y, Index x) {
  return y >= 0 && x >= 0 && y < mask.rows() && x < mask.cols() && mask(y, x);
}

/// Whether a pixel may go in one of thinning's two passes.
bool may_go(const Mask& m, Index y, Index x, int pass) {
  std::array<bool, 8> p;
  int count = 0, turns = 0;
  for (std::size_t i = 0; i < 8; ++i) count += p[i] = in(m, y + around[i][0], x + around[i][1]);
  for (std::size_t i = 0; i < 8; ++i) turns += !p[i] && p[(i + 1) % 8];
  if (count < 2 || count > 6 || turns != 1) return false;
  const bool up = p[0], right = p[2], down = p[4], left = p[6];
  return pass == 0 ? !(up && right && down) && !(right && down && left)
                   : !(up && right && left) && !(up && down && left);
}

}  // namespace

std::vector<int> Parts::sizes() const {
  std::vector<int> out(static_cast<std::size_t>(count) + 1, 0);
  for (Index i = 0; i < label.size(); ++i) ++out[static_cast<std::size_t>(label.data()[i])];
  return out;
}

Parts parts_of(const Mask& mask) {
  Parts out{Labels::Zero(mask.rows(), mask.cols()), 0};
  std::vector<Vector2i> open;
  for (int y = 0; y < mask.rows(); ++y)
    for (int x = 0; x < mask.cols(); ++x) {
      if (!mask(y, x) || out.label(y, x)) continue;
      out.label(y, x) = ++out.count;
      open.push_back({y, x});
      while (!open.empty()) {
        const Vector2i at = open.back();
        open.pop_back();
        for (const auto& [dy, dx] : around) {
          const int v = at[0] + dy, u = at[1] + dx;
          if (!in(mask, v, u) || out.label(v, u)) continue;
          out.label(v, u) = out.count;
          open.push_back({v, u});
        }
      }
    }
  return out;
}

Mask dilated(const Mask& mask, int times) {
  // A square's dilation goes along rows and columns one after the other.
  const auto spread = [times](const Mask& from, bool rows) {
    Mask out = from;
    for (Index y = 0; y < from.rows(); ++y)
      for (Index x = 0; x < from.cols(); ++x)
        if (from(y, x))
          for (int k = -times; k <= times; ++k) {
            const Index v = rows ? y : y + k, u = rows ? x + k : x;
            if (v >= 0 && u >= 0 && v < from.rows() && u < from.cols()) out(v, u) = true;
          }
    return out;
  };
  return spread(spread(mask, true), false);
}

Mask closed(const Mask& mask) {
  const Mask wide = dilated(mask);
  Mask out = Mask::Constant(mask.rows(), mask.cols(), false);
  for (Index y = 1; y + 1 < mask.rows(); ++y)
    for (Index x = 1; x + 1 < mask.cols(); ++x) out(y, x) = wide.block(y - 1, x - 1, 3, 3).all();
  return out;
}

Mask thinned(const Mask& mask) {
  Mask m = mask;
  std::vector<Vector2i> left, going;
  for (int y = 0; y < m.rows(); ++y)
    for (int x = 0; x < m.cols(); ++x)
      if (m(y, x)) left.push_back({y, x});
  for (bool more = true; more;) {
    more = false;
    for (int pass : {0, 1}) {
      going.clear();
      for (const Vector2i& p : left)
        if (may_go(m, p[0], p[1], pass)) going.push_back(p);
      for (const Vector2i& p : going) m(p[0], p[1]) = false;
      more = more || !going.empty();
      std::erase_if(left, [&](const Vector2i& p) { return !m(p[0], p[1]); });
    }
  }
  return m;
}

Labels neighbours(const Mask& skeleton) {
  Labels out = Labels::Zero(skeleton.rows(), skeleton.cols());
  for (Index y = 0; y < skeleton.rows(); ++y)
    for (Index x = 0; x < skeleton.cols(); ++x)
      if (skeleton(y, x))
        for (const auto& [dy, dx] : around) out(y, x) += in(skeleton, y + dy, x + dx);
  return out;
}

Branches branches_of(const Mask& skeleton) {
  const Mask junctions = neighbours(skeleton) > 2;
  return {parts_of(skeleton && !dilated(junctions)), junctions};
}

Mask pruned(Mask s, int pixels) {
  for (int round = 0; round < 2; ++round) {
    const auto [parts, junctions] = branches_of(s);
    if (parts.count == 0) break;
    const std::vector<int> size = parts.sizes();
    const Labels around_it = neighbours(s);
    const Mask near = dilated(junctions, 2);
    std::vector<bool> ends(size.size(), false), touches(size.size(), false);
    for (Index i = 0; i < s.size(); ++i) {
      const auto label = static_cast<std::size_t>(parts.label.data()[i]);
      if (around_it.data()[i] == 1) ends[label] = true;
      if (near.data()[i]) touches[label] = true;
    }
    for (Index i = 0; i < s.size(); ++i) {
      const auto label = static_cast<std::size_t>(parts.label.data()[i]);
      if (label > 0 && size[label] < pixels && ends[label] && touches[label]) s.data()[i] = false;
    }
    s = thinned(s);
  }
  const Parts parts = parts_of(s);
  const std::vector<int> size = parts.sizes();
  for (Index i = 0; i < s.size(); ++i) {
    const auto label = static_cast<std::size_t>(parts.label.data()[i]);
    s.data()[i] = label > 0 && size[label] >= 4 * pixels;
  }
  return s;
}

std::vector<Vector2i> in_order(const std::vector<Vector2i>& pixels) {
  std::map<std::pair<int, int>, int> number;
  for (std::size_t i = 0; i < pixels.size(); ++i) number[{pixels[i][0], pixels[i][1]}] = static_cast<int>(i);
  std::vector<std::vector<int>> next(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (const auto& [dy, dx] : around)
      if (const auto found = number.find({pixels[i][0] + dy, pixels[i][1] + dx}); found != number.end())
        next[i].push_back(found->second);
  int start = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (next[i].size() < next[static_cast<std::size_t>(start)].size()) start = static_cast<int>(i);
  // The farthest pixel from any is an end; the farthest from that is the other.
  std::vector<int> before;
  int last = start;
  for (int round = 0; round < 2; ++round) {
    start = last;
    before.assign(pixels.size(), -2);
    before[static_cast<std::size_t>(start)] = -1;
    std::deque<int> open{start};
    while (!open.empty()) {
      last = open.front();
      open.pop_front();
      for (int k : next[static_cast<std::size_t>(last)])
        if (before[static_cast<std::size_t>(k)] == -2) before[static_cast<std::size_t>(k)] = last, open.push_back(k);
    }
  }
  std::vector<Vector2i> out;
  for (; last != -1; last = before[static_cast<std::size_t>(last)])
    out.push_back(pixels[static_cast<std::size_t>(last)]);
  return out;
}

}  // namespace ostium::data
