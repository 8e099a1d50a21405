#pragma once
/// A patient under X-rays: thorax and lumen as bodies, carried by beat and breath, with the iodine that is in them.
#include "fluoro/scene.h"
#include "vascular/contrast/lumen_map.h"
#include "vascular/patient.h"
#include "vascular/physiology.h"
#include "vascular/thorax/thorax.h"

namespace ostium {

class PatientScene {
 public:
  /// Keeps references. Takes some seconds: the thorax is contoured.
  PatientScene(const Patient& patient, const PhysiologyModel& physiology);

  /// Everything at this moment; `scene.shafts` and further bodies are the caller's.
  const Scene& at(const PhysiologyState& state, std::span<const double> occupied_m, double breath_depth = 0);
  Scene& scene() { return scene_; }
  Body& lumen() { return scene_.moving[thorax_.size()]; }
  const LumenMap& map() const { return map_; }

 private:
  const Patient& patient_;
  const PhysiologyModel& physiology_;
  LumenMap map_;
  std::vector<XrayBody> thorax_;  ///< those that move
  Scene scene_;
  OpacityScratch scratch_;
};

}  // namespace ostium
