#pragma once
/// The physics gates of `ostium verify`. Each compares the shipped code, at the shipped settings, with a closed form,
/// an independent solver or a published measurement; never with our own earlier output.
///
/// To add one: a source file here with a function of this signature, its declaration below, its line in gates.cpp and
/// its name in tests/CMakeLists.txt.
#include <string>
#include <vector>

#include "data/assessment/gate_report.h"

namespace ostium::app::gates {

struct Gate {
  const char* name;                                  ///< prefix of its results' names
  const char* what;                                  ///< one line: what is compared with what
  std::vector<data::GateResult> (*run)(bool quick);  ///< quick: fewer elements or cases, the same tolerances
};

/// All gates, in the order in which they run.
const std::vector<Gate>& gates();

/// The gates matching `--only only`: those whose name is a prefix of it or begins with it; all if it is empty.
std::vector<Gate> selected(const std::string& only);

/// The results of one gate that match `only`: those whose name begins with it.
std::vector<data::GateResult> run(const Gate& gate, const std::string& only, bool quick);

// --- rods --------------------------------------------------------------------------------------------------------
std::vector<data::GateResult> rod_swing(bool quick);
/// The first result alone, at any number of elements: reported beside speeds.
data::GateResult swing_tip(int elements);
std::vector<data::GateResult> rod_static(bool quick);
std::vector<data::GateResult> rod_torsion(bool quick);
std::vector<data::GateResult> rod_euler(bool quick);
std::vector<data::GateResult> rod_greenhill(bool quick);
std::vector<data::GateResult> rod_ring(bool quick);
std::vector<data::GateResult> rod_link(bool quick);
std::vector<data::GateResult> rod_momentum(bool quick);
std::vector<data::GateResult> rod_section(bool quick);

// --- nesting ------------------------------------------------------------------------------------------------------
std::vector<data::GateResult> nesting(bool quick);

// --- contact ------------------------------------------------------------------------------------------------------
std::vector<data::GateResult> contact(bool quick);

// --- driving -----------------------------------------------------------------------------------------------------
std::vector<data::GateResult> feed(bool quick);
/// The first part with any number of trips: fed `length_m` in and out that often.
std::vector<data::GateResult> feed_round_trips(int trips, double length_m);

// --- anatomy -----------------------------------------------------------------------------------------------------
std::vector<data::GateResult> anatomy_lengths(bool quick);
std::vector<data::GateResult> anatomy_diameters(bool quick);
std::vector<data::GateResult> anatomy_angles(bool quick);
std::vector<data::GateResult> anatomy_dodge(bool quick);
std::vector<data::GateResult> anatomy_motion(bool quick);
std::vector<data::GateResult> anatomy_surface(bool quick);
// --- instruments in the anatomy -----------------------------------------------------------------------------------
std::vector<data::GateResult> engagement(bool quick);
// --- what lives and what is done ---------------------------------------------------------------------------------
std::vector<data::GateResult> flow(bool quick);
std::vector<data::GateResult> contrast(bool quick);
std::vector<data::GateResult> treatment(bool quick);
// --- the X-ray picture -------------------------------------------------------------------------------------------
std::vector<data::GateResult> xray_thickness(bool quick);
std::vector<data::GateResult> xray_spectrum(bool quick);
std::vector<data::GateResult> xray_wedge(bool quick);
std::vector<data::GateResult> xray_scatter(bool quick);
std::vector<data::GateResult> xray_noise(bool quick);
std::vector<data::GateResult> xray_edge(bool quick);
std::vector<data::GateResult> xray_glare(bool quick);
std::vector<data::GateResult> xray_lag(bool quick);
std::vector<data::GateResult> xray_guide(bool quick);
std::vector<data::GateResult> xray_stenosis(bool quick);

}  // namespace ostium::app::gates
