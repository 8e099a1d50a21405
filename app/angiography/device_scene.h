#pragma once
/// Balloons, stents and contrast outside the vessel as an X-ray sees them: on a path of the arteries, at a moment.
#include <functional>

#include "app/angiography/textbook_treatment.h"

namespace ostium::app {

/// The balloon's contents, if any; `markers`: also its marker bands, if no shaft draws them.
void add_balloon(const vascular::BalloonModel& model, const vascular::BalloonState& state,
                 const vascular::VesselPath& path, const vascular::LumenMap& map, const vascular::LumenMoment& moment,
                 bool markers, fluoro::Scene& scene);
/// The stent's struts: in the wall, or on the path, aside of it as far as its balloon is, if there is one.
void add_stent(const vascular::StentModel& model, const vascular::StentState& state, const vascular::VesselPath& path,
               const vascular::Patient& patient, const vascular::LumenMap& map, const vascular::WallShape& shape,
               std::span<const double> radius_m, const vascular::LumenMoment& moment,
               const std::function<Eigen::Vector2d(double s_m)>& aside_m, fluoro::Scene& scene);
/// Contrast and blood outside the lumen.
void add_pools(const vascular::InjuryState& injury, const vascular::LumenMap& map, std::span<const double> radius_m,
               const vascular::LumenMoment& moment, fluoro::Scene& scene);

/// Adds to `scene.scene()` the devices now in the vessel; call after scene.at().
void add_devices(const Bedside& bed, const Plan& plan, const vascular::Patient& patient, PatientScene& scene,
                 bool wire);

}  // namespace ostium::app
