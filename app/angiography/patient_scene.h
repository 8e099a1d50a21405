#pragma once
/// A patient under X-rays: thorax, lumen and its twigs as bodies, moved by heartbeat and breath, with the iodine in the
/// vessels.
#include "app/angiography/lumen_body.h"
#include "app/angiography/twig_body.h"
#include "fluoro/matter/scene.h"
#include "vascular/contrast/opacity.h"
#include "vascular/patient/patient.h"
#include "vascular/physiology/physiology.h"
#include "vascular/thorax/thorax.h"
#include "vascular/treatment/wall_shape.h"

namespace ostium::app {

/// Throws LoadError if no coronary artery leaves an aorta, as in an imported part of one: there is no flow then.
vascular::PhysiologyModel circulation_of(const vascular::Patient& patient, const std::string& name, std::uint64_t seed);

class PatientScene {
 public:
  /// Keeps references. Takes some seconds: the thorax is contoured. `breathes`: what only the breath moves is not drawn
  /// once for all.
  PatientScene(const vascular::Patient& patient, const vascular::PhysiologyModel& physiology, bool breathes = false);
  /// The same patient with another session's physiology, in milliseconds: what is contoured is shared.
  PatientScene(const PatientScene& same, const vascular::PhysiologyModel& physiology);

  bool breathes() const { return breathes_; }
  /// The patient at this moment; removes whatever the caller has added to `scene()` since the last call. `breath_depth`
  /// counts if the patient breathes; `aside_P`: of LumenMoment.
  const fluoro::Scene& at(const vascular::PhysiologyState& state, std::span<const double> occupied_m,
                          double breath_depth = 0, std::span<const Eigen::Vector3d> aside_P = {});
  fluoro::Scene& scene() { return scene_; }
  fluoro::Body* lumen() { return lumen_.empty() ? nullptr : &scene_.moving[own_]; }  ///< null: nothing is filled
  const vascular::LumenMap& map() const { return map_; }
  const vascular::WallShape& shape() const { return shape_; }

 private:
  void add_twigs(const vascular::LumenMoment& moment);

  const vascular::Patient& patient_;
  const vascular::PhysiologyModel& physiology_;
  vascular::LumenMap map_;
  vascular::WallShape shape_;
  std::shared_ptr<const std::vector<vascular::XrayBody>> thorax_;  ///< the thorax bodies that move
  bool breathes_ = false;
  LumenBody lumen_;
  TwigBody twigs_;
  fluoro::Scene scene_;
  std::size_t own_ = 0;  ///< number of the thorax bodies among those; what is filled and what is added follow
  vascular::OpacityScratch scratch_;
};

}  // namespace ostium::app
