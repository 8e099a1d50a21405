#pragma once
/// An instrument of the catalogue: kind, stiffness along its length, shape at rest, radiopacity, and what fits into
/// what. SI; lengths are measured from the distal tip.
///
/// One file per instrument, `data/instruments/NAME.json` (schema ostium-instrument/1); read by instrument_reader.h.
#include <optional>
#include <string>
#include <vector>

#include "core/material/section.h"
#include "data/catalogue/instrument/instrument_shape.h"
#include "vascular/treatment/balloon_design.h"
#include "vascular/treatment/stent_design.h"

namespace ostium::data {

/// Lengths in a file that differ by less are the same.
inline constexpr double gap_tolerance_mm = 1e-6;

enum class InstrumentKind { wire, guide_catheter, diagnostic_catheter, sheath, balloon_shaft, stent_shaft };
/// Names used in files, in the order of the enumeration: "guide_catheter".
const std::vector<std::string>& instrument_kinds();
std::string words_for(InstrumentKind kind);  ///< "guide catheter"

/// The material that absorbs X-rays.
enum class OpaqueMaterial { polymer, steel, nitinol, cobalt_chromium, platinum, tungsten, gold, barium_sulphate };
const std::vector<std::string>& opaque_materials();

/// A stretch of uniform radiopacity.
struct OpaqueStretch {
  double from_tip_m = 0, to_tip_m = 0;
  OpaqueMaterial material = OpaqueMaterial::polymer;
  /// Cross-section of the solid material divided by the outer diameter: the mean thickness a ray across it meets; >= 0.
  double thickness_m = 0;
};

/// A radiopaque band.
struct Marker {
  double from_tip_m = 0;  ///< its distal edge
  double length_m = 0;
  OpaqueMaterial material = OpaqueMaterial::platinum;
  double thickness_m = 0;                       ///< as in OpaqueStretch, of the band alone
  std::optional<double> outer_diameter_m = {};  ///< its own: a solid ring within the instrument; none: spread over it
};

/// How a balloon or stent shaft runs over its wire.
struct WireLumen {
  bool rapid_exchange = true;  ///< false: over the wire
  double length_m = 0;         ///< from the tip to the port where the wire leaves; over the wire: the whole length
};

/// The stretch of a wire that the operator bends before use.
struct ShapeableTip {
  double length_m = 0;                    ///< from the tip
  std::vector<ShapePiece> default_shape;  ///< as delivered; not longer than length_m
};

/// The balloon of a balloon or stent shaft, folded around its distal end between two markers.
struct CarriedBalloon {
  double nominal_m = 0;   ///< diameter at the nominal pressure
  double length_m = 0;    ///< between the centres of the markers
  bool compliant = true;  ///< semi-compliant; false: non-compliant
  double nominal_Pa = 0, rated_Pa = 0;
  vascular::BalloonDesign design;
  bool own_folds = false;  ///< `design` gives the folded thickness; otherwise, without a stent, the shaft's sections do
};

/// The stent crimped on the balloon.
struct CarriedStent {
  double nominal_m = 0;  ///< nominal diameter, expanded
  double length_m = 0;   ///< crimped
  vascular::StentDesign design;
};

/// Standard errors of what was measured on a stretch, N m2; 0: it was not measured.
struct StiffnessError {
  double from_tip_m = 0, to_tip_m = 0, EI_N_m2 = 0, GJ_N_m2 = 0;
};

/// Friction against the tubes of a bench, with its standard error.
struct MeasuredFriction {
  double coefficient = 0, sigma = 0;
};

/// The source of a group of numbers.
struct Source {
  std::string of;        ///< "size", "sections", "sections.list[2]"
  std::string citation;  ///< a publication or standard, "measured: " and on what, or "estimate: " and the reasoning
  bool estimate() const { return citation.rfind("estimate:", 0) == 0; }
  bool measured() const { return citation.rfind("measured:", 0) == 0; }
};

struct Instrument {
  std::string name;   ///< id, the file's name without .json
  std::string title;  ///< name to show
  InstrumentKind kind = InstrumentKind::wire;
  double outer_diameter_m = 0;          ///< the largest anywhere
  double inner_diameter_m = 0;          ///< of the lumen that a wire or catheter goes through; 0 for a wire
  double length_m = 0;                  ///< usable length
  std::vector<core::Section> sections;  ///< with the shape at rest, including the tip's default shape
  core::Relaxation relaxation;          ///< of all sections
  std::vector<ShapePiece> shape;        ///< of a preformed catheter or J wire; empty if straight
  double width_m = 0;                   ///< of that shape, from the shaft to the tip; 0 if not given
  std::vector<OpaqueStretch> opaque;    ///< the whole length, from the tip
  std::vector<Marker> markers;
  std::optional<WireLumen> wire_lumen;           ///< of balloon and stent shafts
  std::optional<CarriedBalloon> balloon;         ///< of balloon and stent shafts
  std::optional<CarriedStent> stent;             ///< of stent shafts
  std::optional<ShapeableTip> shapeable_tip;     ///< of wires
  double passes_m = 0;                           ///< largest diameter that fits through its lumen; <= inner diameter
  double needs_m = 0;                            ///< smallest lumen that it fits through; >= outer diameter
  std::vector<StiffnessError> stiffness_errors;  ///< of sections that were measured
  std::optional<MeasuredFriction> friction;      ///< a session has the vessel's own
  std::vector<Source> sources;                   ///< in file order
};

/// Whether contrast can be given through it: a guide or a diagnostic catheter.
inline bool is_catheter(const Instrument& i) {
  return i.kind == InstrumentKind::guide_catheter || i.kind == InstrumentKind::diagnostic_catheter;
}

/// "published", "measured" or "estimate" if all sources are that, else "mixed".
std::string source_mark(const Instrument& instrument);

/// Lengths of the elements with which a session simulates it, base first: 1 mm over its last 150 mm, from there growing
/// to 4 mm. A catheter that stays in the aorta has 2 mm behind its last 40 mm, growing to 8 mm. No element longer than
/// 0.5 mm is so long that its rest shape bends by more than 0.2 rad within it.
std::vector<double> element_lengths(const Instrument& instrument);

/// The description `core` needs. Elements run from base to tip; their sum is at most the length (the rest stays
/// proximal to the base). Undamped: the caller sets the damping. Throws std::invalid_argument as core's `check` does.
core::RodDescription rod_description(const Instrument& instrument, std::vector<double> element_lengths_m);

/// The same wire with its tip bent into `pieces`, which start at the tip. Throws std::invalid_argument if the tip
/// cannot be shaped or the pieces are longer than its shapeable stretch.
Instrument with_tip_shape(const Instrument& wire, const std::vector<ShapePiece>& pieces);

/// Whether `inner` fits through the lumen of `outer`.
bool fits_inside(const Instrument& inner, const Instrument& outer);
/// Throws std::invalid_argument with both names and diameters if it does not.
void require_fit(const Instrument& inner, const Instrument& outer);

}  // namespace ostium::data
