#pragma once
/// What handling is judged by: where tools are on their way and in the arteries, what hands do to them, whether the
/// beam is on. Gathered once a look; no allocation after the first.
#include <vector>

#include "app/session/model/session.h"

namespace ostium::app {

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
  double inserted_m = 0, fed_m = 0;     ///< fed: by the hand in all
  double feed_m_s = 0, turn_rad_s = 0;  ///< of the hand, now
  double push_N = 0;
  int sphere = -1;     ///< of the vessel index, where its tip is
  double along_m = 0;  ///< from the access to there
};

struct HandlingScene {
  double time_s = 0;
  bool diastasis = false;  ///< the heart rests: places along an artery are compared then, so that beats do not count
  bool beam = false, injects = false;
  double gauge_atm = 0;
  bool filled = false;        ///< the balloon in the body is not empty
  int balloon = -1;           ///< of the model's, in the body
  double beyond_stent_m = 0;  ///< how far it stands out of a lesion's stents while it is hard
  double ST_mV = 0;
  vascular::Trace guide_trace = vascular::Trace::absent;  ///< of the last heartbeat
  std::vector<HandledTool> tools;
  int catheter = -1, thick_wire = -1, thin_wire = -1, device = -1;  ///< tools in the body; -1: none
  int catheter_cell = -1, wire_cell = -1;                           ///< of the arteries, where their tips are
  bool thin_tip_is_seen = false;                                    ///< beam on, and the thin wire's tip in the field
  double twist_rad = 0;                                             ///< of the catheter, from the introducer to its tip

  const HandledTool& tool(int t) const { return tools[static_cast<std::size_t>(t)]; }
  bool is_inflated() const { return gauge_atm > 1; }
};

/// How far a balloon with more than 10 atm that lies in a lesion's stents stands out of them; 0: there is none, or it
/// does not.
double beyond_stent_m(const SessionModel& model, const SessionState& state);

void see(const SessionModel& model, const SessionInputs& inputs, const SessionState& state, const SessionReport& report,
         HandlingScene& scene);

}  // namespace ostium::app
