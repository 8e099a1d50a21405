#pragma once
/// The physics gates of `ostium verify`. Each compares what ships, at the settings that ship, with a closed form, an
/// independent solver or a published measurement; never with earlier output of our own.
///
/// Adding one: a source file here with a function of this shape, its declaration below, its line in gates.cpp and its
/// name in tests/CMakeLists.txt.
#include <string>
#include <vector>

#include "data/assessment/gate_report.h"

namespace ostium::verify {

struct Gate {
  const char* name;                            ///< its results' names begin with it
  const char* what;                            ///< one line: what is compared with what
  std::vector<GateResult> (*run)(bool quick);  ///< quick: fewer elements or cases, the same tolerances
};

/// All gates, in the order in which they run.
const std::vector<Gate>& gates();

/// Gates that `--only only` asks for: those whose name begins with it or that it begins with; all if it is empty.
std::vector<Gate> selected(const std::string& only);

/// Results of one gate that `only` asks for: those whose name begins with it.
std::vector<GateResult> run(const Gate& gate, const std::string& only, bool quick);

// --- rods --------------------------------------------------------------------------------------------------------
std::vector<GateResult> rod_swing(bool quick);
/// The first gate alone, at any number of elements: what a speed is reported beside.
GateResult swing_tip(int elements);
std::vector<GateResult> rod_static(bool quick);
std::vector<GateResult> rod_torsion(bool quick);
std::vector<GateResult> rod_euler(bool quick);
std::vector<GateResult> rod_greenhill(bool quick);
std::vector<GateResult> rod_ring(bool quick);
std::vector<GateResult> rod_link(bool quick);
std::vector<GateResult> rod_momentum(bool quick);
std::vector<GateResult> rod_section(bool quick);

// --- nesting ------------------------------------------------------------------------------------------------------
std::vector<GateResult> nesting(bool quick);

// --- contact ------------------------------------------------------------------------------------------------------
std::vector<GateResult> contact(bool quick);

// --- driving -----------------------------------------------------------------------------------------------------
std::vector<GateResult> feed(bool quick);
/// Its first part with any number of trips: fed `length_m` in and out so often.
std::vector<GateResult> feed_round_trips(int trips, double length_m);

// --- anatomy -----------------------------------------------------------------------------------------------------
std::vector<GateResult> anatomy_lengths(bool quick);
std::vector<GateResult> anatomy_diameters(bool quick);
std::vector<GateResult> anatomy_angles(bool quick);
std::vector<GateResult> anatomy_dodge(bool quick);
std::vector<GateResult> anatomy_motion(bool quick);
std::vector<GateResult> anatomy_surface(bool quick);
// --- instruments in the anatomy -----------------------------------------------------------------------------------
std::vector<GateResult> engagement(bool quick);
// --- what lives and what is done ---------------------------------------------------------------------------------
std::vector<GateResult> flow(bool quick);
std::vector<GateResult> contrast(bool quick);
std::vector<GateResult> treatment(bool quick);
// --- the X-ray picture -------------------------------------------------------------------------------------------
std::vector<GateResult> xray_thickness(bool quick);
std::vector<GateResult> xray_spectrum(bool quick);
std::vector<GateResult> xray_wedge(bool quick);
std::vector<GateResult> xray_scatter(bool quick);
std::vector<GateResult> xray_noise(bool quick);
std::vector<GateResult> xray_edge(bool quick);
std::vector<GateResult> xray_lag(bool quick);
std::vector<GateResult> xray_stenosis(bool quick);

}  // namespace ostium::verify
