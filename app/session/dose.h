#pragma once
/// Dose of a run, drawn or not: how many frames were taken in which pose, and what one costs there. A frame's dose is
/// that of automatic exposure on a coarse grid of rays through the patient at end-diastole, without instruments.
#include <memory>
#include <vector>

#include "app/session/session.h"
#include "data/metrics.h"

namespace ostium {

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

inline constexpr double frames_per_s = 15;  ///< until the operator can choose

class XrayPatient;

/// Of one vessel; may be used by several threads.
class Dosimeter {
 public:
  explicit Dosimeter(std::shared_ptr<const Vessel> vessel);
  ~Dosimeter();
  /// Adds up. Poses that cannot be reached cost nothing.
  void measure(const XrayUse& use, RunRecord& record) const;

 private:
  std::shared_ptr<const Vessel> vessel_;
  std::unique_ptr<const XrayPatient> patient_;  ///< null: a mesh
};

}  // namespace ostium
