#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

namespace {

using Eigen::VectorXd;
using units::mm, units::mL;

constexpr double mm3 = mm * mm * mm;
constexpr double near_peak = 0.8;  // of the density of undiluted contrast: beyond it only a linear detector is trusted

const JsonObjectKeys set_keys = {
    "density_set",
    curves::with_common_keys(
        "density", {{"artery", true, "its lumen, an object", json_type::object("density_artery")},
                    {"sites_mm", true, "from the ostium along the artery, rising, one or more, in mm, >= 0",
                     json_type::list_of(json_type::number(from_zero), 1)},
                    {"beats_per_min", true, "the heart's rate in 1/min, > 0", json_type::number(above_zero)},
                    {"flow_shape", true, "flow over a beat, an object", json_type::object("density_flow_shape")},
                    {"detector", true, "an object", json_type::object("density_detector")},
                    {"dispersion_mm3", true,
                     "half the variance of volume by which contrast spreads, over the volume passed, in mm3",
                     json_type::number(from_zero)},
                    {"noise_sigma_mm", true, "noise of a density in mm, > 0, or null if it is unknown",
                     json_type::null_or(json_type::number(above_zero))},
                    {"free", false, "\"flow of each injection\", in a list",
                     json_type::list_of(json_type::constant("flow of each injection"))},
                    {"runs", true, curves::one_or_more, json_type::list_of(json_type::object("density_run"), 1)}})};

const JsonObjectKeys artery_keys = {"density_artery",
                                    {{"from_ostium_mm", true, "places along it in mm, rising from 0, two or more",
                                      json_type::list_of(json_type::number(from_zero), 2)},
                                     {"diameter_mm", true, "of the lumen in mm, > 0 and at most 100, one a place",
                                      json_type::list_of(json_type::number(above_zero_to(100)), 2)}}};

const JsonObjectKeys shape_keys = {
    "density_flow_shape",
    {{"phase", true, "of the beat, rising from 0 to 1", json_type::list_of(json_type::number(from_to(0, 1)), 3)},
     {"relative", true, "flow there against its mean, > 0, one a phase",
      json_type::list_of(json_type::number(above_zero), 3)}}};

const JsonObjectKeys detector_keys = {
    "density_detector",
    {{"mm2_per_mg", true, "density over iodine per area in mm2/mg, > 0", json_type::number(above_zero)},
     {"linear", true, "whether density follows iodine up to the highest", json_type::boolean()}}};

const JsonObjectKeys injection_keys = {
    "density_injection",
    {{"rate_mL_s", true, "in mL/s, > 0", json_type::number(above_zero)},
     {"start_s", true, "when it begins in s", json_type::number()},
     {"length_s", true, "how long it lasts in s, > 0", json_type::number(above_zero)},
     {"ramp_s", true, "over which its rate rises, and falls, in s, >= 0", json_type::number(from_zero)},
     {"iodine_mg_mL", true, "of the contrast in mg/mL, > 0", json_type::number(above_zero)}}};

const JsonObjectKeys run_keys = curves::run_keys(
    "density_run",
    {{"injection", true, "an object", json_type::object("density_injection")},
     {"flow_guess_mL_s", true, "mean flow as far as it is known in mL/s, > 0", json_type::number(above_zero)},
     {"phase_s", true, "into the beat at time 0 in s, >= 0", json_type::number(from_zero)},
     {"frames_per_s", true, "of the film in 1/s, > 0", json_type::number(above_zero)}},
    {{"time_s", true, "of each frame in s, rising", json_type::list_of(json_type::number(), 8)},
     {"density_mm", true, "a list for each site, with a density in mm for each frame",
      json_type::list_of(json_type::list_of(json_type::number(), 8), 1)}});

void read_beat(const JsonObject& root, Setup& setup) {
  const JsonObject shape(root["flow_shape"], shape_keys);
  const VectorXd phase = curves::read_samples(shape, "phase", 3),
                 relative = curves::read_samples_like(shape, "relative", phase, "phase");
  curves::must_rise(shape, "phase", phase);
  if (phase[0] != 0 || phase.tail<1>()[0] != 1) shape.refuse("phase");
  if (!(relative.minCoeff() > 0)) shape.refuse("relative");
  setup.sampled = {
      60 / root.positive("beats_per_min"), {phase.begin(), phase.end()}, {relative.begin(), relative.end()}};
  setup.steps = steps_of(setup.sampled);
}

void read_artery(const JsonObject& root, Setup& setup) {
  const JsonObject artery(root["artery"], artery_keys);
  setup.place_m = curves::read_samples(artery, "from_ostium_mm", 2) * mm;
  setup.diameter_m = curves::read_samples_like(artery, "diameter_mm", setup.place_m, "from_ostium_mm") * mm;
  curves::must_rise(artery, "from_ostium_mm", setup.place_m / mm);
  if (setup.place_m[0] != 0) artery.refuse("from_ostium_mm");
  if (!(setup.diameter_m.minCoeff() > 0 && setup.diameter_m.maxCoeff() <= 100 * mm)) artery.refuse("diameter_mm");
  setup.site_m = curves::read_samples(root, "sites_mm", 1) * mm;
  curves::must_rise(root, "sites_mm", setup.site_m / mm);
  for (Eigen::Index k = 0; k < setup.site_m.size(); ++k)
    if (setup.site_m[k] < 0 || setup.site_m[k] > setup.place_m.tail<1>()[0])
      root.list("sites_mm")[static_cast<std::size_t>(k)].refuse(
          fmt::format("a place on the artery, from 0 to {:g} mm", setup.place_m.tail<1>()[0] / mm));
}

Injection read_injection(const JsonValue& value) {
  const JsonObject entry(value, injection_keys);
  Injection out;
  out.rate_m3_s = entry.positive("rate_mL_s") * mL, out.iodine_kg_m3 = entry.positive("iodine_mg_mL");
  out.start_s = entry.number("start_s"), out.length_s = entry.positive("length_s");
  out.ramp_s = entry.not_negative("ramp_s");
  if (out.ramp_s > out.length_s / 2)
    entry["ramp_s"].refuse(fmt::format("at most half the length, {:g} s", out.length_s / 2));
  return out;
}

VectorXd read_times(const JsonObject& entry) {
  const VectorXd time = curves::read_samples(entry, "time_s", 8);
  curves::must_rise(entry, "time_s", time);
  const double rate = entry.positive("frames_per_s"),
               seen = static_cast<double>(time.size() - 1) / (time.tail<1>()[0] - time[0]);
  if (seen < rate / 3 || seen > rate * 3)
    entry["frames_per_s"].refuse(fmt::format(
        "a rate like that of time_s, which has {:.3g} frames a second; are its times in another unit?", seen));
  return time;
}

/// How densities are seen.
struct View {
  std::optional<double> noise_mm;
  bool linear = true;
};

curves::Channel read_site(const JsonObject& entry, std::size_t s, const Setup& setup, const Film& film,
                          const View& view) {
  const auto k = static_cast<Eigen::Index>(s);
  const double at = setup.site_m[k] / mm;
  curves::Channel out{fmt::format("density_mm[{}]", s), fmt::format("density at {:g} mm", at), "mm", {}, {}};
  const JsonValue& list = entry.list("density_mm")[s];
  if (list.type != JsonValue::Type::array) list.refuse("a list of densities");
  if (static_cast<Eigen::Index>(list.items.size()) != film.time_s.size())
    list.fail(fmt::format("{} has {} numbers; expected {}, as time_s has", list.path(), list.items.size(),
                          film.time_s.size()));
  out.measured.resize(film.time_s.size());
  for (std::size_t i = 0; i < list.items.size(); ++i)
    out.measured[static_cast<Eigen::Index>(i)] = curves::sample(list.items[i]);
  const double most = near_peak * setup.m2_per_kg * film.injection.iodine_kg_m3 * area_m2(setup, setup.site_m[k]) / mm;
  for (std::size_t i = 0; i < list.items.size() && !view.linear; ++i)
    if (list.items[i].number > most)
      list.items[i].refuse(fmt::format(
          "at most {:.3g}, {:g} % of undiluted contrast, as the detector is not linear; leave frames near the peak out",
          most, 100 * near_peak));
  if (view.noise_mm) out.sigma = VectorXd::Constant(film.time_s.size(), *view.noise_mm);
  return out;
}

curves::Run read_run(const JsonValue& value, const View& view, Setup& setup, const std::vector<curves::Run>& others) {
  const JsonObject entry(value, run_keys);
  curves::Run run = curves::begin_run(entry, others);
  Film film;
  film.injection = read_injection(entry["injection"]);
  film.flow_m3_s = entry.positive("flow_guess_mL_s") * mL, film.phase_s = entry.not_negative("phase_s");
  film.time_s = read_times(entry);
  const auto sites = static_cast<std::size_t>(setup.site_m.size());
  if (curves::samples(entry, "density_mm").items.size() != sites)
    entry["density_mm"].fail(fmt::format("{} has {} lists; expected {}, one for each of sites_mm",
                                         entry["density_mm"].path(), entry.list("density_mm").size(), sites));
  for (std::size_t s = 0; s < sites; ++s) run.channels.push_back(read_site(entry, s, setup, film, view));
  run.along = film.time_s, run.along_label = "time", run.along_unit = "s";
  setup.films.push_back(film);
  return run;
}

void set_free(std::span<const double> free, Setup& setup) {
  const std::size_t films = setup.films.size();
  for (std::size_t i = 0; i < films; ++i) setup.films[i].flow_m3_s = free[i] * mL;
  for (std::size_t i = 0; i < setup.steps.size(); ++i) setup.steps[i].at_phase = free[films + i];
}

std::vector<EffectParameter> free_numbers(const Setup& setup, const std::vector<curves::Run>& runs) {
  std::vector<EffectParameter> out;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const double guess = setup.films[i].flow_m3_s / mL;
    out.push_back({fmt::format("flow_mL_s[{}]", runs[i].id), "mL/s", "mean flow of " + runs[i].id, guess, 0.7,
                   guess / 20, guess * 20, true});
  }
  for (std::size_t i = 0; i < setup.steps.size(); ++i) {
    const Step& step = setup.steps[i];
    const double from = setup.sampled.phase[step.after], to = setup.sampled.phase[step.after + 1];
    out.push_back({fmt::format("step_phase[{}]", i), "1", "phase at which the flow steps", step.at_phase,
                   (to - from) / std::sqrt(12.0), from, to, false});
  }
  return out;
}

std::unique_ptr<curves::Set> read(const JsonValue& file) {
  const JsonObject root(file, set_keys), detector(root["detector"], detector_keys);
  Setup setup;
  read_artery(root, setup);
  read_beat(root, setup);
  setup.m2_per_kg = detector.positive("mm2_per_mg");
  setup.dispersion_m3 = root.not_negative("dispersion_mm3") * mm3;
  View view{{}, detector.boolean("linear")};
  view.noise_mm = root.number_or_null("noise_sigma_mm");
  std::vector<curves::Run> runs;
  for (const JsonValue& value : root.list("runs")) runs.push_back(read_run(value, view, setup, runs));
  if (runs.empty()) root.refuse("runs");
  const std::vector<EffectParameter> free = free_numbers(setup, runs);
  auto set = std::make_unique<curves::SetOf<Setup>>(
      setup, runs, free, set_free, densities,
      std::vector<Effect>{collateral_inflow(), side_branch(), reflux(), concentration(), constant_glare(),
                          glare_of_neighbours(), narrowing(), frame_rate(), late_film(), late_injection(),
                          contrast_hyperaemia(), foreshortening(), foreshortened_stretch()});
  set->hold_out_channels = true;
  curves::declare(root, *set);
  return set;
}

}  // namespace

void along_the_sites(const Setup& declared, std::vector<EffectParameter>& parameters) {
  const double last = declared.site_m.tail<1>()[0] / mm;
  parameters[0].prior = last / 2, parameters[0].spread = last / 2, parameters[0].most = last;
}

curves::Kind kind() {
  return {"density",
          "iodine per length at sites along an artery, over the time of an injection",
          read,
          {&set_keys, &artery_keys, &shape_keys, &detector_keys, &injection_keys, &run_keys, &curves::effect_keys}};
}

}  // namespace ostium::data::density
