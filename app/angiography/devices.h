#pragma once
/// Balloon, stents, wire and what has left the vessel, as an X-ray meets them; on the path of a plan.
#include "app/angiography/angioplasty.h"

namespace ostium {

/// Adds to `scene.scene()` what lies in the vessel at this moment; call after scene.at().
void add_devices(const Bedside& bed, const Plan& plan, const Patient& patient, PatientScene& scene, bool wire);

}  // namespace ostium
