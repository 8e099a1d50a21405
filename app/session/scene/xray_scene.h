#pragma once
/// The X-ray scene of a patient or a session, as fluoro draws it.
#include <functional>
#include <optional>
#include <vector>

#include "app/angiography/cut_surface.h"
#include "app/angiography/twig_body.h"
#include "app/session/model/session.h"
#include "fluoro/matter/scene.h"
#include "vascular/thorax/thorax.h"

namespace ostium::app {

enum class Fill { none, left, right };  ///< a coronary tree full of undiluted contrast, 350 mg of iodine per mL

/// What treatment adds to a case's scene: filled balloons, stents, contrast outside the lumen. Shafts and their markers
/// come from the rods (shafts_of).
void add_treatment(const SessionModel& model, const SessionState& state, fluoro::Scene& scene);
/// (#cells) radius of the instruments in each: shafts and balloon.
std::vector<double> occupied_m(const SessionModel& model, const SessionState& state);

/// An instrument's radiopaque stretches and markers, from the catalogue; `stent_left`: without those of a crimped
/// stent.
std::vector<fluoro::OpaqueSection> sections_of(const data::Instrument& instrument, bool stent_left = false);
/// A rod's points and its radiopaque sections from the catalogue. Empty if fewer than two nodes are in the body.
std::vector<fluoro::Shaft> shafts_of(const SessionModel& model, const SessionState& state);

/// The patient's chest. Builds the meshes once (some seconds), then a scene for any phase.
class XrayPatient {
 public:
  /// `breathes`: bodies moved by breath are not treated as fixed.
  XrayPatient(std::shared_ptr<const vascular::Patient> patient, Fill fill, bool breathes = false);
  fluoro::Scene at(double phase, double breath_depth = 0) const;

 private:
  void fill(Fill which);

  std::shared_ptr<const vascular::Patient> patient_;
  bool breathes_ = false;
  std::shared_ptr<const std::vector<fluoro::Body>> fixed_;
  std::vector<vascular::XrayBody> moving_;
  std::vector<fluoro::Body> moving_bodies_;  ///< at end-diastole
  CutSurface filled_;                        ///< the part of the lumen that belongs to a coronary tree
  std::optional<TwigBody> twigs_;            ///< if filled
};

/// A case without a session: a scene for each cardiac phase.
struct CaseScene {
  std::function<fluoro::Scene(double phase)> at;
  std::function<double(double phase, double seconds)> later;  ///< the phase after some time at the case's heart rate
};
/// `middle` is set to the heart's.
CaseScene scene_of_case(const data::Case& c, Fill fill, Eigen::Vector3d& middle);

/// Any mesh, embedded in a block of soft tissue.
fluoro::Scene scene_of_mesh(const Vessel& vessel);

}  // namespace ostium::app
