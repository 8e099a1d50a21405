#pragma once
/// Names of an anatomy's branches: labelled arteries, arch branches and iliac arteries; numbers for all others ("vessel
/// 1" if there are only such).
#include <map>
#include <string>
#include <vector>

#include "vascular/anatomy/anatomy.h"

namespace ostium::vascular {

/// `leaves_m`: per tube, arc length at its parent's wall; `names`: found name to wanted name. all are given at
/// once, so that names may be exchanged. Throws MeshError if a name to be changed does not exist, or two branches would
/// have the same.
void name_branches(const std::vector<double>& leaves_m, const std::map<std::string, std::string>& names,
                   Anatomy& anatomy, std::vector<std::string>& notes);

}  // namespace ostium::vascular
