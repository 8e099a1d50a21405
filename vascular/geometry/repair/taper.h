#pragma once
/// Where two matching ends differ in calibre: replaces the shelf, on which instruments would catch, by a taper. (Occurs
/// if one piece of a vessel was drawn by its inner wall and the next by its outer.)
#include "vascular/geometry/repair/sheets.h"

namespace ostium::vascular {

struct Taper {
  double step_m = 0;    ///< between the rims, at its highest; 0: nothing done
  double length_m = 0;  ///< of the moved stretch, along the wall
};

/// For two openings that face each other, before they are joined: narrows the wider end towards the other, decreasingly
/// along its wall; the narrower end is unchanged. Steps that are gentle relative to the gap or the vessel's size are
/// left alone. Only vertices move.
Taper taper(Mesh& mesh, const Sheets& sheets, const Opening& a, const Opening& b);

}  // namespace ostium::vascular
