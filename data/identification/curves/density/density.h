#pragma once
/// Iodine per length of an artery, at sites along it, over time: what a film of an injection gives.
///
/// Law. Blood enters at the ostium with a flow q(t) = mean * shape(phase). What the catheter injects, at the rate r(t),
/// mixes with it at once; what exceeds q runs back into the aorta:
///   c_0(t) = C min(1, r / q).
/// It moves as a plug in V = integral of q dt and spreads like diffusion with the volume passed (Taylor 1953, Proc R
/// Soc A 219:186, whose spread grows with the way): behind a volume W of lumen the plug is later by W, and smeared by a
/// normal law of variance 2 D W. The picture shows k c A, with A the lumen's area.
///
/// Behind a branch or an inflow only the share f of q flows: W = integral of A / f ds, and D counts 1 / f more.
#include "data/identification/curves/set/set_reader.h"

namespace ostium::data::density {

/// Flow over a beat against its mean, linear between phases from 0 to 1.
struct Beat {
  double length_s = 1;
  std::vector<double> phase, relative;
};

/// Flow steps between two samples of a beat (it starts and stops with the heart's contraction). Where, the samples do
/// not tell: it is free within them.
struct Step {
  std::size_t after = 0;  ///< the sample before it
  double at_phase = 0;    ///< the middle; or the end of the beat, if its last sample, at 1, is that of the next one
};
std::vector<Step> steps_of(const Beat& sampled);
/// With the phase of each step twice, before it and behind it.
Beat with_steps(const Beat& sampled, const std::vector<Step>& steps);

struct Injection {
  double rate_m3_s = 0, start_s = 0, length_s = 0;
  double ramp_s = 0;  ///< the rate rises and falls over this time, within the length
  double iodine_kg_m3 = 0;
};

/// One injection.
struct Film {
  Injection injection;
  double flow_m3_s = 0;  ///< mean
  double phase_s = 0;    ///< into the beat at time 0
  Eigen::VectorXd time_s;
};

/// A share of the flow that leaves or joins at a place.
struct Junction {
  double at_m = 0, share = 0;
};
/// From here to there, something is so many times as large.
struct Stretch {
  double from_m = 0, to_m = 0, factor = 1;
};

/// Everything that an effect may change.
struct Setup {
  std::vector<Film> films;
  Eigen::VectorXd place_m, diameter_m;  ///< of the lumen, from the ostium
  Eigen::VectorXd site_m;
  Beat sampled;
  std::vector<Step> steps;
  double m2_per_kg = 0;      ///< k
  double dispersion_m3 = 0;  ///< D
  double iodine = 1;         ///< against what is declared
  double runs_back = 0;      ///< share of the injection
  double glare_m = 0;        ///< added to each density
  double glare_share = 0;    ///< of the mean density of all sites, added to each
  double time_scale = 1;     ///< true times against those of the frames
  double film_later_s = 0;   ///< true times of the frames minus those declared
  double injection_later_s = 0;
  double rise = 0, rise_s = 1;  ///< share by which flow rises with contrast in the end, and its time constant
  Junction inflow, branch;
  Stretch narrow;         ///< factor of the diameter
  Stretch foreshortened;  ///< factor of lengths along the artery as they are projected
};

curves::Kind kind();

/// Of the lumen at a place.
double area_m2(const Setup& setup, double at_m);

/// Densities of each film, in mm, a curve for each site.
std::vector<curves::Curves> densities(const Setup& setup);

using Effect = curves::EffectOn<Setup>;
/// Of an effect whose first number is a place: anywhere from the ostium to the last site.
void along_the_sites(const Setup& declared, std::vector<EffectParameter>& parameters);

/// Each states its law in its source file.
Effect collateral_inflow();
Effect side_branch();
Effect reflux();
Effect concentration();
Effect constant_glare();
Effect glare_of_neighbours();
Effect narrowing();
Effect frame_rate();
Effect late_film();
Effect late_injection();
Effect contrast_hyperaemia();
Effect foreshortening();
Effect foreshortened_stretch();

}  // namespace ostium::data::density
