#include "vascular/physiology/physiology.h"

namespace ostium::vascular {

PhysiologyModel make_physiology(const Patient& patient, std::uint64_t seed) {
  PhysiologyModel model{.heart = {},
                        .ischaemia = ischaemia_of(seed),
                        .flow = make_flow_model(flow_tree_of(patient)),
                        .contrast = {},
                        .line = {}};
  model.heart.seed = seed;
  model.contrast = make_contrast_model(model.flow, patient);
  return model;
}

PhysiologyState make_state(const PhysiologyModel& model) {
  PhysiologyState s;
  s.flow = make_flow_state(model.flow);
  s.contrast = make_contrast_state(model.contrast, model.flow);
  s.air.muscle_m3.assign(model.flow.tree.branches.size(), 0);
  for (const FlowCell& cell : model.flow.tree.cells) s.radius_m.push_back(cell.diseased_m);
  return s;
}

void burden(const PhysiologyModel& model, const PhysiologyState& s, CirculationInputs& body) {
  weaken(s.ischaemia, body);
  react(model.reaction, s.reaction, body);
}

ContrastReport step(const PhysiologyModel& model, const PhysiologyInputs& in, double dt_s, PhysiologyState& s,
                    PhysiologyScratch& x) {
  const int before = s.heart.beats;
  HeartInputs heart = in.heart;
  burden(model, s, heart.body);
  step(model.heart, heart, dt_s, s.heart);
  return circulate(model, in, dt_s, s.heart.beats > before, s, x);
}

ContrastReport circulate(const PhysiologyModel& model, const PhysiologyInputs& in, double dt_s, bool beat_begins,
                         PhysiologyState& s, PhysiologyScratch& x) {
  const Pressures now = pressures(model.heart, s.heart);
  const bool coronary = in.contrast.tip.where == TipPlace::coronary;
  step(model.line,
       {now, coronary ? s.flow.pressure_Pa[in.contrast.tip.cell] : 0, in.contrast.tip, in.tip_in_ventricle,
        in.tip_covered, in.wire_in_catheter || in.contrast.injection_m3_s > 0 || in.contrast.aspiration_m3_s > 0,
        beat_begins},
       dt_s, s.line);
  s.circulation_s += dt_s;
  if (s.circulation_s < circulation_step_s * (1 - 1e-9)) return {};
  const double dt = s.circulation_s;
  s.circulation_s = 0;
  open_share(model.air, model.flow, s.air, x.open);
  const FlowInputs lumen{now, s.radius_m, in.occupied_m, in.hyperaemia, x.open};
  step(model.flow, lumen, dt, s.flow, x.flow);
  step(model.ischaemia, supply(model.flow, s.flow), dt, s.ischaemia);
  step(model.awareness, s.ischaemia, s.heart.circulation.mean_Pa, dt, s.awareness);
  const std::array<double, 2> muscle_kg = s.contrast.muscle_kg;
  const ContrastReport report = step(model.contrast, {model.flow, s.flow, lumen, s.heart.circulation.aortic_m3_s},
                                     in.contrast, dt, s.contrast, x.contrast);
  step(model.reaction, {s.contrast.muscle_kg[0] - muscle_kg[0], s.contrast.muscle_kg[1] - muscle_kg[1]}, dt,
       s.reaction);
  const double pushed_m3 = dt * (report.rate_m3_s - report.drawn_m3_s);
  const double came_m3 = step(model.air, model.contrast, model.flow, s.flow,
                              {pushed_m3, in.contrast.line.dead_m3, in.contrast.tip, now.aorta_Pa}, dt, s.air);
  if (came_m3 > 0 && beats(s.heart) && is_fatal(model.air, model.heart.seed, in_muscle_m3(s.air)))
    s.heart.rhythm = Rhythm::fibrillation;
  return report;
}

}  // namespace ostium::vascular
