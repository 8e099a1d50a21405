#include "vascular/patient.h"

#include "vascular/shape/contour.h"

namespace ostium {

Patient make_patient(const AnatomyParameters& parameters, const std::vector<Lesion>& lesions) {
  Patient patient{.anatomy = build_anatomy(parameters), .lesions = lesions, .lumen = {}, .tree = {}, .tree_frames = {}};
  const Anatomy& anatomy = patient.anatomy;
  for (const Lesion& lesion : lesions) check(anatomy, lesion);
  const TubeUnion tubes(anatomy.tubes);
  const HeartMotion motion(anatomy.landmarks);
  const TubeMotion tube_motion(anatomy, motion);
  patient.lumen = make_moving_lumen(anatomy, lesions, motion, tube_motion, contour(tubes));
  patient.tree = tree_of(anatomy, lesions, patient.lumen.at(0, 0));
  for (int f = 0; f < beat_frames; ++f) patient.tree_frames.push_back(carried(patient.tree, anatomy, tube_motion, f));
  return patient;
}

}  // namespace ostium
