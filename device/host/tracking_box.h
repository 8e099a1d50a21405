#pragma once
/// The host's side of a tracking box: everything between a port's bytes and what the operator does, and back to the
/// clamps. One thread has it (box_thread.h gives it one of its own).
///
/// Each report goes through link, tracking and hands as it comes; what the hands did is summed, so that whoever looks
/// at the newest snapshot alone misses nothing. One OUT report answers what came at once; none is sent when nothing
/// comes, so that the box's watchdog opens its clamps.
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
  bool clamps = true;  ///< false: it is never armed
};

/// What a simulation asks of the box.
struct BoxRequest {
  std::array<ClampLoad, tools> load{};
  double step_s = 0;  ///< simulated time of the step that gave the loads: if it stands still, they become stale
  bool arm = false, identify = false;
  std::array<std::uint32_t, tools> zeroings{};  ///< one more: that tool's tip is at the introducer now
};

/// One tool as the operator holds it. Sums are since the box was first seen, and go on over an unplug.
struct ToolSnapshot {
  double fed_m = 0;       ///< sum of what its instruments were moved; positive into the patient
  double turned_rad = 0;  ///< clockwise as seen from the hub
  ToolPresence sight = ToolPresence::absent;
  std::uint8_t quality = 0;
  std::uint32_t arrivals = 0;           ///< instruments so far
  double in_box_m = 0, inserted_m = 0;  ///< of the tool's tip, of its instrument's
  double clamp_N = 0;                   ///< what its clamp is asked to hold
};

struct RoundTrip {
  std::uint64_t count = 0;
  double last_s = 0;
};

/// Everything that is known of the operator now. Plain values: it is copied between threads.
struct BoxSnapshot {
  Link link = Link::unplugged;
  PortTrouble trouble = PortTrouble::none;
  bool calibrated = false;  ///< by a valid record of its own; else nominal scales are used, and clamps stay open
  bool armed = false, watchdog = false;
  std::array<ToolSnapshot, tools> tool{};
  Pause pause = Pause::none;
  Tool paused_by = Tool::none;
  double picture = 1;                                ///< its brightness, 0 to 1
  double pressure_Pa = 0;                            ///< of the indeflator, above the air's; negative: vacuum
  double flow_m3_s = 0;                              ///< out of the syringe; negative: aspiration
  std::uint16_t pedals = 0;                          ///< bit 0 fluoroscopy, 1 cine
  std::uint32_t openings = 0;                        ///< how often a box was plugged in
  std::uint64_t reports = 0, ignored = 0, lost = 0;  ///< taken; broke a rule; missing by sequence
  std::uint32_t sequence = 0;                        ///< of the last report
  double box_s = 0;                                  ///< its clock
  std::uint16_t overruns = 0;
  PortCounts port;
  RoundTrip round_trip;
};

class TrackingBox : private ReportSink {
 public:
  TrackingBox(Port& port, const TrackingBoxSettings& settings);

  /// Waits for what comes, at most `wait_s`; answers it. Does not allocate, except when a box is plugged in.
  void poll(double wait_s, const BoxRequest& request);

  const BoxSnapshot& now() const { return now_; }
  const Calibration& calibration() const { return calibration_; }
  const std::string& calibration_problem() const { return calibration_problem_; }  ///< empty: there is none
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

/// One line for the operator: what is wrong, and what to do; empty if nothing is.
std::string_view advice(const BoxSnapshot& now);

}  // namespace ostium::device
