#include <fmt/format.h>

#include <algorithm>

#include "app/commands/import/imported.h"
#include "data/catalogue/case/mesh_picture.h"

namespace ostium::app {

bool is_coronary(const vascular::Anatomy& anatomy, int tube) {
  for (; tube >= 0; tube = anatomy.tubes[static_cast<std::size_t>(tube)].parent)
    for (const char* name : {"LAD", "LCx", "RCA"})
      if (anatomy.tubes[static_cast<std::size_t>(tube)].name == name) return true;
  return false;
}

void draw(const Imported& x, const std::string& file) {
  const vascular::Mesh mesh = x.patient.lumen.at(0, 0);
  std::vector<Eigen::Vector3d> rgb;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    Eigen::Vector3d colour = Eigen::Vector3d::Zero();
    double sum = 0;
    for (const vascular::TubeShare& share : x.patient.lumen.shares[v]) {
      const bool beats = v < x.patient.lumen.moving;
      colour += share.weight * (is_coronary(x.found.anatomy, share.tube) ? Eigen::Vector3d(214, 72, 60)
                                : beats                                  ? Eigen::Vector3d(220, 160, 150)
                                                                         : Eigen::Vector3d(205, 200, 192));
      sum += share.weight;
    }
    rgb.push_back(colour / std::max(sum, 1e-9));
  }
  std::vector<data::PictureMark> marks;
  for (const vascular::NamedBranch& b : x.found.anatomy.branches) {
    const vascular::Tube& tube = x.found.anatomy.tubes[static_cast<std::size_t>(b.tube)];
    marks.push_back({tube.at((b.from_m + b.to_m) / 2).p, b.name, {30, 60, 150}});
  }
  for (const vascular::RepairNote& note : x.repaired.notes)
    for (const Eigen::Vector3d& p : note.where)
      marks.push_back({x.found.R_PF * p - x.found.shift_P, "", {20, 140, 60}});
  marks.push_back({x.found.anatomy.landmarks.p_access, "entry", {200, 30, 160}});
  draw_mesh(file, mesh, rgb, marks, fmt::format("{}: red beats, green was mended, blue are branches", x.the_case.name));
}

}  // namespace ostium::app
