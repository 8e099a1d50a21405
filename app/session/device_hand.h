#pragma once
/// Hands at a tracking box as the driver of a run: what the box says becomes SessionInputs, what the step resists
/// becomes the box's clamps.
///
/// An instrument is where the hand has it: each step feeds it towards the depth at which the box has its tip, and turns
/// it by what the hand turned, through a low pass of `smooth_s`. Outside the introducer nothing is fed, so that a tool
/// drawn out and another one brought in are an exchange without more ado. While the travel is at its end the simulation
/// stands.
#include <atomic>
#include <functional>
#include <utility>

#include "app/session/run.h"
#include "device/drive.h"
#include "device/tracking_box.h"

namespace ostium {

struct DeviceHandSettings {
  double smooth_s = 0.015;
  double fastest_m_s = 0.6;  ///< that it follows: a tool that is far in as the run begins is no bullet
  bool arm = true;
  /// Angles of the views that buttons 2, 3, ... select, rad: left anterior oblique, cranial.
  std::vector<std::pair<double, double>> views;
  /// Called with each snapshot, also while the simulation stands, by the thread that steps: for who shows it. May be
  /// empty.
  std::function<void(const BoxSnapshot&)> watch;
};

class DeviceHand : public Driver {
 public:
  /// The newest snapshot, given what the simulation asks; called once a step, and again and again while it stands.
  using Exchange = std::function<const BoxSnapshot&(const BoxRequest&)>;

  /// `stop`: becomes true to end the run, also while it stands; may be null.
  DeviceHand(DeviceHandSettings settings, Exchange exchange, const std::atomic<bool>* stop = nullptr);

  bool drive(const SessionModel& model, const SessionState& state, const SessionReport& report,
             SessionInputs& inputs) override;

  /// The indeflator, above the air's pressure, Pa; negative: vacuum. For whoever inflates a balloon.
  double pressure_Pa() const { return now_.pressure_Pa; }
  /// Out of the syringe, m3/s; negative: aspiration. For whoever injects.
  double flow_m3_s() const { return now_.flow_m3_s; }
  const BoxSnapshot& now() const { return now_; }
  long stood() const { return stood_; }  ///< how often it stood, waiting for the operator to draw back
  /// That tool's tip is at the introducer now.
  void zero(Tool tool) { ++request_.zeroings[index_of(tool)]; }

 private:
  void begin(const SessionModel& model);
  void feel(const SessionReport& report);
  void press_buttons(SessionInputs& inputs);

  DeviceHandSettings settings_;
  Exchange exchange_;
  const std::atomic<bool>* stop_;
  std::vector<Tool> held_;          ///< of the box's tools, which one each of the session's is; from the first step
  std::vector<double> turned_rad_;  ///< of the box's sum, taken so far; one a tool
  std::vector<double> pending_turn_rad_;
  BoxRequest request_;
  BoxSnapshot now_;
  std::uint16_t buttons_ = 0;
  int view_ = -1;
  long stood_ = 0;
};

/// Catheters are the guide, the first wire the wire and another one the second wire, balloon and stent shafts the
/// shaft; of several of a kind the first. Tool::none: nothing of the box moves it.
std::vector<Tool> tools_at_the_box(const SessionModel& model);

/// The script without what it does to tools: its views and switches up to the first movement, then it waits. For a run
/// in which people do the rest.
Script free_hands(Script script);

}  // namespace ostium
