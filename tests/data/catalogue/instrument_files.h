#pragma once
/// A small valid instrument, and the reader's message for a modified one.
#include <string>

#include "data/catalogue/instrument/instrument_reader.h"

namespace ostium::data {

inline const std::string small_catheter = R"({
  "schema": "ostium-instrument/1",
  "name": "hook",
  "title": "A hook",
  "kind": "guide_catheter",
  "size": {
    "outer_diameter_mm": 2, "inner_diameter_mm": 1.8, "length_mm": 1000,
    "source": "a test"
  },
  "sections": {
    "list": [
      { "from_tip_mm": [0, 40], "EI_Nmm2": 30, "GJ_Nmm2": 20, "kg_per_m": 0.001 },
      { "from_tip_mm": [40, 1000], "EI1_Nmm2": 300, "EI2_Nmm2": 200, "GJ_Nmm2": 250, "kg_per_m": 0.002 }
    ],
    "source": "a test"
  },
  "shape": {
    "pieces": [
      { "length_mm": 10 },
      { "length_mm": 31.41592653589793, "radius_mm": 20, "plane_deg": 0 }
    ],
    "source": "a test"
  },
  "radiopacity": {
    "list": [ { "from_tip_mm": [0, 1000], "material": "steel", "thickness_mm": 0.05 } ],
    "source": "a test"
  },
  "markers": {
    "list": [
      { "from_tip_mm": 5, "length_mm": 1, "material": "gold", "thickness_mm": 0.1 }
    ],
    "source": "estimate: because a test needs one"
  },
  "clearance": {
    "passes_mm": 1.75, "source": "a test"
  }
}
)";

/// `text` with the first `what` replaced.
inline std::string with(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  return at == std::string::npos ? "no " + what : text.replace(at, what.size(), by);
}

/// The message that reading `text` as hook.json throws.
inline std::string refusal(const std::string& text) {
  try {
    read_instrument("folder/hook.json", text);
  } catch (const LoadError& error) {
    return error.what();
  }
  return "accepted";
}

/// The same after replacing `what` in the small catheter.
inline std::string refusal(const std::string& what, const std::string& by) {
  return refusal(with(small_catheter, what, by));
}

}  // namespace ostium::data
