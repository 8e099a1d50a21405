#pragma once
/// What handling errors are detected from: positions of tools between access and arteries, the operator's inputs, and
/// the beam. Updated once per look; allocates only the first time.
#include <vector>

#include "app/session/model/session.h"

namespace ostium::app {

/// What is constant in a session.
struct HandlingMap {
  HandlingMap() = default;
  explicit HandlingMap(const SessionModel& model);

  // (#spheres of the vessel index), m:
  std::vector<double> astray_m;       ///< distance into a branch that leads to neither coronary ostium
  std::vector<char> aside;            ///< in a branch that leads to neither coronary ostium; all 0 for a mesh
  std::vector<double> in_coronary_m;  ///< distance beyond a coronary ostium
  std::vector<char> before_root;      ///< between the access and the end of the arch; all 0 for a mesh
  std::vector<char> in_ventricle;
  // (#cells of the arteries); empty without a patient:
  std::vector<double> from_ostium_m;  ///< distance along the artery
  std::vector<double> to_end_m;       ///< distance to the end of the longest artery distal to the cell
  std::vector<double> unplanned_m;    ///< distance into a branch off the path to the last lesions
  std::vector<double> deep_m;         ///< a guide farther from its ostium than this is deep-seated
  std::vector<double> healthy_m;      ///< radius
  std::vector<char> behind_lesion;    ///< beyond the distal end of the last lesion of its artery
};

struct HandledTool {
  bool in_body = false;
  double inserted_m = 0, fed_m = 0;     ///< fed: total by the hand
  double feed_m_s = 0, turn_rad_s = 0;  ///< current, of the hand
  double push_N = 0;
  int sphere = -1;     ///< of the vessel index, at its tip
  int branch = -1;     ///< that its tip is in; at a side branch's mouth still the one which that leaves
  double along_m = 0;  ///< distance of its tip from the access
};

struct HandlingScene {
  double time_s = 0;
  bool diastasis = false;  ///< only then are positions along an artery compared, to exclude cardiac motion
  bool beam = false, injects = false;
  double gauge_atm = 0;
  bool filled = false;        ///< the balloon in the body is not empty
  int balloon = -1;           ///< index in the model of the balloon in the body
  double beyond_stent_m = 0;  ///< how far the hard balloon extends beyond a lesion's stents
  double ST_mV = 0;
  vascular::Trace guide_trace = vascular::Trace::absent;  ///< of the last heartbeat
  std::vector<HandledTool> tools;
  int catheter = -1, thick_wire = -1, thin_wire = -1, device = -1;  ///< tools in the body; -1: none
  int thin_wires = 0;                                               ///< in the body; thin_wire is the one in hand
  double wire_tip_m = 0;                                            ///< how far the farthest of them is inserted
  int catheter_cell = -1, wire_cell = -1;                           ///< cells of the arteries at their tips
  bool thin_tip_is_seen = false;  ///< beam on, and the thin wire's tip within the field
  double twist_rad = 0;           ///< of the catheter, from the introducer to its tip

  const HandledTool& tool(int t) const { return tools[static_cast<std::size_t>(t)]; }
  bool is_inflated() const { return gauge_atm > 1; }
};

/// How far a balloon above 10 atm that lies in a lesion's stents extends beyond them; 0 if there is none or it does
/// not.
double beyond_stent_m(const SessionModel& model, const SessionState& state);

/// The branch that a tip at `p` is in, whose nearest sphere is `sphere`. A side branch begins where its mouth leaves
/// the wide vessel's lumen: a tip that slides past it along the wall has not entered it.
int tip_branch(const HandlingMap& map, const VesselIndex& way, int sphere, const Eigen::Vector3d& p, double phase,
               double breath = 0);

void see(const SessionModel& model, const HandlingMap& map, const SessionInputs& inputs, const SessionState& state,
         const SessionReport& report, HandlingScene& scene);

}  // namespace ostium::app
