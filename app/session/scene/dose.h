#pragma once
/// Dose of a run, drawn or not: how many frames were taken in which pose, and what one costs there. A frame's dose is
/// that of automatic exposure on a coarse grid of rays through the patient at end-diastole, without instruments.
#include <optional>
#include <utility>
#include <vector>

#include "app/session/model/session.h"
#include "data/assessment/metrics.h"
#include "fluoro/detector/imager.h"

namespace ostium::app {

/// Frames so far, pose by pose.
class XrayUse {
 public:
  struct Pose {
    CArmInputs arm;
    double frames = 0;
  };
  XrayUse() { poses_.reserve(256); }
  /// After each step; a frame falls on some of them.
  void add(const CArmInputs& arm, std::uint64_t step, double step_s);
  const std::vector<Pose>& poses() const { return poses_; }

 private:
  std::vector<Pose> poses_;
};

inline constexpr double dose_frames_per_s = 15;  ///< until the operator can choose

/// Of one vessel; may be used by several threads.
class Dosimeter {
 public:
  explicit Dosimeter(const Vessel& vessel);  ///< takes some seconds
  explicit Dosimeter(fluoro::Scene patient) : scene_(std::move(patient)) {}
  /// Of a frame; nothing: a pose that cannot be reached, which costs nothing.
  std::optional<fluoro::Exposure> exposure(fluoro::Imager& imager, const CArmInputs& arm) const;
  /// Adds up.
  void measure(const XrayUse& use, data::RunRecord& record) const;

 private:
  fluoro::Scene scene_;
};

/// What a run that goes on has used so far, for whoever watches it. What a frame costs in a pose is worked out once.
class RunningDose {
 public:
  /// `patient`: without instruments and contrast; whoever shows the run has it at hand.
  explicit RunningDose(fluoro::Scene patient);
  /// `use` of the same run at each call.
  fluoro::DoseMeter of(const XrayUse& use, const CArmState& arm);

 private:
  Dosimeter dosimeter_;
  fluoro::Imager imager_;
  std::vector<std::optional<fluoro::Exposure>> of_pose_;
};

}  // namespace ostium::app
