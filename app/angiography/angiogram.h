#pragma once
/// A cine run with contrast: the circulation at 1 kHz, a frame whenever one is due, and what can be read from it.
#include <memory>
#include <optional>

#include "app/angiography/patient_scene.h"
#include "data/catalogue/case/case.h"
#include "fluoro/console/fluoroscope.h"

namespace ostium::app {

/// The isocentre as an operator sets it: the middle of the coronaries on the middle of the picture.
fluoro::View view_of(const std::string& standard_view, const vascular::Patient& patient, bool left, int pixels);

struct Injection {
  vascular::TipPlace tip;
  double rate_m3_s = 0, volume_m3 = 0;
  double iodine_kg_m3 = 350;
};
/// As injected by hand in 550 people (Dodge 1998): 7.1 mL in 3.4 s, 4.8 mL in 2.8 s; the tip 2 mm behind the ostium.
Injection usual_injection(const vascular::FlowTree& tree, bool left);

class Angiogram {
 public:
  /// Keeps references. `state`: of a circulation that has come to its rest.
  Angiogram(const vascular::PhysiologyModel& model, PatientScene& scene, const fluoro::View& view, double frames_per_s,
            std::uint64_t seed = 1);

  /// Runs until the heart is at that phase, without contrast.
  void wait_for(double phase, double rate_1_min, vascular::PhysiologyState& state);
  /// Advances to the next frame and takes it. `injection`: goes on until its volume is in; the line is full of it.
  const fluoro::Picture& frame(const std::optional<Injection>& injection, const vascular::PhysiologyInputs& inputs,
                               vascular::PhysiologyState& state);
  /// The same without taking it.
  void advance(const std::optional<Injection>& injection, vascular::PhysiologyInputs inputs,
               vascular::PhysiologyState& state);
  /// A frame of the scene as it stands.
  const fluoro::Picture& take(double phase);
  const fluoro::Picture& picture() const { return fluoroscope_.live; }
  const fluoro::FluoroscopeState& fluoroscope() const { return fluoroscope_; }
  const fluoro::TickReport& report() const { return report_; }

  /// How dark iodine makes the picture at a cell of the coronaries: ln of the signal without it over that with it, mean
  /// over a disc of the vessel's half diameter. Draws the same moment once more without iodine.
  std::vector<double> darkness(const std::vector<int>& cells, const vascular::PhysiologyState& state);
  /// The same with these cells' vessels full, once.
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

/// Frames at 30/s from the ostium to a landmark (Gibson 1996), read from rendered frames: from the first in which
/// contrast fills the ostium's width to the first in which it is seen at the landmark.
struct TimiCount {
  double frames = 0;
  bool reached = false;  ///< false: it did not arrive within the run
};
/// Landmarks as Gibson has them: LAD where it comes to the apex, the circumflex' longest path 93 mm from the ostium
/// (his length), the right one where its posterolateral branch first divides. -1 if there is none.
int timi_landmark(const vascular::FlowTree& tree, const std::string& artery);
TimiCount timi_count(const vascular::PhysiologyModel& model, PatientScene& scene, const vascular::Patient& patient,
                     const std::string& artery, const vascular::PhysiologyState& at_rest, double rate_1_min,
                     double start_phase, double longest_s = 4);

}  // namespace ostium::app
