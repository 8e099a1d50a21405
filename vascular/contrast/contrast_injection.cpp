#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "vascular/contrast/contrast_step.h"

namespace ostium::vascular {

namespace {

using units::pi;

/// Pushes a volume into the line; `mass` is listed from where it enters. Returns the iodine that leaves at the other
/// end.
double push(double volume_m3, double entering_kg_m3, double dead_m3, ContrastScratch& x) {
  x.volume.assign(line_cells, dead_m3 / line_cells), x.passing.assign(line_cells + 1, volume_m3);
  x.through.resize(line_cells + 1);
  carry(x.mass, x.volume, x.passing, entering_kg_m3, x.through, x.carry);
  for (int i = 0; i < line_cells; ++i) x.mass[i] += x.through[i] - x.through[i + 1];
  return x.through[line_cells];
}

double push_line(const ContrastInputs& in, double volume_m3, ContrastState& s, ContrastScratch& x) {
  x.mass.assign(s.line_kg.begin(), s.line_kg.end());
  const double out = push(volume_m3, in.iodine_kg_m3, in.line.dead_m3, x);
  std::copy(x.mass.begin(), x.mass.end(), s.line_kg.begin());
  s.injected_kg += in.iodine_kg_m3 * volume_m3, s.injected_m3 += volume_m3;
  s.from_tip_kg += out;
  return out;
}

/// Draws back. Returns the iodine taken from the tip's location.
double draw_line(double volume_m3, double dead_m3, double tip_kg_m3, ContrastState& s, ContrastScratch& x) {
  x.mass.assign(s.line_kg.rbegin(), s.line_kg.rend());
  s.aspirated_kg += push(volume_m3, tip_kg_m3, dead_m3, x);
  std::copy(x.mass.rbegin(), x.mass.rend(), s.line_kg.begin());
  return tip_kg_m3 * volume_m3;
}

/// Poiseuille flow through the catheter per pressure and fluidity, around a shaft if there is one, m3.
double conductance_m3(const Line& line, double shaft_m) {
  const double r2 = line.bore_m * line.bore_m, a = std::min(shaft_m, 0.98 * line.bore_m), a2 = a * a;
  const double fourth = a > 0 ? r2 * r2 - a2 * a2 - (r2 - a2) * (r2 - a2) / std::log(line.bore_m / a) : r2 * r2;
  return pi * fourth / (8 * line.length_m);
}

}  // namespace

double drawn_m3_s(double asked_m3_s, const Line& line, double shaft_m) {
  if (!(asked_m3_s > 0) || !std::isfinite(asked_m3_s)) return 0;
  return std::min(asked_m3_s, line.vacuum_Pa / line.blood_Pa_s * conductance_m3(line, shaft_m));
}

void ContrastStep::inject() {
  x.entering.assign(2 * n(), 0);  // at each cell's upstream face: m3, then kg
  double rate = in.injection_m3_s;
  if (!(rate >= 0) || !std::isfinite(rate) || !(in.iodine_kg_m3 >= 0)) rate = 0, report.refused = true;
  report.rate_m3_s = rate =
      std::min(rate, in.line.hand_Pa / in.line.viscosity_Pa_s * conductance_m3(in.line, in.shaft_m));
  if (in.aspiration_m3_s > 0 && rate == 0) return aspirate();
  if (rate == 0) return;
  const double kg = push_line(in, rate * dt, s, x);
  double taken = 0;  // share
  int cell = -1;
  switch (in.tip.where) {
    case TipPlace::coronary:
      cell = in.tip.cell;
      taken = std::min(1.0, std::max(0.0, now.state.flow_m3_s[cell]) / rate);
      break;
    case TipPlace::left_sinus:
    case TipPlace::right_sinus:
      cell = root(in.tip.where == TipPlace::right_sinus);
      if (cell < 0) break;
      taken = std::min(std::clamp(in.tip.into_ostium, 0.0, 1.0), std::max(0.0, now.state.flow_m3_s[cell]) / rate);
      break;
    case TipPlace::aorta:
      s.aorta_kg[in.tip.cell] += kg;
      return;
    case TipPlace::outside:
      s.carried_kg += kg;
      return;
  }
  report.selective = taken;
  // The injected volume replaces blood from upstream: less flows from the ostium to the tip.
  if (cell >= 0) x.entering[n() + cell] = taken * kg;
  int top = cell;
  for (int c = cell; c >= 0; c = now.flow.tree.cells[c].upstream) x.entering[c] = taken * rate * dt, top = c;
  // The rest goes into the root.
  const int side = in.tip.where == TipPlace::right_sinus || (top >= 0 && top == root(1)) ? 1 : 0;
  s.sinus_kg[side] += (1 - taken) * kg;
}

void ContrastStep::aspirate() {
  report.drawn_m3_s = drawn_m3_s(in.aspiration_m3_s, in.line, in.shaft_m);
  const double wanted = report.drawn_m3_s * dt;
  double there = 0, *from = nullptr;
  switch (in.tip.where) {
    case TipPlace::coronary: {
      // From all sheaths alike.
      double all = 0;
      for (int k = 0; k < layers; ++k) all += s.sheath_kg[k * n() + in.tip.cell];
      const double kg = draw_line(wanted, in.line.dead_m3, all / std::max(volume(in.tip.cell), wanted), s, x);
      for (int k = 0; k < layers && all > 0; ++k) s.sheath_kg[k * n() + in.tip.cell] *= 1 - kg / all;
      return;
    }
    case TipPlace::left_sinus:
    case TipPlace::right_sinus:
      from = &s.sinus_kg[in.tip.where == TipPlace::right_sinus];
      there = *from / model.sinus_m3;
      break;
    case TipPlace::aorta:
      from = &s.aorta_kg[in.tip.cell];
      there = aorta_concentration(model, s, in.tip.cell);
      break;
    case TipPlace::outside:
      break;
  }
  const double kg = draw_line(wanted, in.line.dead_m3, there, s, x);
  if (from) *from -= kg;
}

}  // namespace ostium::vascular
