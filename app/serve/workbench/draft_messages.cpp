#include "app/serve/workbench/draft_messages.h"

#include <cmath>
#include <cstring>

#include "app/serve/messages/jpeg.h"
#include "core/base/units.h"
#include "vascular/geometry/remesh/decimate.h"

namespace ostium::app {

using Json = nlohmann::ordered_json;
using units::mm;

namespace {

constexpr std::size_t most_triangles = 150'000;

double rounded(double metres) { return std::round(metres / mm * 1e3) / 1e3; }

Json point(const Eigen::Vector3d& p) { return {rounded(p.x()), rounded(p.y()), rounded(p.z())}; }
Json direction(const Eigen::Vector3d& unit) { return {unit.x(), unit.y(), unit.z()}; }

Json vessels_of(const vascular::Anatomy& anatomy) {
  Json out = Json::array();
  for (const vascular::Tube& tube : anatomy.tubes) {
    Json spheres = Json::array();
    for (const vascular::TubeNode& node : tube.nodes)
      for (const double number : {node.p.x(), node.p.y(), node.p.z(), node.radius_m, node.s_m})
        spheres.push_back(rounded(number));
    out.push_back({{"parent", tube.parent}, {"spheres", spheres}});
  }
  return out;
}

Json branches_of(const vascular::Anatomy& anatomy) {
  Json out = Json::array();
  for (const vascular::NamedBranch& branch : anatomy.branches)
    if (branch.length_m() > 0)
      out.push_back({{"name", branch.name},
                     {"vessel", branch.tube},
                     {"from_mm", rounded(branch.from_m)},
                     {"to_mm", rounded(branch.to_m)}});
  return out;
}

const char* words(vascular::CourseFault::Kind kind) {
  switch (kind) {
    case vascular::CourseFault::Kind::outside:
      return "outside of the lumen";
    case vascular::CourseFault::Kind::too_wide:
      return "spheres reach through the wall";
    case vascular::CourseFault::Kind::too_thin:
      return "spheres do not fill the lumen";
    case vascular::CourseFault::Kind::apart:
      return "does not begin in the vessel that it leaves";
  }
  return "";
}

Json faults_of(const std::vector<vascular::CourseFault>& faults) {
  Json out = Json::array();
  for (const vascular::CourseFault& fault : faults)
    out.push_back({{"words", words(fault.kind)},
                   {"vessel", fault.tube},
                   {"from_mm", rounded(fault.from_m)},
                   {"to_mm", rounded(fault.to_m)},
                   {"worst_mm", rounded(fault.worst_m)},
                   {"worst_at_mm", rounded(fault.worst_at_m)}});
  return out;
}

template <class Number>
void put(std::string& bytes, Number number) {
  char own[sizeof number];
  std::memcpy(own, &number, sizeof number);
  bytes.append(own, sizeof number);
}

std::string begun(char kind) { return std::string(1, kind) + std::string(7, '\0'); }

/// Larger triangles, all alike, where there are too many.
vascular::Mesh coarse(const vascular::Mesh& wall) {
  if (wall.triangles.size() <= most_triangles) return wall;
  double area_m2 = 0;
  for (const auto& t : wall.triangles) {
    const Eigen::Vector3d &a = wall.vertices[static_cast<std::size_t>(t[0])],
                          &b = wall.vertices[static_cast<std::size_t>(t[1])],
                          &c = wall.vertices[static_cast<std::size_t>(t[2])];
    area_m2 += (b - a).cross(c - a).norm() / 2;
  }
  const double edge_m = std::sqrt(4 / std::sqrt(3.0) * area_m2 / static_cast<double>(most_triangles));
  return decimate(wall, std::vector<double>(wall.vertices.size(), edge_m), 0);
}

}  // namespace

std::string draft_message(const data::CaseDraft& draft, const std::vector<vascular::CourseFault>& faults,
                          const std::string& mends) {
  const vascular::Anatomy anatomy = anatomy_of(draft.now());
  Json lesions = Json::array();  // where they lie in this person: a lesion may follow a branch
  for (vascular::Lesion lesion : draft.now().lesions) {
    place(anatomy, lesion);
    lesions.push_back(
        {{"branch", lesion.branch}, {"from_mm", rounded(lesion.from_m)}, {"length_mm", rounded(lesion.length_m)}});
  }
  const Json message = {
      {"type", "draft"},
      {"file", draft.file()},
      {"imported", draft.imported()},
      {"case", draft.json()},
      {"vessels", vessels_of(anatomy)},
      {"branches", branches_of(anatomy)},
      {"lesions", lesions},
      {"entry", {{"p", point(anatomy.landmarks.p_access)}, {"along", direction(anatomy.landmarks.access_direction)}}},
      {"faults", faults_of(faults)},
      {"mends", mends.empty() ? Json::array() : Json::parse(mends)},
      {"undo", draft.undoes()},
      {"redo", draft.redoes()},
      {"changed", draft.changed()}};
  return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string wall_bytes(const vascular::Mesh& wall) {
  const vascular::Mesh mesh = coarse(wall);
  std::string bytes = begun(4);
  put(bytes, static_cast<std::uint32_t>(mesh.vertices.size()));
  put(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Eigen::Vector3d& p : mesh.vertices)
    for (int i = 0; i < 3; ++i) put(bytes, static_cast<float>(p[i] / mm));
  for (const auto& t : mesh.triangles)
    for (const int v : t) put(bytes, static_cast<std::uint32_t>(v));
  return bytes;
}

std::string xray_bytes(double lao_deg, double cran_deg, const fluoro::Picture& picture) {
  std::string bytes = begun(5);
  put(bytes, static_cast<float>(lao_deg));
  put(bytes, static_cast<float>(cran_deg));
  return bytes + jpeg_of(picture);
}

}  // namespace ostium::app
