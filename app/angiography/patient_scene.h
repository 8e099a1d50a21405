#pragma once
/// A patient under X-rays: thorax and lumen as bodies, carried by beat and breath, with the iodine that is in them.
#include "fluoro/scene.h"
#include "vascular/contrast/opacity.h"
#include "vascular/patient.h"
#include "vascular/physiology.h"
#include "vascular/plaque/wall_shape.h"
#include "vascular/thorax/thorax.h"

namespace ostium {

class PatientScene {
 public:
  /// Keeps references. Takes some seconds: the thorax is contoured.
  PatientScene(const Patient& patient, const PhysiologyModel& physiology);

  /// The patient at this moment; what the caller has added to `scene()` since is taken out.
  const Scene& at(const PhysiologyState& state, std::span<const double> occupied_m, double breath_depth = 0);
  Scene& scene() { return scene_; }
  Body& lumen() { return scene_.moving[thorax_.size()]; }
  const LumenMap& map() const { return map_; }
  const WallShape& shape() const { return shape_; }

 private:
  const Patient& patient_;
  const PhysiologyModel& physiology_;
  LumenMap map_;
  WallShape shape_;
  std::vector<XrayBody> thorax_;  ///< those that move
  Scene scene_;
  std::size_t own_ = 0;  ///< bodies of the patient; others stand behind them
  OpacityScratch scratch_;
  std::vector<Eigen::Vector3d> vertices_;
};

}  // namespace ostium
