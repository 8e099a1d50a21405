#pragma once
/// The host's side of a tracking box: from a port's bytes to the operator's movements, and back to the clamps. Used by
/// one thread (box_thread.h provides one).
///
/// Each report is passed through link, tracking and strokes as it comes; movements are summed, so that nothing is
/// missed by reading only the newest snapshot. One OUT report answers all reports received together; none is sent when
/// nothing comes, so that the box's watchdog opens its clamps.
#include <array>
#include <cstdint>
#include <string>

#include "device/host/clamp.h"
#include "device/host/link.h"
#include "device/host/strokes.h"
#include "device/transport/control.h"
#include "device/transport/port.h"

namespace ostium::device {

struct TrackingBoxSettings {
  StrokeSettings hands;
  ClampSettings clamp;
  bool clamps = true;  ///< false: the box is never armed
};

/// What the simulation asks of the box.
struct BoxRequest {
  std::array<ClampLoad, tools> load{};
  double step_s = 0;  ///< simulated time of the step that gave the loads; if it stops advancing, they become stale
  bool arm = false, identify = false;
  std::array<std::uint32_t, tools> zeroings{};  ///< increment one to say that this tool's tip is at the introducer now
};

/// One tool in the operator's hands. Sums count from when the box was first seen and continue over an unplug.
struct ToolSnapshot {
  double fed_m = 0;       ///< total movement of its instruments; positive into the patient
  double turned_rad = 0;  ///< clockwise as seen from the hub
  ToolPresence sight = ToolPresence::absent;
  std::uint8_t quality = 0;
  std::uint32_t arrivals = 0;           ///< number of instruments so far
  double in_box_m = 0, inserted_m = 0;  ///< tip of the tool, and of its instrument
  double clamp_N = 0;                   ///< force its clamp is asked to hold
  double brake_Nm = 0;                  ///< torque its rotary brake is asked to hold, where it has one
};

struct RoundTrip {
  std::uint64_t count = 0;
  double last_s = 0;
};

/// The operator's current state. Plain values, copied between threads.
struct BoxSnapshot {
  Link link = Link::unplugged;
  PortTrouble trouble = PortTrouble::none;
  bool calibrated = false;  ///< has a valid record of its own; otherwise nominal scales are used, and clamps stay open
  bool armed = false, watchdog = false;
  std::array<ToolSnapshot, tools> tool{};
  Pause pause = Pause::none;
  Tool paused_by = Tool::none;
  double picture = 1;                                ///< brightness of the picture, 0 to 1
  double pressure_Pa = 0;                            ///< of the indeflator, above atmospheric; negative: vacuum
  double flow_m3_s = 0;                              ///< out of the syringe; negative: aspiration
  std::uint16_t pedals = 0;                          ///< bit 0 fluoroscopy, 1 cine
  std::uint32_t openings = 0;                        ///< how often a box was plugged in
  std::uint64_t reports = 0, ignored = 0, lost = 0;  ///< valid; broke a rule; missing by sequence number
  std::uint32_t sequence = 0;                        ///< of the last report
  double box_s = 0;                                  ///< the box's clock
  std::uint16_t overruns = 0;
  PortCounts port;
  RoundTrip round_trip;
};

class TrackingBox : private ReportSink {
 public:
  TrackingBox(Port& port, const TrackingBoxSettings& settings);

  /// Waits for reports, at most `wait_s`, and answers them. Does not allocate, except when a box is plugged in.
  void poll(double wait_s, const BoxRequest& request);

  const BoxSnapshot& now() const { return now_; }
  const Calibration& calibration() const { return calibration_; }
  const std::string& calibration_problem() const { return calibration_problem_; }  ///< empty if there is none
  const BoxInfo& info() const { return info_; }
  const InReport& report() const { return report_; }  ///< the last

 private:
  void came(std::span<const std::uint8_t> bytes) override;
  void begin();
  void zero_what_is_asked(const BoxRequest& request);
  void answer();
  void note_round_trip(const InReport& report);
  void publish();

  Port& port_;
  TrackingBoxSettings settings_;
  Calibration calibration_;
  std::string calibration_problem_;
  BoxInfo info_;
  InReport report_;
  LinkState link_;
  TrackingState tracking_;
  StrokeState hands_;
  ClampState clamp_;
  ClampRequest wanted_;
  BoxRequest request_;
  double load_came_s_ = 0, polled_s_ = 0;
  std::array<std::uint32_t, tools> zeroings_{};
  bool some_came_ = false;
  struct Sent {
    std::uint16_t sequence = 0;
    double at_s = -1;  ///< negative: none
  };
  std::array<Sent, 256> sent_{};
  std::uint16_t acknowledged_ = 0;
  BoxSnapshot now_;
};

/// One line for the operator: the problem and its remedy; empty if there is none.
std::string_view advice(const BoxSnapshot& now);

}  // namespace ostium::device
