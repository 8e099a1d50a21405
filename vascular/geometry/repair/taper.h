#pragma once
/// Where two ends that belong together differ in calibre: a shelf, on which instruments would stop, becomes a taper. (A
/// vessel drawn in pieces, one by its inner wall and the next one by its outer.)
#include "vascular/geometry/repair/sheets.h"

namespace ostium::vascular {

struct Taper {
  double step_m = 0;    ///< between the rims, at its highest; 0: nothing was done
  double length_m = 0;  ///< of what was moved, along the wall
};

/// For two openings that face each other, before they are joined: the wider end is narrowed towards the other one, by
/// less and less along its wall; the narrower end stays. Steps that the gap between them, or the size of the vessel,
/// makes gentle are left alone. Only vertices move.
Taper taper(Mesh& mesh, const Sheets& sheets, const Opening& a, const Opening& b);

}  // namespace ostium::vascular
