#pragma once
/// Balloons, stents and what has left the vessel, as an X-ray meets them: on a path of the arteries, at a phase
/// and a depth of breath.
#include "app/angiography/angioplasty.h"

namespace ostium {

/// What is in it, if that is any; `markers`: their bands, where no rod's shaft has them.
void add_balloon(const BalloonModel& model, const BalloonState& state, const VesselPath& path, double middle_m,
                 const LumenMap& map, double phase, double breath, bool markers, Scene& scene);
/// Its struts: in the wall, or crimped on the path.
void add_stent(const StentModel& model, const StentState& state, const VesselPath& path, const Patient& patient,
               const LumenMap& map, const WallShape& shape, std::span<const double> radius_m, double phase,
               double breath, Scene& scene);
/// Contrast and blood beside the lumen.
void add_pools(const InjuryState& injury, const LumenMap& map, std::span<const double> radius_m, double phase,
               double breath, Scene& scene);

/// Adds to `scene.scene()` what lies in the vessel at this moment; call after scene.at().
void add_devices(const Bedside& bed, const Plan& plan, const Patient& patient, PatientScene& scene, bool wire);

}  // namespace ostium
