#include "vascular/patient/patient.h"

#include "core/base/parallel_loop.h"
#include "vascular/anatomy/labelling/shares.h"
#include "vascular/geometry/implicit/contour.h"
#include "vascular/patient/patient_tree.h"

namespace ostium::vascular {

namespace {

constexpr int path_smoothing = 12;  // for a lumen whose tubes were derived from it

/// `frames`: of the wall itself; empty: the tubes move it.
void make_beat(Patient& patient, Contour wall, int smoothing,
               const std::vector<std::vector<Eigen::Vector3d>>& frames = {}) {
  const Anatomy& anatomy = patient.anatomy;
  const HeartMotion motion(anatomy.landmarks);
  const TubeMotion tube_motion =
      frames.empty() ? TubeMotion(anatomy, motion) : TubeMotion(anatomy, wall.mesh.vertices, wall.shares, frames);
  patient.lumen = make_moving_lumen(anatomy, patient.lesions, motion, tube_motion, std::move(wall), smoothing, frames);
  patient.tree = tree_of(anatomy, patient.lesions, patient.lumen.at(0, 0));
  for (int f = 0; f < beat_frames; ++f) patient.tree_frames.push_back(carried(patient.tree, anatomy, tube_motion, f));
  if (!frames.empty())
    core::in_parallel(patient.tree_frames.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f)
        fit_radii(patient.tree_frames[f], patient.lumen.at(static_cast<double>(f) / beat_frames, 0));
    });
  patient.tree_breath = breath_of(patient.tree, anatomy, motion, tube_motion);
}

}  // namespace

Patient make_patient(const AnatomyParameters& parameters, const std::vector<Lesion>& lesions) {
  Patient patient{.anatomy = build_anatomy(parameters),
                  .lesions = lesions,
                  .lumen = {},
                  .tree = {},
                  .tree_frames = {},
                  .tree_breath = {}};
  for (const Lesion& lesion : lesions) check(patient.anatomy, lesion);
  make_beat(patient, contour(TubeUnion(patient.anatomy.tubes)), 0);
  return patient;
}

Patient make_patient(const Anatomy& anatomy, const Mesh& lumen, const std::vector<Lesion>& lesions,
                     const std::vector<std::vector<Eigen::Vector3d>>& frames) {
  Patient patient{
      .anatomy = anatomy, .lesions = lesions, .lumen = {}, .tree = {}, .tree_frames = {}, .tree_breath = {}};
  for (const Lesion& lesion : lesions) check(anatomy, lesion);
  make_beat(patient, {.mesh = lumen, .shares = shares_of(lumen, anatomy.tubes)}, frames.empty() ? path_smoothing : 0,
            frames);
  return patient;
}

}  // namespace ostium::vascular
