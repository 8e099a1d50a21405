#pragma once
/// A patient: the anatomy, its lesions, and how both beat. Const after it is made.
#include "vascular/anatomy/lesion.h"
#include "vascular/geometry/centreline/sphere_tree.h"
#include "vascular/motion/moving_lumen.h"

namespace ostium::vascular {

struct Patient {
  Anatomy anatomy;
  std::vector<Lesion> lesions;
  MovingLumen lumen;                    ///< of the healthy wall; where lesions are, of the diseased one too
  SphereTree tree;                      ///< of the diseased lumen, at end-diastole
  std::vector<SphereTree> tree_frames;  ///< the same, carried along the beat: beat_frames of them
  std::vector<std::vector<Eigen::Vector3d>> tree_breath;  ///< [branch][sphere] displacement at the top of a breath, m
};

/// Takes about 2 s. Throws std::invalid_argument, as build_anatomy and check(Lesion) do.
Patient make_patient(const AnatomyParameters& parameters, const std::vector<Lesion>& lesions);

/// Of someone's own lumen: `anatomy` runs through it (anatomy/labelling/recognise.h), `lumen` is closed, in the patient
/// frame, at end-diastole, and its triangles stay as they are. `frames`: its vertices through one beat from the R wave
/// on (frames[f][v], beat_frames of them, the first those of `lumen`); empty: it beats as we know that hearts do.
/// Throws std::invalid_argument as check(Lesion) does.
Patient make_patient(const Anatomy& anatomy, const Mesh& lumen, const std::vector<Lesion>& lesions,
                     const std::vector<std::vector<Eigen::Vector3d>>& frames = {});

}  // namespace ostium::vascular
