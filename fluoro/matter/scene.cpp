#include "fluoro/matter/scene.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace ostium::fluoro {

namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw std::invalid_argument("X-ray scene: body \"" + name + "\" " + what);
}

std::string in_mm(const Eigen::Vector3f& p_P) {
  const auto mm = [](float m) { return std::to_string(static_cast<int>(1000 * m)); };
  return "(" + mm(p_P.x()) + ", " + mm(p_P.y()) + ", " + mm(p_P.z()) + ") mm";
}

/// Half-edges, both directions of an edge under one key; in a closed surface the two are equally frequent.
void require_closed(const Body& body) {
  std::vector<std::pair<std::uint64_t, int>> edges;
  edges.reserve(3 * static_cast<std::size_t>(body.triangles->cols()));
  for (const auto& t : body.triangles->colwise())
    for (int i = 0; i < 3; ++i) {
      const auto a = static_cast<std::uint32_t>(t[i]), b = static_cast<std::uint32_t>(t[(i + 1) % 3]);
      edges.emplace_back(std::uint64_t(std::min(a, b)) << 32 | std::max(a, b), a < b ? 1 : -1);
    }
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0;
  std::uint64_t first = 0;
  for (std::size_t i = 0; i < edges.size();) {
    int balance = 0;
    const std::uint64_t key = edges[i].first;
    for (; i < edges.size() && edges[i].first == key; ++i) balance += edges[i].second;
    if (balance != 0 && open++ == 0) first = key >> 32;
  }
  if (open)
    refuse(body.name, "is not closed: " + std::to_string(open) + " open edges, the first near " +
                          in_mm(body.p_P.col(static_cast<Eigen::Index>(first))) +
                          "; X-ray thickness needs an inside. Close its holes and turn its triangles one way.");
}

}  // namespace

bool is_seen(const Contrast& contrast) {
  return contrast.iodine_kg_m3.size() > 0 && contrast.iodine_kg_m3.maxCoeff() > faintest_iodine_kg_m3;
}

void set_still(const std::function<bool(int vertex)>& rests, Body& body) {
  Triangles sorted(3, body.triangles->cols());
  std::vector<int> corners;
  std::vector<bool> is_listed(static_cast<std::size_t>(body.p_P.cols()), false);
  Eigen::Index first = 0, last = sorted.cols();
  for (const auto& t : body.triangles->colwise()) {
    if (rests(t[0]) && rests(t[1]) && rests(t[2])) {
      sorted.col(first++) = t;
      continue;
    }
    sorted.col(--last) = t;
    for (int v : t)
      if (!is_listed[static_cast<std::size_t>(v)]) is_listed[static_cast<std::size_t>(v)] = true, corners.push_back(v);
  }
  std::sort(corners.begin(), corners.end());
  body.triangles = std::make_shared<const Triangles>(std::move(sorted));
  body.still = static_cast<int>(first);
  body.corners = std::make_shared<const std::vector<int>>(std::move(corners));
}

void check(const Body& body) {
  if (!body.triangles || body.triangles->cols() == 0) refuse(body.name, "has no triangles");
  if (body.triangles->minCoeff() < 0 || body.triangles->maxCoeff() >= body.p_P.cols())
    refuse(body.name,
           "has a triangle with a corner that is not among its " + std::to_string(body.p_P.cols()) + " vertices");
  if (!body.p_P.allFinite()) refuse(body.name, "has a vertex that is not a number");
  const Contrast& c = body.contrast;
  if (c.iodine_kg_m3.size() != c.p_PC.cols() || (c.iodine_kg_m3.size() && c.iodine_kg_m3.size() != body.p_P.cols()))
    refuse(body.name, "has contrast that is not given at each vertex");
  if (c.along_kg_m2.size() && c.along_kg_m2.cols() != c.p_PC.cols())
    refuse(body.name, "has contrast along its centreline that is not given at each vertex");
  if (c.iodine_kg_m3.size() && !(c.iodine_kg_m3.minCoeff() >= 0)) refuse(body.name, "has a negative concentration");
  if (body.still < 0 || body.still > body.triangles->cols() || (body.still > 0 && !body.corners))
    refuse(body.name, "has triangles that rest, but not the corners of the others; set_still sets both");
  require_closed(body);
}

void check(const Scene& scene) {
  if (scene.fixed)
    for (const Body& body : *scene.fixed) check(body);
  for (const Body& body : scene.moving) {
    check(body);
    if (body.still > 0 && !scene.fixed) refuse(body.name, "has triangles that rest, in a scene without fixed bodies");
  }
  for (const Shaft& shaft : scene.shafts)
    if (shaft.p_P.cols() < 2 || !shaft.p_P.allFinite() ||
        (shaft.lumen_iodine_kg_m3.size() && shaft.lumen_iodine_kg_m3.size() != shaft.p_P.cols()) ||
        (shaft.v_P.size() && (shaft.v_P.cols() != shaft.p_P.cols() || !shaft.v_P.allFinite())))
      throw std::invalid_argument("X-ray scene: shaft \"" + shaft.name +
                                  "\" needs two points or more, and contrast and velocity at each or none");
}

}  // namespace ostium::fluoro
