#pragma once
/// What handling is judged by: where tools are on their way and in the arteries, what hands do to them, whether the
/// beam is on. Gathered once a look; no allocation after the first.
#include <vector>

#include "app/session/session.h"

namespace ostium {

/// What never changes in a session.
struct HandlingMap {
  HandlingMap() = default;
  explicit HandlingMap(const SessionModel& model);

  // (#spheres of the way), m:
  std::vector<double> astray_m;       ///< how far into a branch that leads to neither coronary ostium
  std::vector<double> in_coronary_m;  ///< how far behind one's ostium
  std::vector<char> before_root;      ///< between the access and the end of the arch; all 0 in a mesh
  std::vector<char> in_ventricle;
  // (#cells of the arteries); empty without a patient.
  std::vector<double> from_ostium_m;  ///< along the artery
  std::vector<double> to_end_m;       ///< to the end of the longest artery that goes on from there
  std::vector<double> unplanned_m;    ///< how far into a branch off the way to the last lesions
  std::vector<double> deep_m;         ///< a guide farther from its ostium than this sits deep
  std::vector<double> healthy_m;      ///< radius
  std::vector<char> behind_lesion;    ///< beyond the distal end of the last lesion of its artery
};

struct HandledTool {
  bool in_body = false;
  double inserted_m = 0, fed_m = 0;        ///< fed: by the hand in all
  double advance_m_s = 0, turn_rad_s = 0;  ///< of the hand, now
  double push_N = 0;
  int sphere = -1;  ///< of the way, where its tip is
};

struct HandlingScene {
  double time_s = 0;
  bool diastasis = false;  ///< the heart rests: places along an artery are compared then, so that beats do not count
  bool beam = false, injects = false;
  double gauge_atm = 0;
  bool filled = false;  ///< the balloon in the body is not empty
  std::vector<HandledTool> tools;
  int catheter = -1, thick_wire = -1, thin_wire = -1, device = -1;  ///< tools in the body; -1: none
  int catheter_cell = -1, wire_cell = -1;                           ///< of the arteries, where their tips are
  bool thin_tip_is_seen = false;                                    ///< beam on, and the thin wire's tip in the field
  double twist_rad = 0;                                             ///< of the catheter, from the introducer to its tip
};

void see(const SessionModel& model, const SessionInputs& inputs, const SessionState& state, const SessionReport& report,
         HandlingScene& scene);

/// One event an episode: what comes again within 3 s of its end is the same one.
class Episode {
 public:
  /// True as one begins.
  bool begins(bool holds, double time_s) {
    if (!holds) return false;
    const bool is_new = time_s - last_s_ > again_after_s;
    last_s_ = time_s;
    return is_new;
  }

 private:
  static constexpr double again_after_s = 3;
  double last_s_ = -1e9;
};

/// For how long something has held without a break.
class Held {
 public:
  double seconds(bool holds, double time_s) {
    if (!holds || since_s_ < 0) since_s_ = holds ? time_s : -1;
    return holds ? time_s - since_s_ : 0;
  }

 private:
  double since_s_ = -1;
};

}  // namespace ostium
