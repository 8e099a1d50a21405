#pragma once
/// A scripted hand at an emulated box: moves the box's tools as a script asks within the travel of the box, draws back
/// when the picture fades, and exchanges instruments of one kind when the script moves another.
#include "app/session/device/box_driver.h"
#include "device/emulator/emulated_box.h"

namespace ostium::app {

class EmulatedBoxDriver {
 public:
  /// The script's inputs, and the box state that the operator sees. `held`: which of the box's tools moves each of the
  /// session's.
  void ask(const std::vector<device::Tool>& held, const SessionInputs& inputs);
  void see(const device::BoxSnapshot& now);

  /// Moves the box's tools for the box time since the last call.
  void move(device::EmulatedBox& box);

  /// Number of strokes drawn back, over all tools.
  long drawn_back() const { return drawn_back_; }

 private:
  /// One of the box's tools: index of the instrument of its kind in the box, and for how long it has been exchanged.
  struct Station {
    std::uint32_t place = 0, count = 1;
    double changing_s = -1;  ///< negative: no exchange
  };
  void exchange(double elapsed_s);

  std::vector<device::Tool> held_;
  std::vector<ToolTurn> turns_;
  std::array<Station, 4> stations_{};
  SessionInputs wish_;
  device::Pause pause_ = device::Pause::none;
  device::Tool paused_by_ = device::Tool::none;
  double in_box_m_ = 0;  ///< of the tool that caused the pause, as displayed
  double last_s_ = 0;
  long drawn_back_ = 0;
};

/// Passes the script's inputs to the scripted hand; the box driver then makes the session's inputs.
class EmulatedOperator : public Driver {
 public:
  EmulatedOperator(BoxDriver& device, EmulatedBoxDriver& hand) : device_(device), hand_(hand) {}
  Driven drive(const ScriptedRun& run, SessionInputs& inputs) override {
    if (held_.empty()) held_ = tools_at_the_box(run.model);
    hand_.ask(held_, inputs);
    return device_.drive(run, inputs);
  }

 private:
  BoxDriver& device_;
  EmulatedBoxDriver& hand_;
  std::vector<device::Tool> held_;
};

}  // namespace ostium::app
