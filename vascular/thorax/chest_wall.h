#pragma once
/// The chest's wall: the rib cage, which the ribs follow and the lungs fill, and the skin. Frame P, mm where a name
/// says so.
#include "core/base/units.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

/// The sagittal plane: three fifths of the heart lie to the left of it.
inline constexpr double middle_x = -16 * units::mm;

/// Where the cage lies at a height and an angle from the back (0) by the side (a right angle) to the front, `margin_mm`
/// outside of it: x from the sagittal plane, and z. In front an ellipse; behind squarer, since on both sides of the
/// spine the lungs reach farther back than the vertebral bodies, to the ribs' angles.
Eigen::Vector2d cage_mm(double angle_rad, double y_mm, double margin_mm);
/// Distance to the cage less `margin_mm`, near it; negative inside.
double from_cage_mm(const Eigen::Vector3d& p_mm, double margin_mm);
/// Half axes of the cage, in x and z.
Eigen::Vector2d cage_half_axes_mm(double y_mm);

/// Skin, closed. Pleura to skin: 30 to 40 mm at the side and in front (chest tubes and needles: Laan 2016, Injury
/// 47:797); behind, beside the spine, the muscles that hold it upright make it 45 to 55 mm deep, as blocks of the
/// nerves there find it (Naja 2001, Reg Anesth Pain Med) [both from memory].
Mesh skin();
/// Half axes that lie within the skin everywhere, in x and z.
Eigen::Vector2d within_skin_mm();

}  // namespace ostium::vascular
