#include "vascular/geometry/repair/sheets.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <queue>
#include <unordered_map>

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

constexpr double pinhole_m = 1e-3;        // diameter
constexpr std::size_t pinhole_edges = 4;  // or this few edges
constexpr double end_cosine = 0.6;        // between wall and lid: below this, the opening is a vessel end

constexpr std::size_t most_around = 64;  // triangles at one edge: no real wall has more, and pairing takes cubic time

int next_in_triangle(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
int from_of(const Mesh& mesh, int h) { return mesh.triangles[h / 3][h % 3]; }
int to_of(const Mesh& mesh, int h) { return mesh.triangles[h / 3][(h + 1) % 3]; }

/// Unit vector from the edge towards the triangle's third corner.
Eigen::Vector3d away_from_edge(const Mesh& mesh, int h) {
  const Eigen::Vector3d &a = mesh.vertices[from_of(mesh, h)], &b = mesh.vertices[to_of(mesh, h)];
  const Eigen::Vector3d along = (b - a).normalized(), c = mesh.vertices[mesh.triangles[h / 3][(h + 2) % 3]] - a;
  return (c - c.dot(along) * along).normalized();
}

/// How ill two half-edges of one edge go together: flat is well, and so is to face one way, as two vessels that touch
/// along a line face each other, and a sheet across both is as flat as their own.
double apartness(const Mesh& mesh, int h, int o) {
  constexpr double other_way = 0.5;
  return away_from_edge(mesh, h).dot(away_from_edge(mesh, o)) + (from_of(mesh, h) == from_of(mesh, o) ? other_way : 0);
}

void match(const Mesh& mesh, std::vector<int> around, std::vector<int>& opposite) {
  while (around.size() > 1) {
    std::size_t first = 0, second = 1;
    double flattest = 2;
    if (around.size() > 2 && around.size() <= most_around)
      for (std::size_t i = 0; i < around.size(); ++i)
        for (std::size_t j = i + 1; j < around.size(); ++j)
          if (const double apart = apartness(mesh, around[i], around[j]); apart < flattest)
            flattest = apart, first = i, second = j;
    opposite[around[first]] = around[second];
    opposite[around[second]] = around[first];
    around.erase(around.begin() + static_cast<long>(second));
    around.erase(around.begin() + static_cast<long>(first));
  }
}

void number_pieces(Sheets& sheets) {
  const int n = static_cast<int>(sheets.opposite.size() / 3);
  sheets.piece.assign(static_cast<std::size_t>(n), -1);
  sheets.pieces = 0;
  std::vector<int> open;
  for (int seed = 0; seed < n; ++seed) {
    if (sheets.piece[seed] >= 0) continue;
    open = {seed};
    sheets.piece[seed] = sheets.pieces;
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (int k = 0; k < 3; ++k)
        if (const int o = sheets.opposite[3 * t + k]; o >= 0 && sheets.piece[o / 3] < 0) {
          sheets.piece[o / 3] = sheets.pieces;
          open.push_back(o / 3);
        }
    }
    ++sheets.pieces;
  }
}

/// Separates half-edges with the same direction, which cannot be partners.
void part_where_one_sided(const Mesh& mesh, Sheets& sheets) {
  for (int h = 0; h < static_cast<int>(sheets.opposite.size()); ++h)
    if (const int o = sheets.opposite[h]; o >= 0 && from_of(mesh, h) == from_of(mesh, o))
      sheets.opposite[h] = sheets.opposite[o] = -1;
}

double six_volumes(const Mesh& mesh, const std::vector<Opening>& openings, const Sheets& sheets, int piece) {
  const Eigen::Vector3d origin = box_middle(mesh);
  const auto place = [&](int v) -> Eigen::Vector3d { return mesh.vertices[v] - origin; };
  double sum = 0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    if (sheets.piece[t] == piece) {
      const auto& [a, b, c] = mesh.triangles[t];
      sum += place(a).dot(place(b).cross(place(c)));
    }
  for (const Opening& opening : openings)
    if (opening.piece == piece)
      for (int h : opening.half_edges)
        sum += place(to_of(mesh, h)).dot(place(from_of(mesh, h)).cross(opening.middle - origin));
  return sum;
}

}  // namespace

Sheets sheets_of(const Mesh& mesh) {
  const int n = static_cast<int>(3 * mesh.triangles.size());
  std::vector<std::array<int, 3>> edges;  // low vertex, high vertex, half-edge
  edges.reserve(static_cast<std::size_t>(n));
  for (int h = 0; h < n; ++h) {
    const int from = from_of(mesh, h), to = to_of(mesh, h);
    edges.push_back({std::min(from, to), std::max(from, to), h});
  }
  std::sort(edges.begin(), edges.end());
  Sheets sheets;
  sheets.opposite.assign(static_cast<std::size_t>(n), -1);
  for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
    std::vector<int> around;
    for (; j < edges.size() && edges[j][0] == edges[i][0] && edges[j][1] == edges[i][1]; ++j)
      around.push_back(edges[j][2]);
    match(mesh, std::move(around), sheets.opposite);
  }
  number_pieces(sheets);
  return sheets;
}

bool sides_known(const Sheets& sheets) { return sheets.pieces < 2000; }

Orientation orient(Mesh& mesh, Sheets& sheets) {
  Orientation result;
  const int n = static_cast<int>(mesh.triangles.size());
  std::vector<signed char> turned(static_cast<std::size_t>(n), -1);
  std::vector<int> open, piece;
  for (int seed = 0; seed < n; ++seed) {
    if (turned[seed] >= 0) continue;
    open = piece = {seed};
    turned[seed] = 0;
    std::size_t turns = 0;
    while (!open.empty()) {
      const int t = open.back();
      open.pop_back();
      for (int k = 0; k < 3; ++k) {
        const int h = 3 * t + k, o = sheets.opposite[h];
        if (o < 0 || turned[o / 3] >= 0) continue;
        const bool same_way = from_of(mesh, h) == from_of(mesh, o);
        turned[o / 3] = static_cast<signed char>(turned[t] ^ (same_way ? 1 : 0));
        turns += turned[o / 3];
        open.push_back(o / 3);
        piece.push_back(o / 3);
      }
    }
    if (2 * turns > piece.size())
      for (int t : piece) turned[t] ^= 1;
  }
  for (int t = 0; t < n; ++t)
    if (turned[t]) {
      const auto& [a, b, c] = mesh.triangles[t];
      result.flipped.push_back((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3);
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    }
  if (!result.flipped.empty()) sheets = sheets_of(mesh);
  part_where_one_sided(mesh, sheets);
  number_pieces(sheets);

  const std::vector<Opening> openings = openings_of(mesh, sheets);
  std::vector<bool> inverted(static_cast<std::size_t>(sheets.pieces));
  std::vector<int> first(static_cast<std::size_t>(sheets.pieces), -1);
  bool any = false;
  for (int t = n - 1; t >= 0; --t) first[sheets.piece[t]] = t;
  if (sides_known(sheets))
    for (int p = 0; p < sheets.pieces; ++p)
      if (six_volumes(mesh, openings, sheets, p) < 0) {
        inverted[p] = any = true;
        result.inverted.push_back(mesh.vertices[mesh.triangles[first[p]][0]]);
      }
  if (!any) return result;
  for (int t = 0; t < n; ++t)
    if (inverted[sheets.piece[t]]) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  sheets = sheets_of(mesh);
  part_where_one_sided(mesh, sheets);
  number_pieces(sheets);
  return result;
}

bool Opening::pinhole() const { return half_edges.size() <= pinhole_edges || diameter_m < pinhole_m; }

std::vector<Opening> openings_of(const Mesh& mesh, const Sheets& sheets) {
  std::vector<Opening> openings;
  const int n = static_cast<int>(sheets.opposite.size());
  std::vector<bool> done(static_cast<std::size_t>(n));
  for (int seed = 0; seed < n; ++seed) {
    if (sheets.opposite[seed] >= 0 || done[seed]) continue;
    Opening opening;
    opening.piece = sheets.piece[seed / 3];
    for (int h = seed; !done[h];) {
      done[h] = true;
      opening.half_edges.push_back(h);
      // Rotate around the vertex at its end, through connected triangles.
      for (h = next_in_triangle(h); sheets.opposite[h] >= 0; h = next_in_triangle(sheets.opposite[h])) {
      }
    }
    for (int h : opening.half_edges) {
      const Eigen::Vector3d &a = mesh.vertices[from_of(mesh, h)], &b = mesh.vertices[to_of(mesh, h)];
      opening.length_m += (b - a).norm();
      opening.middle += (b - a).norm() * (a + b) / 2;
    }
    if (opening.length_m > 0) opening.middle /= opening.length_m;
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (int h : opening.half_edges)
      area +=
          (mesh.vertices[to_of(mesh, h)] - opening.middle).cross(mesh.vertices[from_of(mesh, h)] - opening.middle) / 2;
    opening.diameter_m = 2 * std::sqrt(area.norm() / units::pi);
    if (area.norm() > 0) opening.outwards = area.normalized();
    double facing = 0;
    for (int h : opening.half_edges) {
      const auto& [a, b, c] = mesh.triangles[h / 3];
      const Eigen::Vector3d normal =
          (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).normalized();
      facing += (mesh.vertices[to_of(mesh, h)] - mesh.vertices[from_of(mesh, h)]).norm() *
                std::fabs(normal.dot(opening.outwards));
    }
    opening.end = !opening.pinhole() && facing < end_cosine * opening.length_m;
    openings.push_back(std::move(opening));
  }
  return openings;
}

void cap(Mesh& mesh, const Opening& opening) {
  const int middle = static_cast<int>(mesh.vertices.size());
  std::vector<std::array<int, 3>> lid;
  for (int h : opening.half_edges) lid.push_back({to_of(mesh, h), from_of(mesh, h), middle});
  mesh.vertices.push_back(opening.middle);
  mesh.triangles.insert(mesh.triangles.end(), lid.begin(), lid.end());
}

std::vector<Opening> close_all(Mesh& mesh) {
  Sheets sheets = sheets_of(mesh);
  orient(mesh, sheets);
  std::vector<Opening> openings = openings_of(mesh, sheets);
  for (const Opening& opening : openings) cap(mesh, opening);
  return openings;
}

void join(Mesh& mesh, const Opening& a, const Opening& b) {
  // Both rims as rows of vertices, the second reversed so that they run side by side.
  std::vector<int> from, to;
  for (int h : a.half_edges) from.push_back(from_of(mesh, h));
  for (int h : b.half_edges) to.push_back(from_of(mesh, h));
  std::reverse(to.begin(), to.end());
  const auto flat = [&](int v, const Opening& o) -> Eigen::Vector3d {
    const Eigen::Vector3d arm = mesh.vertices[v] - o.middle;
    return arm - arm.dot(a.outwards) * a.outwards;
  };
  std::size_t start = 0;
  double best = -2;
  for (std::size_t j = 0; j < to.size(); ++j)
    if (const double cosine = flat(from[0], a).normalized().dot(flat(to[j], b).normalized()); cosine > best)
      best = cosine, start = j;
  std::rotate(to.begin(), to.begin() + static_cast<long>(start), to.end());
  // Advance along the rim with the shorter next rung.
  const auto place = [&](const std::vector<int>& rim, std::size_t i) { return mesh.vertices[rim[i % rim.size()]]; };
  std::vector<std::array<int, 3>> band;
  for (std::size_t i = 0, j = 0; i < from.size() || j < to.size();) {
    const bool along_from = j == to.size() || (i < from.size() && (place(from, i + 1) - place(to, j)).norm() <=
                                                                      (place(to, j + 1) - place(from, i)).norm());
    const int f = from[i % from.size()], t = to[j % to.size()];
    if (along_from)
      band.push_back({from[(i + 1) % from.size()], f, t}), ++i;
    else
      band.push_back({f, t, to[(j + 1) % to.size()]}), ++j;
  }
  mesh.triangles.insert(mesh.triangles.end(), band.begin(), band.end());
}

bool reached_along(const Sheets& sheets, const std::vector<Eigen::Vector3d>& middles, int from, int to,
                   double limit_m) {
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  std::unordered_map<int, double> best;
  open.push({0, from});
  best[from] = 0;
  while (!open.empty()) {
    const auto [d, t] = open.top();
    open.pop();
    if (t == to) return true;
    if (d > best[t]) continue;
    for (int k = 0; k < 3; ++k) {
      const int o = sheets.opposite[3 * t + k];
      if (o < 0) continue;
      const double next = d + (middles[o / 3] - middles[t]).norm();
      const auto [entry, fresh] = best.try_emplace(o / 3, next);
      if (next + (middles[o / 3] - middles[to]).norm() > limit_m || (!fresh && entry->second <= next)) continue;
      entry->second = next;
      open.push({next, o / 3});
    }
  }
  return false;
}

}  // namespace ostium::vascular
