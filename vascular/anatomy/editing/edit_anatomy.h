#pragma once
/// What a person changes in the courses of an imported lumen: each function takes an anatomy and returns the changed
/// one. Positions in m, patient frame; `s_m` along a tube. All throw std::invalid_argument with what was wrong and what
/// was expected; indices are checked.
///
/// Names stay where they are in space: a branch begins and ends on the changed course where that is nearest to where it
/// did.
#include "vascular/anatomy/anatomy.h"
#include "vascular/anatomy/editing/lumen_gauge.h"

namespace ostium::vascular {

/// A sphere to another place, and with it its neighbours along the tube, less and less, up to `reach_m` from it (half a
/// cosine). Moved spheres get the radius that fits there; where they lie outside they keep theirs. Where they draw
/// apart, others come between.
Anatomy with_moved_node(Anatomy anatomy, const LumenGauge& lumen, int tube, std::size_t node, const Eigen::Vector3d& p,
                        double reach_m);
/// All spheres of a stretch to the middle of the lumen, with the radius that fits there.
Anatomy with_centred_course(Anatomy anatomy, const LumenGauge& lumen, int tube, double from_m, double to_m);

/// The tube ends there. Refused where a branch leaves it farther on, or a name would go.
Anatomy with_end(Anatomy anatomy, int tube, double s_m);
/// Refused for the last tube, and where others leave it.
Anatomy without_tube(Anatomy anatomy, int tube);
/// A tube without a parent, or with another one, leaves `parent` from now on: its course begins at the point of the
/// parent's that is nearest to it. Refused where the parent is a branch of it.
Anatomy with_joined_tube(Anatomy anatomy, const LumenGauge& lumen, int tube, int parent);
/// A vessel that was missed, from the nearest tube through the lumen `wall` to `p_end`, which need not lie inside.
/// Refused where no way leads there.
Anatomy with_vessel(Anatomy anatomy, const Mesh& wall, const Eigen::Vector3d& p_end, const std::string& name);

/// At most 40 letters, digits, spaces, - and _.
bool is_branch_name(const std::string& name);
/// Refused: one that another branch has; aorta, LM, LAD, LCx
/// and RCA, old or new, by which the aorta and the heart's motion are known.
Anatomy with_name(Anatomy anatomy, const std::string& branch, const std::string& name);
/// From `along_m` of the branch on it has another name.
Anatomy with_split_branch(Anatomy anatomy, const std::string& branch, double along_m, const std::string& name);

/// Instruments enter at the point of a centreline that is nearest.
Anatomy with_entry(Anatomy anatomy, const Eigen::Vector3d& p);

}  // namespace ostium::vascular
