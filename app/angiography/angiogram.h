#pragma once
/// A cine run with contrast: the circulation at 1 kHz, a frame whenever one is due, and the measurements read from the
/// frames.
#include <memory>
#include <optional>

#include "app/angiography/patient_scene.h"
#include "data/catalogue/case/case.h"
#include "fluoro/console/fluoroscope.h"
#include "fluoro/projection/views.h"

namespace ostium::app {

/// The isocentre as an operator sets it: the middle of the coronaries is in the middle of the picture.
fluoro::View view_of(const fluoro::StandardView& named, const vascular::Patient& patient, bool left, int pixels);

struct Injection {
  vascular::TipPlace tip;
  double rate_m3_s = 0, volume_m3 = 0;
  double iodine_kg_m3 = 350;
};
/// Hand injection as measured in 550 people (Dodge 1998): 7.1 mL in 3.4 s, 4.8 mL in 2.8 s; the tip 2 mm inside the
/// ostium.
Injection usual_injection(const vascular::FlowTree& tree, bool left);

class Angiogram {
 public:
  /// Keeps references. `state`: of a circulation in its periodic state.
  Angiogram(const vascular::PhysiologyModel& model, PatientScene& scene, const fluoro::View& view, double frames_per_s,
            std::uint64_t seed = 1, fluoro::Renderer renderer = fluoro::Renderer::scanline);

  /// Runs without contrast until the heart is at that phase.
  void wait_for(double phase, double rate_1_min, vascular::PhysiologyState& state);
  /// Advances to the next frame and takes it. `injection` goes on until its volume is injected; the line is full of its
  /// contrast.
  const fluoro::Picture& frame(const std::optional<Injection>& injection, const vascular::PhysiologyInputs& inputs,
                               vascular::PhysiologyState& state);
  /// The same without taking the frame.
  void advance(const std::optional<Injection>& injection, vascular::PhysiologyInputs inputs,
               vascular::PhysiologyState& state);
  /// A frame of the scene as it is now.
  const fluoro::Picture& take(double phase);
  const fluoro::Picture& picture() const { return fluoroscope_.live; }
  const fluoro::FluoroscopeState& fluoroscope() const { return fluoroscope_; }
  const fluoro::TickReport& report() const { return report_; }

  /// How much iodine darkens the picture at coronary cells: ln of the signal without it over that with it, averaged
  /// over a disc of half the vessel's diameter. Renders the same moment again without iodine.
  std::vector<double> darkness(const std::vector<int>& cells, const vascular::PhysiologyState& state);
  /// The same once, as if the whole coronary tree were full.
  std::vector<double> darkness_full(const std::vector<int>& cells, double iodine_kg_m3,
                                    const vascular::PhysiologyState& state);

 private:
  void draw(fluoro::Imager& imager, fluoro::ImagerState& into);
  std::vector<double> read(const fluoro::Plane& with, const fluoro::Plane& without, const std::vector<int>& cells,
                           const vascular::PhysiologyState& state) const;

  const vascular::PhysiologyModel& model_;
  PatientScene& scene_;
  fluoro::View view_;
  double frames_per_s_;
  std::uint64_t seed_;
  long step_ = 0, frame_ = 0;
  vascular::PhysiologyScratch scratch_;
  fluoro::Imager imager_, mask_imager_;
  fluoro::FluoroscopeState fluoroscope_;
  fluoro::ImagerState mask_;
  fluoro::DisplayScratch display_;
  fluoro::TickReport report_;
};

/// TIMI frames at 30/s from the ostium to a landmark (Gibson 1996), read from rendered frames: from the first in which
/// contrast fills the ostium's width to the first in which it is seen at the landmark.
struct TimiCount {
  double frames = 0;
  bool reached = false;  ///< false: contrast did not reach it within the run
};
/// Gibson's landmarks: where the LAD reaches the apex; on the circumflex's longest path, 93 mm from the ostium (his
/// length); the first division of the right coronary's posterolateral branch. -1 if there is none.
int timi_landmark(const vascular::FlowTree& tree, const std::string& artery);
TimiCount timi_count(const vascular::PhysiologyModel& model, PatientScene& scene, const vascular::Patient& patient,
                     const std::string& artery, const vascular::PhysiologyState& at_rest, double rate_1_min,
                     double start_phase, double longest_s = 4);

}  // namespace ostium::app
