#pragma once
/// A balloon takes rings of a stent along that no wall holds yet. Where the balloon tapers inside a stent, as at a fork
/// where a wide vessel goes on narrower, the stent's rings squeeze it towards the wide side, with the rings that lie
/// round it; links to those that the wall holds are drawn out for good, and the stent gets longer (bench: 0.86 +- 0.74
/// mm per 0.5 mm of proximal overexpansion, EIJ-D-21-00824).
#include "vascular/treatment/stent.h"

namespace ostium::vascular {

/// After the rings have followed their balloons.
void carry_rings(const StentModel& model, const PlaqueModel& plaque, const StentInputs& inputs, const PlaqueState& wall,
                 StentState& state);

}  // namespace ostium::vascular
