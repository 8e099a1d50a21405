#pragma once
/// The left ventricle behind the aortic valve: a simple cavity, with the valve as a door in the contact wall.
///
/// An anatomy's lumen ends at the closed leaflets. In a session's wall, the leaflets between the sinuses, a disc about
/// the root's axis, become the valve. Wires pass it while it is open (in systole, or while something already lies
/// across it); catheters, being thicker, land on it. Behind it are an outflow tract and a cavity along the ventricle's
/// axis, as wide as the blood pool in thorax/. Its walls move as given by HeartMotion, clear of the coronary arteries.
/// The lumen used by X-ray, flow and tree is unchanged.
#include "core/wall/surface.h"
#include "vascular/patient/patient.h"

namespace ostium::vascular {

inline constexpr double valve_radius_m = 7e-3;     ///< of the disc: an opening of 1.5 cm2; a healthy valve has 3 to 4
inline constexpr double valve_passes_m = 0.55e-3;  ///< radius: wires up to 0.038 in

struct Ventricle {
  std::vector<TreeSphere> spheres;                    ///< along its centreline, from valve to apex, at end-diastole
  std::vector<std::vector<Eigen::Vector3d>> centres;  ///< their centres in each frame of the cardiac cycle
};

/// Appends the ventricle to `wall`, which has the vertices and triangles of the patient's lumen in each frame of the
/// cardiac cycle. Returns an empty one and leaves `wall` unchanged if the anatomy has no aorta or its floor is not a
/// disc (a mesh that was cut above it).
Ventricle add_ventricle(const Patient& patient, core::SurfaceDescription& wall);

/// Whether the aortic valve is open at a cardiac phase if nothing lies across it.
bool valve_is_open(double phase);

}  // namespace ostium::vascular
