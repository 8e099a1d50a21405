#include "vascular/heart/circulation.h"

#include <algorithm>
#include <cmath>

namespace ostium::vascular {

namespace {

using units::pi;

constexpr double pull_begins = -0.01, pull_fullest = 0.30, pull_gone = 0.46;  // phases of a ventricle's contraction
constexpr double kick_from = 0.86, kick_to = 0.99;                            // of the atria's
constexpr double longest_part_s = 2e-3;
constexpr double least_tone = 0.85;  // arterioles at rest have little tone to lose [estimate]
constexpr double slowest_s = 60.0 / 30, fastest_s = 60.0 / 175;  // heart periods that a sinus node can have

double atrial_share(double phase) {
  if (phase < kick_from || phase > kick_to) return 0;
  const double s = std::sin(pi * (phase - kick_from) / (kick_to - kick_from));
  return s * s;
}

double ventricle_Pa(const VentricleModel& m, double active, double strength, double V, double outside_Pa) {
  const double a = active * strength;
  return a * m.elastance_Pa_m3 * (V - m.unstressed_m3) +
         (1 - active) * m.passive_Pa * std::expm1(m.stiffening_1_m3 * V) + outside_Pa;
}

/// What was reported `ago_s` ago.
double heard(const CirculationState& s, double ago_s) {
  const int back = static_cast<int>(ago_s / heard_every_s + 0.5);
  return s.heard_Pa[static_cast<std::size_t>((s.heard_at - 1 - back + 2 * heard_count) % heard_count)];
}

void hear(const CirculationModel& model, const CirculationInputs& in, CirculationState& s) {
  const BaroreflexModel& m = model.reflex;
  const double answers = in.reflexes ? m.scale_Pa * std::atan((s.set_Pa - s.mean_Pa) / m.scale_Pa) : 0,
               x = (1 - s.vagal_reaction) * answers - s.vagal_reaction * m.scale_Pa * pi / 2;
  s.vagal_reaction *= std::exp(-heard_every_s / m.reaction_passes_s);
  s.heard_Pa[static_cast<std::size_t>(s.heard_at)] = static_cast<float>(x);
  s.heard_at = (s.heard_at + 1) % heard_count;
  const auto follow = [&](double after_s, double in_s, double& y) {
    y += -std::expm1(-heard_every_s / in_s) * (heard(s, after_s) - y);
  };
  follow(m.vagal_after_s, m.vagal_in_s, s.vagal_Pa);
  follow(m.sympathetic_after_s, m.sympathetic_in_s, s.sympathetic_Pa);
  follow(m.resistance_after_s, m.resistance_in_s, s.resistance_Pa);
  follow(m.contractility_after_s, m.contractility_in_s, s.contractility_Pa);
  follow(m.veins_after_s, m.veins_in_s, s.veins_Pa);
  const double mobilised = m.veins_m3_Pa * s.veins_Pa + model.constricted_m3 * in.constriction - s.venous_tone_m3;
  s.veins_m3 += mobilised, s.venous_tone_m3 += mobilised;
}

/// Of the sinus node, as rest, reflex and drugs have it now.
double rate_1_min(const BaroreflexModel& m, const CirculationInputs& in, const CirculationState& s) {
  const double block = std::clamp(in.vagal_block, 0.0, 1.0);
  const double period = 60 / in.resting_rate_1_min - (1 - block) * m.vagal_s_Pa * s.vagal_Pa -
                        m.sympathetic_s_Pa * s.sympathetic_Pa - block * m.vagal_tone_s;
  return 60 / std::clamp(period / (1 + in.rate_effect), fastest_s, slowest_s);
}

void flow_on(const CirculationModel& m, const CirculationInputs& in, double active, double kick, double dt,
             CirculationState& s) {
  const double of_vessels = m.compressions.of_vessels;
  const double chest = m.chest_Pa + m.breath_Pa * in.breath + of_vessels * in.pressed_Pa;
  const double peri = chest + (1 - of_vessels) * in.pressed_Pa +
                      m.pericardium_Pa * std::expm1(m.pericardium_1_m3 *
                                                    (s.left_m3 + s.right_m3 + s.pericardium_m3 - m.pericardium_m3));
  const double strength = in.contraction * (1 + m.reflex.contractility_1_Pa * s.contractility_Pa);
  const double left = ventricle_Pa(m.left, active, strength * (1 - in.left_lost), s.left_m3, peri);
  const double right = ventricle_Pa(m.right, active, strength * (1 - in.right_lost), s.right_m3, peri);
  const double arteries = s.arteries_m3 / m.arteries_m3_Pa, veins = s.veins_m3 / m.veins_m3_Pa;
  const double lung_arteries = s.lung_arteries_m3 / m.lung_arteries_m3_Pa + chest,
               lung_veins = s.lung_veins_m3 / m.lung_veins_m3_Pa + chest;
  // Veins outside the chest collapse where the pressure in it is below that of the air.
  const auto through = [](double from, double to, double R) { return from > to ? (from - to) / R : 0; };
  const double mitral = through(lung_veins + m.left_kick_Pa * kick, left, m.mitral_Pa_s_m3);
  const double tricuspid =
      through(veins + m.right_kick_Pa * kick, right, m.tricuspid_Pa_s_m3 + m.venous_return_Pa_s_m3);
  const double pulmonary = through(right, lung_arteries, m.pulmonary_valve_Pa_s_m3);
  const double lungs = (lung_arteries - lung_veins) / m.lungs_Pa_s_m3;
  const double R = m.resistance_Pa_s_m3 * (1 - 0.5 * std::clamp(in.dilation, 0.0, 1.0)) * (1 + in.constriction) *
                   std::max(least_tone, 1 + m.reflex.resistance_1_Pa * s.resistance_Pa);
  const double systemic = (arteries - veins) / R;
  const double spent = m.source_s_m3 * std::max(0.0, left - peri);
  if (!s.open && left > arteries) s.open = true, s.back_m3 = 0;
  if (s.open) {
    const double L = m.inertance_Pa_s2_m3;
    s.aortic_m3_s = (s.aortic_m3_s + dt / L * (left - arteries)) /
                    (1 + dt / L * (m.aortic_valve_Pa_s_m3 + m.impedance_Pa_s_m3 + spent));
    if (s.aortic_m3_s < 0) s.back_m3 -= s.aortic_m3_s * dt;
    if (s.back_m3 > m.shuts_m3) s.open = false, s.aortic_m3_s = 0;
  }
  const double leak = in.leak_m3_s * dt, drain = std::min(in.drain_m3_s * dt, s.pericardium_m3),
               infusion = in.infusion_m3_s * dt, drawn = in.drawn_m3_s * dt;
  s.left_m3 += dt * (mitral - s.aortic_m3_s);
  s.arteries_m3 += dt * (s.aortic_m3_s - systemic) - leak - drawn;
  s.veins_m3 += dt * (systemic - tricuspid) + infusion;
  s.right_m3 += dt * (tricuspid - pulmonary);
  s.lung_arteries_m3 += dt * (pulmonary - lungs);
  s.lung_veins_m3 += dt * (lungs - mitral);
  s.pericardium_m3 += leak - drain;
  s.infused_m3 += infusion, s.drained_m3 += drain, s.drawn_m3 += drawn;
  s.left_Pa = left - spent * std::max(0.0, s.aortic_m3_s), s.pericardium_Pa = peri, s.venous_Pa = veins;
}

}  // namespace

double contraction_share(double phase) {
  const double t = phase > 0.5 ? phase - 1 : phase;
  if (t <= pull_begins || t >= pull_gone) return 0;
  return t < pull_fullest ? 0.5 * (1 - std::cos(pi * (t - pull_begins) / (pull_fullest - pull_begins)))
                          : 0.5 * (1 + std::cos(pi * (t - pull_fullest) / (pull_gone - pull_fullest)));
}

void step(const CirculationModel& model, const CirculationInputs& in, double dt_s, CirculationState& s) {
  const int parts = std::max(1, static_cast<int>(std::ceil(dt_s / longest_part_s - 1e-9)));
  const double active = contraction_share(in.phase), kick = atrial_share(in.phase);
  for (int i = 0; i < parts; ++i) flow_on(model, in, active, kick, dt_s / parts, s);
  s.mean_Pa += -std::expm1(-dt_s / model.reflex.averaging_s) * (s.arteries_m3 / model.arteries_m3_Pa - s.mean_Pa);
  s.heard_s += dt_s;
  while (s.heard_s >= heard_every_s * (1 - 1e-9)) s.heard_s -= heard_every_s, hear(model, in, s);
  s.rate_1_min = rate_1_min(model.reflex, in, s);
}

void settle_reflex(CirculationState& s) {
  s.set_Pa = s.mean_Pa;
  s.heard_Pa.fill(0);
  s.vagal_Pa = s.sympathetic_Pa = s.resistance_Pa = s.contractility_Pa = s.veins_Pa = 0;
}

double conserved_m3(const CirculationState& s) {
  return s.left_m3 + s.right_m3 + s.arteries_m3 + s.veins_m3 + s.lung_arteries_m3 + s.lung_veins_m3 + s.pericardium_m3 -
         s.infused_m3 + s.drained_m3 + s.drawn_m3 - s.venous_tone_m3;
}

}  // namespace ostium::vascular
