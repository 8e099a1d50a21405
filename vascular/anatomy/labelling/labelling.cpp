#include "vascular/anatomy/labelling/labelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/units.h"
#include "vascular/anatomy/labelling/axis_scale.h"
#include "vascular/anatomy/labelling/branch_names.h"
#include "vascular/anatomy/labelling/heart_match.h"
#include "vascular/anatomy/labelling/landmarks.h"
#include "vascular/anatomy/lumen/tubes_of_tree.h"
#include "vascular/geometry/centreline/centreline.h"

namespace ostium::vascular {

namespace {

using units::mm, units::degree;
constexpr double most_turned = 40 * degree;  // the file's axes are kept if the anatomy is turned by less

/// Rotation from the file's axes to the patient's.
Eigen::Matrix3d settled_axes(const LabellingOptions& options, const Similarity* aorta, const Similarity* heart,
                             std::vector<std::string>& notes) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  if (options.axes) {
    R = *options.axes;
  } else if (!aorta && !heart) {
    notes.push_back(
        "neither aorta nor heart was recognised: vessels have numbers and stay still, and the file's axes are taken "
        "as left, head, front");
  } else {
    const Eigen::Matrix3d found = (aorta ? aorta->R : heart->R).transpose();
    double turn = 0;
    R = nearest_axes(found, &turn);
    if (turn > most_turned) {
      R = found;
      notes.push_back(fmt::format(
          "the anatomy is turned by {:.0f} degrees from any axes: it was turned to stand as the mean one does",
          turn / degree));
    }
  }
  return R;
}

/// Recomputes the tree with its ends in order of importance: the first ones become the main branches. A part in which
/// nothing was recognised goes from lid to lid, wherever its aorta or artery was thought to begin.
void find_tree_anew(LumenPart& part, std::vector<std::string>& notes) {
  if (part.roles.empty()) {
    CentrelineResult found = find_centrelines(part.mesh);
    part.tree = std::move(found.tree);
    for (const Eigen::Vector3d& p : found.cuts)
      notes.push_back(
          fmt::format("a loop was cut open at {:.1f} {:.1f} {:.1f} mm in the file's axes: vessels are a tree",
                      p.x() / mm, p.y() / mm, p.z() / mm));
    return;
  }
  // An aorta's valve and an artery's bed are not where a lid was put.
  CentrelineOptions wanted{.start = part.root, .ends = {}, .to_lids = false};
  for (const LumenPart::Role& role : part.roles) wanted.ends.push_back(role.end);
  std::vector<const Course*> rest;
  for (const Course& course : part.courses) rest.push_back(&course);
  std::stable_sort(rest.begin(), rest.end(),
                   [](const Course* a, const Course* b) { return a->length_m() > b->length_m(); });
  std::vector<Eigen::Vector3d> others;
  for (const Course* course : rest) others.push_back(course->spheres.back().p);
  others.push_back(part.courses[0].spheres.front().p);
  for (const Eigen::Vector3d& end : others) {
    bool there = (end - part.root).norm() < 2 * mm;
    for (const Eigen::Vector3d& other : wanted.ends) there = there || (end - other).norm() < 1e-9;
    if (!there) wanted.ends.push_back(end);
  }
  part.tree = find_centrelines(part.mesh, wanted).tree;
}

void turn(const Eigen::Matrix3d& R, LumenPart& part) {
  for (TreeBranch& branch : part.tree.branches)
    for (TreeSphere& sphere : branch.spheres) sphere.p = R * sphere.p;
  for (LumenPart::Role& role : part.roles) role.end = R * role.end;
}

void move_to_ostium(LabelledVessels& out) {
  const Eigen::Vector3d shift = out.anatomy.landmarks.p_left_ostium;
  out.shift_P = shift;
  Landmarks& m = out.anatomy.landmarks;
  for (Eigen::Vector3d* p :
       {&m.p_access, &m.p_left_ostium, &m.p_right_ostium, &m.p_annulus, &m.p_lv_base, &m.p_lv_apex})
    *p -= shift;
  for (Tube& tube : out.anatomy.tubes)
    for (TubeNode& node : tube.nodes) node.p -= shift;
  for (Eigen::Vector3d& p : out.lumen.vertices) p -= shift;
}

/// Whether coronary arteries would be recognised in its mirror image: an export of left-handed axes, or with one turned
/// round alone.
bool is_mirrored(const Mesh& lumen, const MeanCourses& mean, const Progress& say) {
  say("looking at its mirror image");
  Mesh image = lumen;
  for (Eigen::Vector3d& p : image.vertices) p.x() = -p.x();
  for (auto& t : image.triangles) std::swap(t[1], t[2]);
  std::vector<LumenPart> parts = lumen_parts(image, [](const std::string&) {});
  std::optional<AortaMatch> aorta = match_aorta(parts.front(), mean, [](const std::string&) {});
  if (aorta && aorta->doubt >= 1) aorta.reset();
  std::vector<std::string> notes;
  const std::optional<HeartMatch> heart = match_heart(parts, aorta ? &*aorta : nullptr, mean, false, notes);
  return heart && heart->doubt < 1;
}

/// In the axes of the file.
void note_axis_scale(const Mesh& lumen, LabelledVessels& out) {
  std::vector<Tube> tubes = out.anatomy.tubes;
  for (Tube& tube : tubes)
    for (TubeNode& node : tube.nodes) node.p = out.R_PF.transpose() * (node.p + out.shift_P);
  if (const std::optional<AxisScale> scale = find_axis_scale(lumen, tubes))
    out.notes.push_back(fmt::format(
        "its vessels are {} along the file's {} axis, {:.2g} times as wide there as along the others, which in healthy "
        "ones differ by 2 %: was the spacing of slices left out? Scale that axis, and import it again",
        scale->share < 1 ? "flat" : "drawn out", "xyz"[scale->axis], scale -> share));
}

}  // namespace

LabelledVessels label_vessels(const Mesh& lumen, const LabellingOptions& options) {
  const Progress say = [&](const std::string& what) {
    if (options.progress) options.progress(what);
  };
  const MeanCourses mean = mean_courses();
  LabelledVessels out;
  std::vector<LumenPart> parts = lumen_parts(lumen, say);
  std::optional<AortaMatch> aorta;
  std::optional<HeartMatch> heart;
  if (options.heart != HeartSearch::none) {
    aorta = match_aorta(parts.front(), mean, say);
    if (aorta) out.aorta_doubt = aorta->doubt;
    if (out.aorta_doubt >= 1) aorta.reset();
    const bool assumed = options.heart == HeartSearch::assumed;
    heart = match_heart(parts, aorta ? &*aorta : nullptr, mean, assumed, out.notes);
    if (aorta && !aorta->arch && !assumed && !(heart && heart->doubt < 1)) {
      out.notes.push_back(
          "the widest vessel is bent like an aorta, but no branches leave it as an arch's and coronary arteries do: it "
          "is not named one; --motion coronary takes it for one all the same");
      out.aorta_doubt = std::numeric_limits<double>::infinity();
      aorta.reset();
      heart = match_heart(parts, nullptr, mean, assumed, out.notes);
    }
    if (assumed && !heart && !aorta)
      throw MeshError(
          "nothing in it can be a coronary artery, at least 25 mm long and less than 7 mm wide, or is bent like an "
          "aorta; expected one of them, or that none is assumed");
    if (aorta) {
      std::vector<LumenPart::Role>& roles = parts.front().roles;
      roles.insert(roles.begin(), {aorta->course.spheres.back().p, "aorta"});
    }
    if (heart) out.heart_doubt = heart->doubt;
    if (out.heart_doubt >= 1 && !assumed) heart.reset();
    if (!heart && !assumed && (aorta || out.heart_doubt > 0) && is_mirrored(lumen, mean, say))
      out.notes.push_back(
          "its mirror image has coronary arteries, and it has none: an export turned one axis round, or its axes are "
          "left-handed; mirror it back (x to -x) and import that");
  }
  out.heart = heart.has_value();
  if (aorta) out.aorta_rms_m = aorta->fit.rms_m;
  if (heart) out.heart_rms_m = heart->fit.rms_m;
  out.R_PF = settled_axes(options, aorta ? &aorta->fit : nullptr, heart ? &heart->fit : nullptr, out.notes);
  for (LumenPart& part : parts) {
    say("naming branches");
    find_tree_anew(part, out.notes);
  }

  // From here on everything is in the patient's axes.
  const Eigen::Matrix3d& R = out.R_PF;
  for (LumenPart& part : parts) turn(R, part);
  out.lumen = lumen;
  for (Eigen::Vector3d& p : out.lumen.vertices) p = R * p;
  Similarity fit = heart ? heart->fit : aorta ? aorta->fit : Similarity{};
  fit.R = R * fit.R, fit.shift = R * fit.shift;
  std::map<std::string, Eigen::Vector3d> ostia;
  if (heart)
    for (const auto& [name, p] : heart->ostia) ostia[name] = R * p;

  std::vector<double> leaves_m;
  out.anatomy.aorta = aorta.has_value();
  for (const LumenPart& part : parts) add_tubes(part, out.anatomy.tubes, leaves_m);
  name_branches(leaves_m, options.names, out.anatomy, out.notes);
  std::optional<Eigen::Vector3d> entry;
  if (options.entry) entry = R * *options.entry;
  set_landmarks({mean.anatomy.landmarks, fit, ostia, entry}, out.anatomy, out.notes);
  move_to_ostium(out);
  note_axis_scale(lumen, out);
  return out;
}

}  // namespace ostium::vascular
