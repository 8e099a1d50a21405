#pragma once
/// A patient: the anatomy, its lesions, and the motion of both. Constant once made.
#include "vascular/anatomy/lesion.h"
#include "vascular/geometry/centreline/sphere_tree.h"
#include "vascular/motion/moving_lumen.h"

namespace ostium::vascular {

struct Patient {
  Anatomy anatomy;
  std::vector<Lesion> lesions;
  MovingLumen lumen;                                      ///< the healthy wall, and at lesions also the diseased one
  SphereTree tree;                                        ///< of the diseased lumen, at end-diastole
  std::vector<SphereTree> tree_frames;                    ///< the same in each frame of the cardiac cycle
  std::vector<std::vector<Eigen::Vector3d>> tree_breath;  ///< [branch][sphere] displacement at full inspiration, m
};

/// Takes about 2 s. Throws std::invalid_argument as build_anatomy and check(Lesion) do.
Patient make_patient(const AnatomyParameters& parameters, const std::vector<Lesion>& lesions);

/// From a given lumen: `anatomy` runs through it (anatomy/labelling/labelling.h); `lumen` is closed, in the patient
/// frame, at end-diastole, and its triangles are kept. `frames`: its vertices over one cycle from the R wave
/// (frames[f][v], beat_frames of them, the first equal to `lumen`); empty: modelled cardiac motion. Throws
/// std::invalid_argument as check(Lesion) does.
Patient make_patient(const Anatomy& anatomy, const Mesh& lumen, const std::vector<Lesion>& lesions,
                     const std::vector<std::vector<Eigen::Vector3d>>& frames = {});

}  // namespace ostium::vascular
