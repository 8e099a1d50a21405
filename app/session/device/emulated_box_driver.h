#pragma once
/// A scripted hand at an emulated box: it moves the box's tools as a script asks, within the travel that a box has, and
/// draws back when the picture fades, and takes the next instrument of a kind when the script wants to move that.
#include "app/session/device/box_driver.h"
#include "device/emulator/emulated_box.h"

namespace ostium::app {

class EmulatedBoxDriver {
 public:
  /// What the script asks for, and what the operator sees. `held`: which of the box's tools each of the session's is.
  void ask(const std::vector<device::Tool>& held, const SessionInputs& inputs);
  void see(const device::BoxSnapshot& now);

  /// Moves what is in the box by its time since the last call.
  void move(device::EmulatedBox& box);

  /// Strokes drawn back, of all tools.
  long drawn_back() const { return drawn_back_; }

 private:
  /// One of the box's tools: which instrument of its kind lies there, counted, and since when it is being exchanged.
  struct Station {
    std::uint32_t place = 0, count = 1;
    double changing_s = -1;  ///< negative: it does not
  };
  void exchange(double elapsed_s);

  std::vector<device::Tool> held_;
  std::vector<ToolTurn> turns_;
  std::array<Station, 4> stations_{};
  SessionInputs wish_;
  device::Pause pause_ = device::Pause::none;
  device::Tool paused_by_ = device::Tool::none;
  double in_box_m_ = 0;  ///< of the tool that paused, as it is shown
  double last_s_ = 0;
  long drawn_back_ = 0;
};

/// Passes on what the script asks for to the hand, and lets the box's driver make inputs of what comes.
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
