#pragma once
/// The left ventricle behind the aortic valve: a plain cavity, and the valve as a door in the wall that contact knows.
///
/// The lumen of an anatomy ends on the closed leaflets. In the wall of a session the leaflets between the sinuses, a
/// disc about the root's axis, become the valve: what is no thicker than a wire passes it while it is open (systole, or
/// something lies through it already), catheters land on it. Behind it is an outflow tract and a cavity along the
/// ventricle's axis, as wide as the blood of thorax/; its walls move as HeartMotion says, and it lies free of the
/// coronary arteries. The lumen that X-rays, flow and tree know stays as it is.
#include "core/wall/surface.h"
#include "vascular/patient/patient.h"

namespace ostium::vascular {

inline constexpr double valve_radius_m = 7e-3;     ///< of the disc: an opening of 1.5 cm2, of 3 to 4 in a healthy valve
inline constexpr double valve_passes_m = 0.55e-3;  ///< radius: wires up to 0.038 in

struct Ventricle {
  std::vector<TreeSphere> spheres;                    ///< along its middle, from the valve to the apex, at end-diastole
  std::vector<std::vector<Eigen::Vector3d>> centres;  ///< of these, in each frame of the beat
};

/// Adds the ventricle to `wall`, which has the vertices and triangles of the patient's lumen in each frame of the beat,
/// behind its own. Empty, and `wall` as it was, if the anatomy has no aorta or its floor is no disc (somebody's mesh
/// that was cut above).
Ventricle add_ventricle(const Patient& patient, core::SurfaceDescription& wall);

/// Whether the aortic valve is open at a phase of the heart, if nothing lies through it.
bool valve_is_open(double phase);

}  // namespace ostium::vascular
