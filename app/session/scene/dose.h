#pragma once
/// Dose of a run, whether drawn or not: counts the frames in each C-arm pose, and computes the dose of one frame there.
/// A frame's dose is that of automatic exposure on a coarse grid of rays through the patient at end-diastole, without
/// instruments.
#include <optional>
#include <utility>
#include <vector>

#include "app/session/model/session.h"
#include "data/assessment/metrics.h"
#include "fluoro/detector/imager.h"

namespace ostium::app {

/// Frames so far, by pose.
class XrayUse {
 public:
  struct Pose {
    CArmInputs arm;
    double frames = 0;
  };
  XrayUse() { poses_.reserve(256); }
  /// Call after each step; some steps take a frame.
  void add(const CArmInputs& arm, std::uint64_t step, double step_s);
  const std::vector<Pose>& poses() const { return poses_; }

 private:
  std::vector<Pose> poses_;
};

inline constexpr double dose_frames_per_s = 15;  ///< fixed, as the operator cannot choose it yet

/// For one vessel; may be used by several threads.
class Dosimeter {
 public:
  explicit Dosimeter(const Vessel& vessel);  ///< takes some seconds
  explicit Dosimeter(fluoro::Scene patient) : scene_(std::move(patient)) {}
  /// Exposure of a frame; empty if the pose cannot be reached, which costs no dose.
  std::optional<fluoro::Exposure> exposure(fluoro::Imager& imager, const CArmInputs& arm) const;
  /// Adds the dose to the record.
  void measure(const XrayUse& use, data::RunRecord& record) const;

 private:
  fluoro::Scene scene_;
};

/// X-ray use of a run in progress, for display. The dose of a frame is computed once per pose.
class RunningDose {
 public:
  /// `patient`: scene without instruments and contrast, which the display already has.
  explicit RunningDose(fluoro::Scene patient);
  /// Pass the `use` of the same run at each call.
  fluoro::DoseMeter of(const XrayUse& use, const CArmState& arm);

 private:
  Dosimeter dosimeter_;
  fluoro::Imager imager_;
  std::vector<std::optional<fluoro::Exposure>> of_pose_;
};

}  // namespace ostium::app
