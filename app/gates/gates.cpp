#include "app/gates/drives.h"
#include "app/gates/gate.h"

namespace ostium::app::gates {

const std::vector<Gate>& gates() {
  static const std::vector<Gate> all = {
      {"rod-swing", "clamped steel wire released from rest, against converged integrators", rod_swing},
      {"rod-static", "cantilever under its own weight, against the exact elastica", rod_static},
      {"rod-torsion", "base turned by 180 degrees in 0.1 s, against quasi-static torsion", rod_torsion},
      {"rod-euler", "buckling load of a cantilever, against Euler", rod_euler},
      {"rod-greenhill", "buckling moment of a twisted clamped rod, against Greenhill", rod_greenhill},
      {"rod-ring", "twist at which a ring leaves its plane, against Michell and Zajac", rod_ring},
      {"rod-link", "link number of a writhing ring, against Calugareanu's theorem", rod_link},
      {"rod-momentum", "free rod, against conservation of momentum", rod_momentum},
      {"rod-section", "a section boundary swept through an element, against a boundary-value solution", rod_section},
      {"nesting", "a rod inside another: shape, snap, push, clearance, against closed forms", nesting},
      {"contact", "rods and walls: friction, sliding, buckling in a tube, against closed forms", contact},
      {"contact-vessel", "guide and wire in a beating vessel, by script and at random: how deep walls let them in",
       contact_in_vessel},
      {"feed", "a wire fed in and out through its introducer, against where it was", feed},
      {"anatomy-lengths", "arteries, ostia and arch, against CT and Dodge 1988", anatomy_lengths},
      {"anatomy-diameters", "the surface's diameters, against Dodge 1992, Hager 2002 and CT", anatomy_diameters},
      {"anatomy-angles", "the left main's bifurcation and the annulus, against CT", anatomy_angles},
      {"anatomy-dodge", "coronary points in eight views, against Dodge 1988", anatomy_dodge},
      {"anatomy-motion", "speeds and rest of the arteries, against Mao 2000 and Wang 1999", anatomy_motion},
      {"anatomy-surface", "the beating surface, closed and uncrossed; tree radii against it", anatomy_surface},
      {"engagement", "guides turned and drawn back in the aortic root: share of people whose ostia they find",
       engagement},
      {"flow", "blood in tubes and arteries, pressures and ST, against closed forms and published velocities", flow},
      {"contrast", "iodine balance and split; TIMI frame counts of rendered frames, against Gibson 1996", contrast},
      {"treatment", "balloons against their charts, stents in five cases against what is published", treatment},
      {"xray-thickness", "X-ray path lengths of a sphere, a cylinder and a slab, against closed forms", xray_thickness},
      {"xray-spectrum", "the tube's beam, against standard radiation qualities (IEC 61267)", xray_spectrum},
      {"xray-wedge", "attenuation at five energies, against the sum in steps of 1 keV", xray_wedge},
      {"xray-scatter", "scatter behind slabs, against photon transport", xray_scatter},
      {"xray-noise", "noise behind water, against counting statistics", xray_noise},
      {"xray-edge", "width of a slanted edge, against the blur that was set", xray_edge},
      {"xray-glare", "the veil in an opaque plate's shadow, against a Gaussian's tail", xray_glare},
      {"xray-lag", "a wire that appears, against the step response", xray_lag},
      {"xray-guide", "an unfilled guide in fluoroscopy, against an ideal observer and Rose's criterion", xray_guide},
      {"xray-stenosis", "a 60 % stenosis measured back from the picture", xray_stenosis},
  };
  return all;
}

std::vector<Gate> selected(const std::string& only) {
  std::vector<Gate> out;
  for (const Gate& gate : gates()) {
    const std::string name = gate.name;
    if (only.starts_with(name) || name.starts_with(only)) out.push_back(gate);
  }
  return out;
}

std::vector<data::GateResult> run(const Gate& gate, const std::string& only, bool quick) {
  std::vector<data::GateResult> results = gate.run(quick);
  std::erase_if(results, [&](const data::GateResult& r) { return !r.gate.starts_with(only); });
  return results;
}

}  // namespace ostium::app::gates
