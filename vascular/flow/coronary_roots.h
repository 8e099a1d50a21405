#pragma once
/// The arteries that a flow tree begins with, where they leave the aorta.
#include <string>
#include <vector>

#include "vascular/anatomy/anatomy.h"

namespace ostium::vascular {

inline bool is_coronary_root(const std::string& branch) { return branch == "LM" || branch == "RCA"; }

/// Those that an anatomy has; none: it has no flow tree.
inline std::vector<std::string> coronary_roots(const Anatomy& anatomy) {
  std::vector<std::string> names;
  for (const NamedBranch& branch : anatomy.branches)
    if (is_coronary_root(branch.name)) names.push_back(branch.name);
  return names;
}

}  // namespace ostium::vascular
