#pragma once
/// Pictures to learn from, to choose by and to test on. A person is in one of them only, whatever the case and the
/// seed.
#include <string>
#include <vector>

#include "app/session/operator/setup.h"

namespace ostium::app {

enum class Split { train, val, test };
const char* split_name(Split split);

/// Of each run, by the person of each: 70, 15 and 15 % of the persons, to whole ones; below four, all are to learn
/// from. The order of persons is by a hash of their names, so that it has nothing to do with that in which they were
/// given.
std::vector<Split> splits_of(const std::vector<std::string>& persons);

/// "person 7"; of imported vessels and meshes, their name.
std::string person_of(const RunSetup& setup);

}  // namespace ostium::app
