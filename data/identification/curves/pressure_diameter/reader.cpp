#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "data/identification/curves/pressure_diameter/pressure_diameter.h"

namespace ostium::data::pressure_diameter {

namespace {

using Eigen::VectorXd;
using units::atm, units::mm;

const JsonObjectKeys set_keys = {
    "inflation_set",
    curves::with_common_keys(
        "pressure_diameter",
        {{"instrument", true, "the balloon, an object", json_type::object("inflation_balloon")},
         {"vessels", false, "that runs are in, a list", json_type::list_of(json_type::object("inflation_vessel"))},
         {"places_mm", false, "where diameters are measured, along the balloon from its middle, rising, two or more",
          json_type::list_of(json_type::number(), 2)},
         {"noise", true, "an object", json_type::object("inflation_noise")},
         {"runs", true, curves::one_or_more, json_type::list_of(json_type::object("inflation_run"), 1)}})};

const JsonObjectKeys balloon_keys = {
    "inflation_balloon",
    {{"name", true, "a text", json_type::text()},
     {"nominal_mm", true, "its nominal diameter in mm, > 0", json_type::number(above_zero)},
     {"chart", true, "an object", json_type::object("inflation_chart")}}};

const JsonObjectKeys chart_keys = {
    "inflation_chart",
    {{"pressure_atm", true, "rising, four or more, in atm", json_type::list_of(json_type::number(from_zero), 4)},
     {"diameter_mm", true, "rising, one a pressure, in mm", json_type::list_of(json_type::number(above_zero), 4)}}};

const JsonObjectKeys vessel_keys = {
    "inflation_vessel",
    {{"name", true, "a text other than \"free\"", json_type::text()},
     {"rest_mm", true, "diameter at rest in mm, > 0", json_type::number(above_zero)},
     {"healthy_mm", true, "diameter beyond which media and adventitia resist, in mm, > 0",
      json_type::number(above_zero)},
     {"stiffness_atm", true,
      "pressure over widening against healthy_mm in atm, > 0: 1.5 of a healthy artery, 32 with soft plaque, 75 with "
      "calcified",
      json_type::number(above_zero)},
     {"media_atm", false, "of the law beyond healthy_mm in atm, >= 0 (0.05 if it is not given)",
      json_type::number(from_zero)},
     {"media_k", false, "its exponent, > 0 (5 if it is not given)", json_type::number(above_zero)}}};

const JsonObjectKeys noise_keys = {"inflation_noise",
                                   {{"pressure_atm", true, "of the pressure in atm, >= 0, or null if it is unknown",
                                     json_type::null_or(json_type::number(from_zero))},
                                    {"diameter_mm", true, "of the diameter in mm, > 0, or null if it is unknown",
                                     json_type::null_or(json_type::number(above_zero))}}};

const JsonObjectKeys run_keys = curves::run_keys(
    "inflation_run",
    {{"in", true, "\"free\", or the name of a vessel", json_type::text()},
     {"stented", false, "whether a stent is around the balloon (false if it is not given)", json_type::boolean()}},
    {{"time_s", true, "since the run began in s, rising, one a sample", json_type::list_of(json_type::number(), 6)},
     {"pressure_atm", true, "in the balloon in atm, one a sample", json_type::list_of(json_type::number(), 6)},
     {"diameter_mm", true, "of the balloon in mm, one a sample; with places_mm a list of them for each place",
      json_type::either({json_type::list_of(json_type::number(), 6),
                         json_type::list_of(json_type::list_of(json_type::number(), 6), 2)})}});

constexpr double beyond_chart = 0.25;  // of its range: how far from it a sample may lie

void read_balloon(const JsonValue& value, Setup& setup) {
  const JsonObject entry(value, balloon_keys), chart(entry["chart"], chart_keys);
  const VectorXd p = curves::read_samples(chart, "pressure_atm"),
                 d = curves::read_samples_like(chart, "diameter_mm", p, "pressure_atm");
  curves::must_rise(chart, "pressure_atm", p), curves::must_rise(chart, "diameter_mm", d);
  if (p[0] < 0) chart.refuse("pressure_atm");
  const double nominal = entry.positive("nominal_mm");
  if (!(nominal > 0.7 * d[0] && nominal < 1.3 * d.tail<1>()[0]))
    entry["nominal_mm"].refuse(
        fmt::format("a diameter like those of the chart, from {:g} to {:g}", d[0], d.tail<1>()[0]));
  const VectorXd Pa = p * atm, m = d * mm;
  setup.chart = Chart({Pa.begin(), Pa.end()}, {m.begin(), m.end()});
}

Vessel read_vessel(const JsonValue& value, const std::vector<Vessel>& others) {
  const JsonObject entry(value, vessel_keys);
  Vessel out;
  out.name = entry.text("name");
  if (out.name == "free" ||
      std::any_of(others.begin(), others.end(), [&](const Vessel& o) { return o.name == out.name; }))
    entry["name"].refuse("a name that no other vessel has, and not \"free\"");
  out.rest_m = entry.positive("rest_mm") * mm, out.healthy_m = entry.positive("healthy_mm") * mm;
  out.stiffness_Pa = entry.positive("stiffness_atm") * atm;
  if (entry.has("media_atm")) out.media_Pa = entry.not_negative("media_atm") * atm;
  if (entry.has("media_k")) out.media_k = entry.positive("media_k");
  return out;
}

VectorXd read_diameters(const JsonValue& list, const Inflation& run) {
  if (list.type != JsonValue::Type::array) list.refuse("a list of diameters");
  if (static_cast<Eigen::Index>(list.items.size()) != run.time_s.size())
    list.fail(fmt::format("{} has {} numbers; expected {}, as time_s has", list.path(), list.items.size(),
                          run.time_s.size()));
  VectorXd out(run.time_s.size());
  for (std::size_t k = 0; k < list.items.size(); ++k) {
    if (list.items[k].type != JsonValue::Type::number || !(list.items[k].number > 0))
      list.items[k].refuse("a diameter in mm, > 0");
    out[static_cast<Eigen::Index>(k)] = curves::sample(list.items[k]);
  }
  return out;
}

void check_pressures(const JsonObject& entry, const Setup& setup, const Inflation& run) {
  const double range = beyond_chart * (setup.chart.most_Pa() - setup.chart.least_Pa());
  const double least = run.stented ? -1 * atm : setup.chart.least_Pa() - range, most = setup.chart.most_Pa() + range;
  for (Eigen::Index k = 0; k < run.pressure_Pa.size(); ++k)
    if (run.pressure_Pa[k] < least || run.pressure_Pa[k] > most)
      entry.list("pressure_atm")[static_cast<std::size_t>(k)].refuse(
          fmt::format("from {:.3g} to {:.3g} atm, as the chart says nothing of others; leave the sample out",
                      least / atm, most / atm));
}

curves::Run read_run(const JsonValue& value, const JsonObject& noise, bool places, Setup& setup,
                     const std::vector<curves::Run>& others) {
  const JsonObject entry(value, run_keys);
  curves::Run run = curves::begin_run(entry, others);
  Inflation inflation;
  const std::string in = entry.text("in");
  for (std::size_t v = 0; v < setup.vessels.size(); ++v)
    if (setup.vessels[v].name == in) inflation.vessel = static_cast<int>(v);
  if (inflation.vessel < 0 && in != "free") entry["in"].refuse("\"free\", or the name of one of \"vessels\"");
  inflation.stented = entry.has("stented") && entry.boolean("stented");
  inflation.time_s = curves::read_samples(entry, "time_s", 6);
  curves::must_rise(entry, "time_s", inflation.time_s);
  const VectorXd pressure = curves::read_samples_like(entry, "pressure_atm", inflation.time_s, "time_s");
  inflation.pressure_Pa = pressure * atm;
  check_pressures(entry, setup, inflation);
  const auto diameter_mm = noise.number_or_null("diameter_mm"), pressure_atm = noise.number_or_null("pressure_atm");
  const std::vector<JsonValue>& lists = curves::samples(entry, "diameter_mm").items;
  if (places && lists.size() != setup.place_m.size())
    entry["diameter_mm"].refuse(fmt::format("{} lists, one for each of places_mm", setup.place_m.size()));
  for (std::size_t i = 0; i < setup.place_m.size(); ++i) {
    curves::Channel channel{"diameter_mm", "diameter", "mm", {}, {}};
    if (places) {
      channel.key = fmt::format("diameter_mm[{}]", i);
      channel.label = fmt::format("diameter at {:g} mm", setup.place_m[i] / mm);
    }
    channel.measured = read_diameters(places ? lists[i] : entry["diameter_mm"], inflation);
    if (diameter_mm && pressure_atm) {
      // Noise of the pressure is seen as one of the diameter, by the slope of the chart.
      channel.sigma.resize(pressure.size());
      for (Eigen::Index k = 0; k < pressure.size(); ++k)
        channel.sigma[k] =
            std::hypot(*diameter_mm, *pressure_atm * atm * setup.chart.slope(inflation.pressure_Pa[k]) / mm);
    }
    run.channels.push_back(channel);
  }
  run.along = pressure, run.along_label = "pressure", run.along_unit = "atm";
  setup.inflations.push_back(inflation);
  return run;
}

/// Whether a run is in the vessel: others have no number of their own.
bool used(const Setup& setup, std::size_t vessel) {
  return std::any_of(setup.inflations.begin(), setup.inflations.end(),
                     [&](const Inflation& run) { return run.vessel == static_cast<int>(vessel); });
}

void set_free(std::span<const double> free, Setup& setup) {
  setup.chart_scale *= free[0];
  for (std::size_t v = 0, k = 1; v < setup.vessels.size(); ++v)
    if (used(setup, v)) setup.vessels[v].stiffness_Pa *= free[k++];
}

std::vector<EffectParameter> free_numbers(const Setup& setup) {
  std::vector<EffectParameter> out = {
      {"chart_scale", "1", "diameters of the balloon against its chart", 1, 0.03, 0.8, 1.25, true}};
  for (std::size_t v = 0; v < setup.vessels.size(); ++v)
    if (used(setup, v))
      out.push_back({fmt::format("stiffness_scale[{}]", setup.vessels[v].name), "1",
                     "stiffness of " + setup.vessels[v].name + " against that declared", 1, 0.3, 0.05, 20, true});
  return out;
}

std::unique_ptr<curves::Set> read(const JsonValue& file) {
  const JsonObject root(file, set_keys), noise(root["noise"], noise_keys);
  Setup setup;
  read_balloon(root["instrument"], setup);
  if (root.has("vessels"))
    for (const JsonValue& value : root.list("vessels")) setup.vessels.push_back(read_vessel(value, setup.vessels));
  const bool places = root.has("places_mm");
  setup.place_m = {0};
  if (places) {
    const VectorXd at = curves::read_samples(root, "places_mm", 2);
    curves::must_rise(root, "places_mm", at);
    const VectorXd m = at * mm;
    setup.place_m = {m.begin(), m.end()};
  }
  std::vector<curves::Run> runs;
  for (const JsonValue& value : root.list("runs")) runs.push_back(read_run(value, noise, places, setup, runs));
  if (runs.empty()) root.refuse("runs");
  const std::vector<EffectParameter> free = free_numbers(setup);
  auto set = std::make_unique<curves::SetOf<Setup>>(
      setup, runs, free, set_free, diameters,
      std::vector<Effect>{counter_pressure(), recoil(), chart_offset(), taper(), gauge_offset(), creep()});
  curves::declare(root, *set);
  return set;
}

}  // namespace

curves::Kind kind() {
  return {"pressure_diameter",
          "diameter against pressure of a balloon, free, in a vessel or in a stent",
          read,
          {&set_keys, &balloon_keys, &chart_keys, &vessel_keys, &noise_keys, &run_keys, &curves::effect_keys}};
}

}  // namespace ostium::data::pressure_diameter
