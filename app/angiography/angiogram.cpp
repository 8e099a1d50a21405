#include "app/angiography/angiogram.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

using units::mL;

constexpr double step_s = 1e-3;
constexpr double seen = 0.15, filled = 0.5;  // relative to the darkness of a full vessel

}  // namespace

fluoro::View view_of(const fluoro::StandardView& named, const vascular::Patient& patient, bool left, int pixels) {
  using units::degree;
  fluoro::View view;
  view.arm.lao_rad = degree * named.lao_deg, view.arm.cran_rad = degree * named.cran_deg;
  view.pixels = pixels;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(1e9), high = -low;
  for (const vascular::TreeBranch& b : patient.tree.branches) {
    const bool of_left = b.name == "LM" || b.name == "LAD" || b.name == "LCx" || b.name[0] == 'D' || b.name[0] == 'O';
    const bool of_right = b.name == "RCA" || b.name == "PDA" || b.name == "PLV" || b.name == "RV";
    if (left ? of_left : of_right)
      for (const vascular::TreeSphere& s : b.spheres) low = low.cwiseMin(s.p), high = high.cwiseMax(s.p);
  }
  view.arm.p_PI = (low + high) / 2;
  return view;
}

Injection usual_injection(const vascular::FlowTree& tree, bool left) {
  Injection injection;
  injection.tip.where = vascular::TipPlace::coronary;
  injection.tip.cell = tree.branches[tree.branch(left ? "LM" : "RCA")].first;
  injection.rate_m3_s = (left ? 2.1 : 1.7) * mL, injection.volume_m3 = (left ? 7.1 : 4.8) * mL;
  return injection;
}

Angiogram::Angiogram(const vascular::PhysiologyModel& model, PatientScene& scene, const fluoro::View& view,
                     double frames_per_s, std::uint64_t seed, fluoro::Renderer renderer)
    : model_(model),
      scene_(scene),
      view_(view),
      frames_per_s_(frames_per_s),
      seed_(seed),
      imager_({}, fluoro::make_renderer(renderer)),
      mask_imager_({}, fluoro::make_renderer(renderer)) {}

void Angiogram::wait_for(double phase, double rate_1_min, vascular::PhysiologyState& state) {
  vascular::PhysiologyInputs inputs;
  inputs.heart.rate_1_min = rate_1_min;
  for (int n = 0; n < 4000; ++n) {
    const double before = state.heart.phase;
    step(model_, inputs, step_s, state, scratch_);
    const double after = state.heart.phase;
    if (before <= after ? before < phase && phase <= after : phase > before || phase <= after) return;
  }
}

void Angiogram::advance(const std::optional<Injection>& injection, vascular::PhysiologyInputs inputs,
                        vascular::PhysiologyState& state) {
  const long due = std::lround(1000.0 * static_cast<double>(frame_++) / frames_per_s_);
  if (step_ == 0 && injection)
    std::fill(state.contrast.line_kg.begin(), state.contrast.line_kg.end(),
              injection->iodine_kg_m3 * inputs.contrast.line.dead_m3 / vascular::line_cells);
  for (; step_ < due; ++step_) {
    if (injection) {
      inputs.contrast.tip = injection->tip, inputs.contrast.iodine_kg_m3 = injection->iodine_kg_m3;
      const bool more = static_cast<double>(step_) * step_s * injection->rate_m3_s < injection->volume_m3;
      inputs.contrast.injection_m3_s = more ? injection->rate_m3_s : 0;
    }
    step(model_, inputs, step_s, state, scratch_);
  }
  scene_.at(state, inputs.occupied_m);
}

const fluoro::Picture& Angiogram::frame(const std::optional<Injection>& injection,
                                        const vascular::PhysiologyInputs& inputs, vascular::PhysiologyState& state) {
  advance(injection, inputs, state);
  return take(state.heart.phase);
}

const fluoro::Picture& Angiogram::take(double phase) {
  const fluoro::FluoroscopeInput in{.scene = scene_.scene(),
                                    .view = view_,
                                    .collimator = fluoro::to_field,
                                    .pedals = {.fluoroscopy = false, .cine = true},
                                    .cine_per_s = frames_per_s_,
                                    .beat_phase = phase,
                                    .seed = seed_};
  report_ = tick(imager_, in, fluoroscope_, display_);
  return fluoroscope_.live;
}

void Angiogram::draw(fluoro::Imager& imager, fluoro::ImagerState& into) {
  fluoro::Programme programme = fluoro::cine(frames_per_s_);
  programme.lag = 0;
  imager.frame({scene_.scene(), view_, {}, programme, seed_ + 1}, into);
}

std::vector<double> Angiogram::read(const fluoro::Plane& with, const fluoro::Plane& without,
                                    const std::vector<int>& cells, const vascular::PhysiologyState& state) const {
  // Automatic brightness reacts to contrast, so the picture's median change is not due to iodine.
  std::vector<float> change;
  for (int r = 8; r < view_.pixels; r += 16)
    for (int c = 8; c < view_.pixels; c += 16)
      if (with(r, c) > 0 && without(r, c) > 0) change.push_back(std::log(without(r, c) / with(r, c)));
  std::nth_element(change.begin(), change.begin() + static_cast<std::ptrdiff_t>(change.size() / 2), change.end());
  const double offset = change.empty() ? 0 : double(change[change.size() / 2]);
  std::vector<double> out;
  const double pixel = view_.field_m / view_.pixels;
  for (int cell : cells) {
    const Eigen::Vector3d p = scene_.map().coronary.position(static_cast<std::size_t>(cell), state.heart.phase);
    const auto at = project(view_.arm, p);
    double sum_with = 0, sum_without = 0;
    if (at) {
      const double magnified = view_.arm.source_to_detector_m / view_.arm.source_to_isocentre_m;
      const double reach = std::max(1.0, 0.5 * magnified * state.radius_m[cell] / pixel);
      const double column = at->x() / pixel + view_.pixels / 2.0 - 0.5,
                   row = view_.pixels / 2.0 - at->y() / pixel - 0.5;
      for (int r = static_cast<int>(row - reach); r <= static_cast<int>(row + reach) + 1; ++r)
        for (int c = static_cast<int>(column - reach); c <= static_cast<int>(column + reach) + 1; ++c) {
          if (r < 0 || c < 0 || r >= view_.pixels || c >= view_.pixels) continue;
          if (std::hypot(r - row, c - column) > reach) continue;
          sum_with += double(with(r, c)), sum_without += double(without(r, c));
        }
    }
    out.push_back(sum_with > 0 && sum_without > 0 ? std::log(sum_without / sum_with) - offset : 0);
  }
  return out;
}

std::vector<double> Angiogram::darkness(const std::vector<int>& cells, const vascular::PhysiologyState& state) {
  fluoro::ImagerState with;
  draw(imager_, with);
  // The bodies stay where they are; only the iodine is removed.
  fluoro::Body* const lumen = scene_.lumen();
  const fluoro::Contrast kept = lumen ? lumen->contrast : fluoro::Contrast{};
  if (lumen) lumen->contrast.iodine_kg_m3.setZero(), lumen->contrast.along_kg_m2.setZero();
  mask_ = {};
  draw(mask_imager_, mask_);
  if (lumen) lumen->contrast = kept;
  return read(with.lag.shown, mask_.lag.shown, cells, state);
}

std::vector<double> Angiogram::darkness_full(const std::vector<int>& cells, double iodine_kg_m3,
                                             const vascular::PhysiologyState& state) {
  vascular::PhysiologyState full = state;
  const std::size_t n = model_.flow.tree.cells.size();
  for (std::size_t c = 0; c < n; ++c)
    for (int k = 0; k < vascular::layers; ++k)
      full.contrast.sheath_kg[k * n + c] = iodine_kg_m3 * model_.contrast.share[k] *
                                           model_.flow.tree.cells[c].length_m *
                                           vascular::free_area_m2(full.radius_m[c], 0);
  scene_.at(full, {});
  return darkness(cells, full);
}

int timi_landmark(const vascular::FlowTree& tree, const std::string& artery) {
  const auto from_ostium = [&](int cell) {
    double length = 0;
    for (int c : tree.path_to(cell)) length += tree.cells[c].length_m;
    return length;
  };
  if (artery == "LAD") {
    // The last stretch of the LAD goes round the apex.
    const int b = tree.branch("LAD");
    return b < 0 ? -1 : tree.cell_at(b, tree.cells[tree.branches[b].last - 1].s_m - 21.5e-3);
  }
  if (artery == "RCA") {
    const int b = tree.branch("PLV2");
    return b >= 0                   ? tree.branches[b].parent_cell
           : tree.branch("RCA") < 0 ? -1
                                    : tree.branches[tree.branch("RCA")].last - 1;
  }
  constexpr double gibson_m = 93e-3;
  int end = -1;
  for (const vascular::FlowBranch& b : tree.branches)
    if (b.territory == vascular::Territory::lcx && (end < 0 || from_ostium(b.last - 1) > from_ostium(end)))
      end = b.last - 1;
  while (end >= 0 && from_ostium(end) > gibson_m) end = tree.cells[end].upstream;
  return end;
}

TimiCount timi_count(const vascular::PhysiologyModel& model, PatientScene& scene, const vascular::Patient& patient,
                     const std::string& artery, const vascular::PhysiologyState& at_rest, double rate_1_min,
                     double start_phase, double longest_s) {
  const vascular::FlowTree& tree = model.flow.tree;
  const bool left = artery != "RCA";
  const int end = timi_landmark(tree, artery);
  if (end < 0) return {};
  vascular::PhysiologyState state = at_rest;
  const auto named = fluoro::find_view(artery == "LAD" ? "rao-cranial" : left ? "rao-caudal" : "lao");
  const fluoro::View view = view_of(*named, patient, left, 512);
  Angiogram angiogram(model, scene, view, 30);
  angiogram.wait_for(start_phase, rate_1_min, state);
  const Injection injection = usual_injection(tree, left);
  const std::vector<int> cells = {injection.tip.cell + 2, end};
  const std::vector<double> full = angiogram.darkness_full(cells, injection.iodine_kg_m3, state);
  vascular::PhysiologyInputs inputs;
  inputs.heart.rate_1_min = rate_1_min;
  double begun = -1;
  std::vector<double> before(2, 0);
  for (int n = 0; n < 30 * longest_s; ++n) {
    angiogram.advance(injection, inputs, state);
    const std::vector<double> dark = angiogram.darkness(cells, state);
    // Interpolates the crossing between frames, so that counts are not limited to whole frames.
    const auto crossing = [&](int k, double level) {
      const double x = dark[k] / full[k], x0 = before[k];
      return n - 1 + std::clamp((level - x0) / std::max(x - x0, 1e-9), 0.0, 1.0);
    };
    if (begun < 0 && dark[0] > filled * full[0]) begun = crossing(0, filled);
    if (begun >= 0 && dark[1] > seen * full[1]) return {crossing(1, seen) - begun, true};
    for (int k = 0; k < 2; ++k) before[k] = dark[k] / full[k];
  }
  return {30 * longest_s, false};
}

}  // namespace ostium::app
