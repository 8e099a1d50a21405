#pragma once
/// Hands at a tracking box as the driver of a run: what the box says becomes SessionInputs, what the step resists
/// becomes the box's clamps.
///
/// An instrument is where the hand has it: each step feeds it towards the depth at which the box has its tip, and turns
/// it by what the hand turned, through a low pass of `smooth_s`. Outside the introducer nothing is fed. While the
/// travel is at its end the simulation stands.
///
/// A session may have more instruments of a kind than a box has tools: they are used in their order. Each tool that
/// arrives where another was drawn out is the next one (an exchange); after the last comes the first.
#include <atomic>
#include <functional>
#include <utility>

#include "app/session/run/run.h"
#include "core/base/triple_buffer.h"
#include "device/host/drive.h"
#include "device/host/tracking_box.h"

namespace ostium::app {

struct BoxDriverSettings {
  double smooth_s = 0.015;
  double fastest_m_s = 0.6;  ///< that it follows: a tool that is far in as the run begins does not shoot in
  bool arm = true;
  double least_pressure_Pa = 5e3, least_flow_m3_s = 5e-8;  ///< less is an offset of the sensors, and no hand
  /// Angles of the views that buttons 2, 3, ... select, rad: left anterior oblique, cranial.
  std::vector<std::pair<double, double>> views;
  /// Called with each snapshot, also while the simulation stands, by the thread that steps: for who shows it. May be
  /// empty.
  std::function<void(const device::BoxSnapshot&)> watch;
};

/// Which of the box's tools moves each of the session's: catheters are the guide, wires the wire, balloon and stent
/// shafts the shaft.
std::vector<device::Tool> tools_at_the_box(const SessionModel& model);

/// Place of each among those of its kind, counted from 0, and how many there are.
struct ToolTurn {
  std::uint32_t place = 0, count = 1;
};
std::vector<ToolTurn> turns_at_the_box(const std::vector<device::Tool>& held);

class BoxDriver : public Driver {
 public:
  /// The newest snapshot, given what the simulation asks; called once a step, and again and again while it stands.
  using Exchange = std::function<const device::BoxSnapshot&(const device::BoxRequest&)>;

  /// `stop`: becomes true to end the run, also while it stands; may be null.
  BoxDriver(BoxDriverSettings settings, Exchange exchange, const std::atomic<bool>* stop = nullptr);

  Driven drive(const ScriptedRun& run, SessionInputs& inputs) override;

  /// The indeflator, above the air's pressure, Pa; negative: vacuum.
  double pressure_Pa() const { return now_.pressure_Pa; }
  /// Out of the syringe, m3/s; negative: aspiration.
  double flow_m3_s() const { return now_.flow_m3_s; }
  const device::BoxSnapshot& now() const { return now_; }
  /// The same for one other thread, also while the simulation stands: a window.
  const device::BoxSnapshot& shown() { return shown_.take(); }
  long stood() const { return stood_; }  ///< how often it stood, waiting for the operator to draw back
  /// That tool's tip is at the introducer now.
  void zero(device::Tool tool) { ++request_.zeroings[index_of(tool)]; }

 private:
  void begin(const SessionModel& model);
  void feel(const SessionReport& report);
  void press_buttons(SessionInputs& inputs);
  void inflate_and_inject(SessionInputs& inputs) const;

  BoxDriverSettings settings_;
  Exchange exchange_;
  const std::atomic<bool>* stop_;
  /// What drives session's tool t now; Tool::none: nothing does, it is outside.
  device::Tool source(std::size_t t) const;

  std::vector<device::Tool> held_;  ///< from the first step on; one a tool of the session
  std::vector<ToolTurn> turns_;
  std::array<double, ostium::device::tools> turned_rad_{};  ///< of the box's sums, taken so far
  std::vector<double> pending_turn_rad_;
  device::BoxRequest request_;
  device::BoxSnapshot now_;
  core::TripleBuffer<device::BoxSnapshot> shown_;
  std::uint16_t buttons_ = 0;
  int view_ = -1;
  long stood_ = 0;
};

/// The script without what it does to tools and the patient: its views and switches up to the first movement, then it
/// waits. For a run in which people do the rest, heparin among it.
data::Script free_hands(data::Script script);

}  // namespace ostium::app
