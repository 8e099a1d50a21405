#include "app/angiography/cut_surface.h"

#include <algorithm>
#include <map>
#include <set>

#include "app/angiography/xray_body.h"

namespace ostium::app {

namespace {

/// Edges of kept triangles that no other kept triangle shares, joined into loops.
std::vector<std::vector<int>> loops_of(std::set<std::pair<int, int>> edges) {
  std::multimap<int, int> next;
  for (const auto& [from, to] : edges)
    if (!edges.contains({to, from})) next.emplace(from, to);
  std::vector<std::vector<int>> loops;
  while (!next.empty()) {
    std::vector<int> loop{next.begin()->first};
    for (int to = next.begin()->second;; to = next.find(to)->second) {
      next.erase(std::find_if(next.begin(), next.end(),
                              [&](const auto& e) { return e.first == loop.back() && e.second == to; }));
      if (to == loop.front()) break;
      loop.push_back(to);
      if (!next.contains(to)) break;
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

}  // namespace

CutSurface cut_out(const std::vector<Corners>& triangles, std::size_t vertices,
                   const std::function<bool(const Corners&)>& kept) {
  std::vector<bool> is_kept(triangles.size()), meets_others(vertices, false);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    is_kept[t] = kept(triangles[t]);
    if (!is_kept[t])
      for (int v : triangles[t]) meets_others[static_cast<std::size_t>(v)] = true;
  }
  CutSurface out;
  std::vector<int> number(vertices, -1);
  std::vector<Corners> own;
  std::set<std::pair<int, int>> edges;  // those that may be a rim's: few
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!is_kept[t]) continue;
    Corners mine;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(triangles[t][k]);
      if (number[v] < 0) number[v] = static_cast<int>(out.vertices.size()), out.vertices.push_back(triangles[t][k]);
      mine[k] = number[v];
    }
    own.push_back(mine);
    for (std::size_t k = 0; k < 3; ++k)
      if (meets_others[static_cast<std::size_t>(triangles[t][k])] &&
          meets_others[static_cast<std::size_t>(triangles[t][(k + 1) % 3])])
        edges.emplace(mine[k], mine[(k + 1) % 3]);
  }
  out.rims = loops_of(std::move(edges));
  int lid = static_cast<int>(out.vertices.size());
  for (const std::vector<int>& rim : out.rims) {
    for (std::size_t i = 0; i < rim.size(); ++i) own.push_back({rim[(i + 1) % rim.size()], rim[i], lid});
    ++lid;
  }
  out.triangles = triangles_of(own);
  return out;
}

}  // namespace ostium::app
