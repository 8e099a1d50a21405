#include "app/session/vessel/vessel.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "core/math/alignment.h"
#include "data/formats/load_error.h"
#include "vascular/geometry/centreline/centreline.h"
#include "vascular/geometry/mesh/bounding_volume_hierarchy.h"
#include "vascular/geometry/mesh/patient_frame.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/geometry/repair/repair.h"
#include "vascular/patient/wall.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr double folded_share = 0.05;  // crossing pairs per triangle; real patients' untidy meshes have 0.002

/// Patient frame, m.
const Vector3d in_the_ascending_aorta(-0.025, 0.014, 0.0155);

/// The operator's names for places of the aorta.
std::vector<std::pair<std::string, Vector3d>> places_of(const vascular::Patient& patient) {
  const vascular::Landmarks& marks = patient.anatomy.landmarks;
  std::vector<std::pair<std::string, Vector3d>> places;
  for (const vascular::TreeBranch& branch : patient.tree.branches) {
    if (branch.name != "aorta") continue;
    const auto best = [&](auto&& better) {
      const vascular::TreeSphere* found = &branch.spheres.front();
      for (const vascular::TreeSphere& sphere : branch.spheres)
        if (better(sphere.p, found->p)) found = &sphere;
      return found->p;
    };
    const auto nearest = [&](const Vector3d& p) {
      return best([&](const Vector3d& a, const Vector3d& b) { return (a - p).norm() < (b - p).norm(); });
    };
    const Vector3d top = best([](const Vector3d& a, const Vector3d& b) { return a.y() > b.y(); });
    places.emplace_back("diaphragm", nearest({0.009, -0.110, -0.055}));
    places.emplace_back("arch", top);
    places.emplace_back("ascending aorta", nearest(in_the_ascending_aorta));
    places.emplace_back("sinuses", nearest(marks.p_right_ostium));
    places.emplace_back("valve", nearest(marks.p_annulus));
  }
  return places;
}

/// The tree's frames with the ventricle added as a branch of the aorta, so that a tip in it can be located.
std::vector<vascular::SphereTree> with_ventricle(std::vector<vascular::SphereTree> frames,
                                                 const vascular::Ventricle& ventricle,
                                                 const vascular::Landmarks& marks) {
  if (ventricle.spheres.empty()) return frames;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    vascular::TreeBranch branch{
        .name = "left ventricle", .parent = -1, .parent_sphere = -1, .spheres = ventricle.spheres};
    for (std::size_t k = 0; k < branch.spheres.size(); ++k) {
      // No sphere reaches up through the valve, where a tip is in a sinus.
      vascular::TreeSphere& sphere = branch.spheres[k];
      const double below_m = (marks.p_annulus - ventricle.spheres[k].p).dot(marks.root_axis);
      sphere.p = ventricle.centres[f][k], sphere.radius_m = std::clamp(below_m - 1e-3, 0.5e-3, sphere.radius_m);
    }
    double least = 1;
    for (std::size_t b = 0; b < frames[f].branches.size(); ++b)
      for (std::size_t k = 0; k < frames[f].branches[b].spheres.size(); ++k) {
        if (frames[f].branches[b].name != "aorta") continue;
        const double d = (frames[0].branches[b].spheres[k].p - ventricle.spheres.front().p).norm();
        if (d < least) least = d, branch.parent = static_cast<int>(b), branch.parent_sphere = static_cast<int>(k);
      }
    frames[f].branches.push_back(std::move(branch));
  }
  return frames;
}

/// The same for the displacement of the tree's spheres at full inspiration.
std::vector<std::vector<Vector3d>> with_ventricle(std::vector<std::vector<Vector3d>> breath,
                                                  const vascular::Ventricle& ventricle,
                                                  const vascular::Landmarks& marks) {
  if (ventricle.spheres.empty() || breath.empty()) return breath;
  const vascular::HeartMotion motion(marks);
  std::vector<Vector3d>& own = breath.emplace_back();
  for (const vascular::TreeSphere& sphere : ventricle.spheres) own.push_back(motion.breath_displacement(sphere.p, 1));
  return breath;
}

/// The wall before opened_wall.h changes it.
core::SurfaceDescription untreated_wall(const Coronaries& coronaries) {
  std::vector<double> radii;
  for (const vascular::FlowCell& cell : coronaries.tree().cells) radii.push_back(cell.diseased_m);
  return coronaries.shape->wall(radii);
}

/// Middle of the bounding box.
Vector3d middle(const std::vector<Vector3d>& points) {
  Vector3d low = points.front(), high = low;
  for (const Vector3d& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return 0.5 * (low + high);
}

}  // namespace

double vessel_frame(const Vessel& vessel, double phase) {
  return vessel.beats() ? phase * static_cast<double>(vessel.wall.frames.size()) : 0;
}

double ascending_diameter_m(const Vessel& vessel) {
  if (!vessel.patient) return 0;
  const vascular::TreeSphere* nearest = nullptr;
  for (const vascular::TreeBranch& branch : vessel.patient->tree.branches)
    if (branch.name == "aorta")
      for (const vascular::TreeSphere& sphere : branch.spheres)
        if (!nearest || (sphere.p - in_the_ascending_aorta).norm() < (nearest->p - in_the_ascending_aorta).norm())
          nearest = &sphere;
  return nearest ? 2 * nearest->radius_m : 0;
}

Vector3d heart_middle(const vascular::Patient& patient) {
  const vascular::Landmarks& marks = patient.anatomy.landmarks;
  return middle({marks.p_left_ostium, marks.p_right_ostium, marks.p_lv_apex, marks.p_lv_base});
}

core::EndState end_at(const Vector3d& p_W, const Vector3d& direction_W) {
  const Eigen::Quaterniond q = core::rotation_between(Vector3d::UnitZ(), direction_W.normalized());
  core::EndState end;
  end.p_W = p_W;
  end.q_W = {q.w(), q.x(), q.y(), q.z()};
  return end;
}

std::shared_ptr<const Vessel> vessel_of(const data::Case& c, std::optional<std::uint64_t> seed) {
  const data::Case of_person = seed ? with_person(c, *seed) : c;
  auto vessel = std::make_shared<Vessel>();
  const auto patient = std::make_shared<const vascular::Patient>(patient_of(of_person));
  vessel->name = c.name;
  vessel->coronaries = make_coronaries(patient, c.rate_1_min);
  vessel->wall = vessel->coronaries ? untreated_wall(*vessel->coronaries) : wall_of(patient->lumen);
  if (const Coronaries* const own = vessel->coronaries.get())
    vessel->arteries = layout_of(own->tree(), own->map, vessel->wall);
  vessel->ventricle = add_ventricle(*patient, vessel->wall);
  vessel->wall.friction = vessel_friction;
  vessel->surface = std::make_shared<core::Surface>(make_surface(vessel->wall));
  const vascular::Landmarks& marks = patient->anatomy.landmarks;
  vessel->entry = end_at(marks.p_access, marks.access_direction);
  vessel->way = std::make_unique<const VesselIndex>(with_ventricle(patient->tree_frames, vessel->ventricle, marks),
                                                    marks.p_access, places_of(*patient),
                                                    with_ventricle(patient->tree_breath, vessel->ventricle, marks));
  vessel->p_middle = heart_middle(*patient);
  vessel->rate_1_min = c.rate_1_min;
  vessel->patient = patient;
  return vessel;
}

core::EndState entry_ahead_of(const std::string& artery, const Vessel& vessel) {
  constexpr double ahead_m = 12e-3, along_m = 6e-3;
  if (!vessel.coronaries) throw data::LoadError(vessel.name + ": a mesh has no ostium that is known");
  const vascular::FlowTree& tree = vessel.coronaries->tree();
  std::string known;
  for (const vascular::FlowBranch& branch : tree.branches) {
    if (branch.parent >= 0) continue;
    known += (known.empty() ? "" : ", ") + branch.name;
    if (branch.name != artery) continue;
    const auto centre = [&](int cell) {
      return vessel.coronaries->map.coronary.position(static_cast<std::size_t>(cell), 0);
    };
    const Vector3d p = centre(branch.first), in = (centre(tree.cell_at(tree.branch(artery), along_m)) - p).normalized();
    return end_at(p - ahead_m * in, in);
  }
  throw data::LoadError("begin: there is no artery \"" + artery +
                        "\" that leaves the aorta; expected one of: " + known);
}

namespace {

/// A word about an entry that leads into a wall; "": it leads along the vessel.
std::string doubt_of_entry(const vascular::Mesh& mesh, const MeshEntry& entry, const Vessel& vessel) {
  const int sphere = vessel.way->nearest(entry.p_P);
  double radius_m = 0;
  for (const vascular::TreeBranch& branch : vessel.way->branches())
    for (const vascular::TreeSphere& s : branch.spheres)
      if ((s.p - vessel.way->p(sphere, 0)).norm() < 1e-9) radius_m = s.radius_m;
  const Vector3d along = (entry.towards_P - entry.p_P).normalized();
  const auto hits = vascular::BoundingVolumeHierarchy(mesh).hits(entry.p_P + 1e-6 * along, along, 1.5 * radius_m);
  if (hits.empty()) return "";
  return fmt::format(
      "the entry leads into the wall after {:.1f} mm; a point further along the vessel as --towards leads on\n",
      1e3 * hits.front().distance_m);
}

}  // namespace

std::shared_ptr<const Vessel> vessel_of(const std::string& name, vascular::Mesh mesh, const MeshEntry& entry,
                                        std::string& warnings) {
  if (volume_m3(mesh) < 0) {
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    warnings = "it faced inwards, and was turned round\n";
  }
  const vascular::SurfaceReport report = check_surface(mesh);
  if (static_cast<double>(report.crossings.count) > folded_share * static_cast<double>(mesh.triangles.size()))
    throw data::LoadError(
        fmt::format("{}: {} pairs of its {} triangles cross, so it has no wall to hold an instrument; "
                    "`ostium check` shows where, `ostium import` may mend it",
                    name, report.crossings.count, mesh.triangles.size()));
  if (!report.sound()) warnings += describe(report);
  if (winding_number(mesh, entry.p_P) < 0.5) {
    const Vector3d mm = vascular::mm_from_patient(entry.p_P);
    throw data::LoadError(
        fmt::format("{}: the entry {:.1f}, {:.1f}, {:.1f} mm lies outside of the lumen; expected a point within", name,
                    mm.x(), mm.y(), mm.z()));
  }
  if (!((entry.towards_P - entry.p_P).norm() > 1e-4))
    throw data::LoadError(name + ": the entry and the point it leads towards are the same; expected two points");
  for (const vascular::Mesh& piece : vascular::components_of(mesh))
    if (winding_number(piece, entry.p_P) >= 0.5 && winding_number(piece, entry.towards_P) < 0.5 &&
        winding_number(mesh, entry.towards_P) >= 0.5)
      throw data::LoadError(name +
                            ": the entry leads towards a point that lies in another piece of the mesh; expected "
                            "one in the same piece");
  auto vessel = std::make_shared<Vessel>();
  vessel->name = name;
  vessel->wall.frames = {mesh.vertices};
  vessel->wall.triangles = mesh.triangles;
  vessel->wall.friction = vessel_friction;
  vessel->surface = std::make_shared<core::Surface>(make_surface(vessel->wall));
  vessel->p_middle = middle(mesh.vertices);
  vessel->entry = end_at(entry.p_P, entry.towards_P - entry.p_P);
  vascular::CentrelineOptions options;
  options.start = entry.p_P;
  options.most_voxels = 3'000'000;
  vessel->way =
      std::make_unique<const VesselIndex>(std::vector<vascular::SphereTree>{find_centrelines(mesh, options).tree},
                                          entry.p_P, std::vector<std::pair<std::string, Vector3d>>{});
  warnings += doubt_of_entry(mesh, entry, *vessel);
  return vessel;
}

}  // namespace ostium::app
