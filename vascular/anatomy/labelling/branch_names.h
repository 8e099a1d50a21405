#pragma once
/// Names of an anatomy's branches: those recognised, of the arch, the iliac arteries; numbers for the others.
#include <map>
#include <string>
#include <vector>

#include "vascular/anatomy/anatomy.h"

namespace ostium::vascular {

/// `leaves_m`: of each tube, where it leaves its parent's wall; `names`: found name to wanted name. Throws MeshError if
/// a name to be changed is not there.
void name_branches(const std::vector<double>& leaves_m, const std::map<std::string, std::string>& names,
                   Anatomy& anatomy, std::vector<std::string>& notes);

}  // namespace ostium::vascular
