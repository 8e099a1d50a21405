#pragma once
/// What an X-ray meets of a patient and of a session: the scene that fluoro takes a picture of.
#include <functional>
#include <vector>

#include "app/session/model/session.h"
#include "fluoro/matter/scene.h"
#include "vascular/thorax/thorax.h"

namespace ostium::app {

enum class Fill { none, left, right };  ///< a coronary tree full of undiluted contrast, 350 mg of iodine per mL

/// What treatment adds to a case's scene: filled balloons, stents, contrast beside the lumen. The shafts and their
/// markers are the rods' own (shafts_of).
void add_treatment(const SessionModel& model, const SessionState& state, fluoro::Scene& scene);
/// (#cells) radius of what lies in each: shafts and balloon.
std::vector<double> occupied_m(const SessionModel& model, const SessionState& state);

/// A rod's points as fluoro wants them, with what the catalogue says is opaque in it. Empty if less than two nodes are
/// in the body.
std::vector<fluoro::Shaft> shafts_of(const SessionModel& model, const SessionState& state);

/// The patient's chest; makes meshes once, then a scene for any phase. Takes some seconds to make.
class XrayPatient {
 public:
  /// `breathes`: what the breath moves is not among what stands still.
  XrayPatient(std::shared_ptr<const vascular::Patient> patient, Fill fill, bool breathes = false);
  fluoro::Scene at(double phase, double breath_depth = 0) const;

 private:
  struct Filled {
    std::vector<int> vertices;           ///< of the lumen
    std::vector<std::vector<int>> rims;  ///< where it is cut off: of `vertices`, closed by a lid
    std::shared_ptr<const fluoro::Triangles> triangles;
  };
  void fill(Fill which);

  std::shared_ptr<const vascular::Patient> patient_;
  std::shared_ptr<const std::vector<fluoro::Body>> fixed_;
  std::vector<vascular::XrayBody> moving_;
  std::vector<std::shared_ptr<const fluoro::Triangles>> moving_triangles_;
  Filled filled_;
};

/// A case without a session: a scene for each phase of its heart.
struct CaseScene {
  std::function<fluoro::Scene(double phase)> at;
  std::function<double(double phase, double seconds)> later;  ///< the phase after a while at the case's heart rate
};
/// By name; `middle`: of the heart. Throws LoadError.
CaseScene scene_of_case(const std::string& name, Fill fill, Eigen::Vector3d& middle);

/// A mesh of anyone: it lies in a block of soft tissue.
fluoro::Scene scene_of_mesh(const Vessel& vessel);

}  // namespace ostium::app
