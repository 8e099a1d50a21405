#include "app/session/scene/film.h"

#include "fluoro/display/overlay.h"

namespace ostium::app {

namespace {

/// The blood as it is, or with a tree full of contrast, whatever was injected.
vascular::PhysiologyState blood_to_show(const SessionModel& model, const SessionState& state, Fill fill) {
  vascular::PhysiologyState blood = state.blood;
  if (fill != Fill::none)
    fill_tree(model.physiology.contrast, model.physiology.flow, fill == Fill::right, undiluted_kg_m3, blood.radius_m,
              occupied_m(model, state), blood.contrast);
  return blood;
}

}  // namespace

struct Film::Parts {
  explicit Parts(const FilmOptions& o)
      : options(o), settings{fluoro::to_field, o.frames_per_s, false}, imager({}, fluoro::make_renderer(o.renderer)) {}
  FilmOptions options;
  FilmSettings settings;
  std::unique_ptr<PatientScene> patient;        ///< with the session's blood and contrast,
  std::unique_ptr<const XrayPatient> no_blood;  ///< or without any,
  fluoro::Scene mesh;                           ///< or a mesh
  fluoro::Imager imager;
  fluoro::FluoroscopeState state;
  fluoro::DisplayScratch scratch;
  fluoro::FrameReport report;
  fluoro::View view;
  fluoro::Picture picture;
  Monitor monitor;
  std::optional<RunningDose> running_dose;
  fluoro::DoseMeter dose;
  bool is_cine = false;

  fluoro::Programme programme() const {
    return is_cine ? fluoro::cine(settings.frames_per_s) : fluoro::fluoroscopy(settings.frames_per_s);
  }
};

Film::Film(const SessionModel& model, const FilmOptions& options, const PatientScene* same)
    : parts_(std::make_unique<Parts>(options)) {
  fluoro::require_rate(options.frames_per_s);
  if (model.has_patient())
    parts_->patient =
        same && same->breathes() == (model.breaths_1_min > 0)
            ? std::make_unique<PatientScene>(*same, model.physiology)
            : std::make_unique<PatientScene>(*model.vessel->patient, model.physiology, model.breaths_1_min > 0);
  else if (model.vessel->patient)
    parts_->no_blood =
        std::make_unique<const XrayPatient>(model.vessel->patient, options.fill, model.breaths_1_min > 0);
  else
    parts_->mesh = scene_of_mesh(*model.vessel);
  if (!options.overlay) return;
  const SessionState first = make_state(model, 0);
  parts_->running_dose.emplace(parts_->patient    ? parts_->patient->at(first.blood, occupied_m(model, first))
                               : parts_->no_blood ? parts_->no_blood->at(0)
                                                  : parts_->mesh);
}

Film::~Film() = default;

const fluoro::Picture& Film::frame(const SessionModel& model, const SessionState& state, const SessionInputs& inputs,
                                   const XrayUse& xrays) {
  Parts& p = *parts_;
  const FilmOptions& o = p.options;
  fluoro::Scene other;
  if (p.patient)
    p.patient->at(blood_to_show(model, state, o.fill), occupied_m(model, state), breath(model, state),
                  state.wall_aside_P);
  else
    other = p.no_blood ? p.no_blood->at(state.blood.heart.phase, breath(model, state)) : p.mesh;
  fluoro::Scene& scene = p.patient ? p.patient->scene() : other;
  scene.shafts = shafts_of(model, state);
  if (model.has_patient()) add_treatment(model, state, scene);
  const CArmInputs& arm = inputs.c_arm;
  p.view = view(inputs);
  const bool on = o.always_on || arm.beam();
  p.is_cine = o.mode ? *o.mode == fluoro::Mode::cine : arm.cine;
  const fluoro::FluoroscopeInput in{.scene = scene,
                                    .view = p.view,
                                    .collimator = p.settings.shutters,
                                    .pedals = {.fluoroscopy = on && !p.is_cine, .cine = on && p.is_cine},
                                    .fluoroscopy_per_s = p.settings.frames_per_s,
                                    .cine_per_s = p.settings.frames_per_s,
                                    .beat_phase = state.blood.heart.phase,
                                    .show_roadmap = p.settings.roadmap,
                                    .seed = o.seed};
  const fluoro::TickReport report = tick(p.imager, in, p.state, p.scratch);
  if (report.xray_on) p.report = report.frame;
  if (!p.state.runs.empty()) p.state.runs.back().frames.clear();  // callers keep the frames they want
  p.picture = p.state.live;
  if (p.picture.grey.empty()) {
    p.picture.width = p.picture.height = o.pixels;
    p.picture.grey.assign(static_cast<std::size_t>(o.pixels) * o.pixels, 0);
  }
  if (p.running_dose) {
    p.dose = p.running_dose->of(xrays, state.c_arm);
    draw_overlay({p.view, p.programme(), p.report.exposure, p.dose, report.xray_on, "", model.vessel->name}, p.picture);
  }
  if (o.monitor && p.patient)
    append_strips({p.monitor.II, p.monitor.V2, p.monitor.guide, p.monitor.gauge}, monitor_s, monitor_pixels, p.picture);
  return p.picture;
}

fluoro::View Film::view(const SessionInputs& inputs) const {
  const FilmOptions& o = parts_->options;
  const CArmInputs& arm = inputs.c_arm;
  fluoro::View view = parts_->view;
  view.arm.lao_rad = o.lao_rad.value_or(arm.lao_rad), view.arm.cran_rad = o.cran_rad.value_or(arm.cran_rad);
  view.arm.p_PI = o.p_PI.value_or(arm.p_PI);
  view.field_m = o.field_m.value_or(arm.field_m);
  view.pixels = o.pixels;
  return view;
}

void Film::restart(std::uint64_t seed) {
  parts_->options.seed = seed;
  parts_->state = {};
}

void Film::set(const FilmSettings& settings) { parts_->settings = settings; }

void Film::listen(const SessionModel& model, const SessionState& state, const SessionInputs& inputs) {
  if (parts_->options.monitor) parts_->monitor.listen(model, state, inputs);
}

Monitor& Film::monitor() { return parts_->monitor; }

int Film::height() const {
  return parts_->options.pixels + (parts_->options.monitor && parts_->patient ? monitor_pixels : 0);
}

fluoro::CineRun Film::run() const { return {parts_->view, parts_->programme(), parts_->report.exposure, {}}; }
const fluoro::DoseMeter& Film::dose() const { return parts_->dose; }

}  // namespace ostium::app
