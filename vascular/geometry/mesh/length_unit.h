#pragma once
/// Length units of files, and their names on the command line and in files.
#include <string>

namespace ostium::vascular {

enum class LengthUnit { millimetre, centimetre, metre, inch };
inline constexpr LengthUnit length_units[] = {LengthUnit::millimetre, LengthUnit::centimetre, LengthUnit::metre,
                                              LengthUnit::inch};

double metres(LengthUnit unit);  ///< in one of them
std::string name_of(LengthUnit unit);
/// "mm", "cm", "m" or "in". Throws MeshError for another name.
LengthUnit unit_named(const std::string& name);

}  // namespace ostium::vascular
