#pragma once
/// Contrast from the syringe to the myocardium: line and catheter, sinus and aorta, the coronary tree.
///
/// In the arteries blood flows in `layers` concentric sheaths that carry equal flow, the inner ones faster, as in
/// Poiseuille's profile: the flow share q lies within the share x = 1 - sqrt(1 - q) of the cross-section. A front is
/// therefore stretched as in laminar flow; sheaths mix at bifurcations, and slowly elsewhere. Contrast that enters the
/// myocardium is gone.
#include <array>
#include <span>

#include "vascular/contrast/advection.h"
#include "vascular/flow/flow.h"

namespace ostium::vascular {

inline constexpr int layers = 4;
inline constexpr int line_cells = 64;

/// The path from syringe to tip. Initially full of saline or blood.
struct Line {
  double dead_m3 = 2.5e-6;          ///< volume of manifold line and catheter (6F: 2.5 mL)
  double bore_m = 0.9e-3;           ///< radius of the catheter's lumen
  double length_m = 1.0;            ///< of the catheter's lumen
  double hand_Pa = 4e5;             ///< largest thumb pressure [estimate]
  double viscosity_Pa_s = 10.4e-3;  ///< of iohexol 350 at 37 C (label)
  double vacuum_Pa = 8e4;           ///< that a syringe pulled by hand reaches [estimate], on blood:
  double blood_Pa_s = 3.5e-3;
};

struct ContrastModel {
  double mixing_s = 2.0;             ///< mixing of sheaths by bends and cardiac motion [estimate]
  double dispersion_m2_s = 2e-5;     ///< along a vessel, by cardiac motion: lets contrast enter a dead end [estimate]
  double sinus_m3 = 3e-6;            ///< each sinus
  double sinus_flow_m3_s = 6e-6;     ///< constant exchange with the root, plus
  double sinus_share = 0.12;         ///< this share of the ejected flow
  std::array<double, layers> share;  ///< of the cross-section in each sheath; set by make_contrast_model
  std::vector<double> aorta_length_m, aorta_radius_m;  ///< of its cells, from the root
  std::array<int, 2> ostium_cell{};                    ///< aorta cells at the left and right ostium
  std::array<int, 2> coronary_branch{};                ///< branches of the flow tree: LM and RCA; -1: none
  std::vector<double> mixes;                           ///< (#cells) 1 where side branches leave, otherwise 0
};
ContrastModel make_contrast_model(const FlowModel& flow, const Patient& patient);
/// Without an aorta, for tests.
ContrastModel make_contrast_model(const FlowModel& flow);

/// Location of the catheter's end hole.
struct TipPlace {
  enum class Where { outside, aorta, left_sinus, right_sinus, coronary };
  using enum Where;
  Where where = outside;
  int cell = 0;            ///< of the aorta, or of the flow tree
  double into_ostium = 0;  ///< [0, 1]: in a sinus, the share of the jet that enters the ostium
};
constexpr auto fields(const TipPlace*) {
  return std::tuple{core::field("where", &TipPlace::where), core::field("cell", &TipPlace::cell),
                    core::field("into_ostium", &TipPlace::into_ostium)};
}

struct ContrastInputs {
  double injection_m3_s = 0;   ///< requested; a negative value is refused
  double iodine_kg_m3 = 350;   ///< of the syringe's contents; 0: saline
  double aspiration_m3_s = 0;  ///< drawn back through the catheter (drawn_m3_s); not while something is injected
  double shaft_m = 0;          ///< radius of a shaft inside the catheter
  Line line;
  TipPlace tip;
};

struct ContrastState {
  std::vector<double> line_kg;       ///< (line_cells) from syringe to tip
  std::vector<double> sheath_kg;     ///< (#layers x #cells) iodine per sheath
  std::vector<double> aorta_kg;      ///< (#aorta cells)
  std::array<double, 2> sinus_kg{};  ///< left, right
  double injected_kg = 0;            ///< out of the syringe
  double injected_m3 = 0;            ///< volume out of the syringe
  double from_tip_kg = 0;            ///< out of the catheter
  double aspirated_kg = 0;
  std::array<double, 2> muscle_kg{};  ///< that came into the myocardium: through the left, the right coronary
  double carried_kg = 0;              ///< lost down the aorta, or from a tip outside the heart
  double outside_kg = 0;              ///< left the vessel through an injury
};
constexpr auto fields(const ContrastState*) {
  using S = ContrastState;
  return std::tuple{core::field("line_kg", &S::line_kg),         core::field("sheath_kg", &S::sheath_kg),
                    core::field("aorta_kg", &S::aorta_kg),       core::field("sinus_kg", &S::sinus_kg),
                    core::field("injected_kg", &S::injected_kg), core::field("injected_m3", &S::injected_m3),
                    core::field("from_tip_kg", &S::from_tip_kg), core::field("aspirated_kg", &S::aspirated_kg),
                    core::field("muscle_kg", &S::muscle_kg),     core::field("carried_kg", &S::carried_kg),
                    core::field("outside_kg", &S::outside_kg)};
}
ContrastState make_contrast_state(const ContrastModel& model, const FlowModel& flow);

struct ContrastReport {
  double rate_m3_s = 0;   ///< flow through line and catheter
  double selective = 0;   ///< share of it that entered the coronary
  double drawn_m3_s = 0;  ///< aspirated
  bool refused = false;   ///< a negative or non-finite rate was taken as zero
};

struct ContrastScratch {
  std::vector<double> cell_m3, volume, passing, mass, inlet, entering, through;
  CarryScratch carry;
};

/// The blood flow that carries contrast in a step.
struct BloodNow {
  const FlowModel& flow;
  const FlowState& state;
  const FlowInputs& lumen;
  double ejection_m3_s = 0;
};

/// One step of up to 10 ms, with the flow of that step.
ContrastReport step(const ContrastModel& model, const BloodNow& now, const ContrastInputs& inputs, double dt_s,
                    ContrastState& state, ContrastScratch& scratch);

/// What a syringe that asks for `asked_m3_s` draws of blood through a catheter, around a shaft if there is one.
double drawn_m3_s(double asked_m3_s, const Line& line, double shaft_m);

/// Mean over the cross-section of a coronary cell, kg/m3; `area_m2`: free for blood.
double concentration(const ContrastState& state, const FlowModel& flow, int cell, double area_m2);
double aorta_concentration(const ContrastModel& model, const ContrastState& state, int cell);
/// A coronary tree, `side` 0: left, 1: right, as it is in a picture full of contrast; nothing elsewhere changes.
/// `radius_m` and `occupied_m` (or empty): (#cells), as in FlowInputs.
void fill_tree(const ContrastModel& model, const FlowModel& flow, int side, double iodine_kg_m3,
               std::span<const double> radius_m, std::span<const double> occupied_m, ContrastState& state);
/// All iodine: in line, vessels and everywhere it went; equals injected_kg.
double accounted_kg(const ContrastState& state);

}  // namespace ostium::vascular
