#pragma once

namespace ostium::core {

/// How one end of a rod is held. An end that is let go of and held again is held where it is then.
enum class Hold : unsigned char {
  free,     ///< not at all
  pinned,   ///< its position
  clamped,  ///< its position and material frame
  guided,   ///< its material frame, and its position across the frame's d3; it slides along d3
};

}  // namespace ostium::core
