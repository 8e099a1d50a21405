#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "data/formats/csv.h"
#include "data/identification/curves/curve_report.h"
#include "data/identification/report/law_report.h"

namespace ostium::data::curves {

namespace {

using Json = nlohmann::ordered_json;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json parameters(const Candidate& c) {
  Json out = Json::object();
  for (const Fitted& f : c.parameters)
    out[f.label] = {{"value", f.value}, {"sigma", f.sigma}, {"unit", f.parameter.unit}};
  return out;
}

/// In the unit of the first channel.
double rms_in_unit(const Candidate& c) {
  double sum = 0, count = 0;
  for (std::size_t r = 0; r < c.model.misfits.size(); ++r) {
    if (c.fault && !c.fault->chosen.empty() && !c.fault->chosen[r][0]) continue;
    const Eigen::VectorXd left = c.model.misfits[r][0].cwiseProduct(c.set->runs()[r].channels[0].sigma);
    sum += left.squaredNorm(), count += static_cast<double>(left.size());
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

Json model(const Candidate& c) {
  Json out = {{"parameters", parameters(c)},
              {"rms", {{"fit", rms_in_unit(c)}, {"held_out", nullptr}}},
              {"rms_over_noise", c.model.rms()},
              {"held_out_over_noise", or_null(c.model.held_out)},
              {"chi2_per_dof", c.model.per_freedom()}};
  // Held out is scored over noise; in the unit of the first channel it is that share of its residual.
  if (c.model.held_out && c.model.per_freedom() > 0)
    out["rms"]["held_out"] = rms_in_unit(c) * *c.model.held_out / std::sqrt(c.model.squares / c.model.measured);
  if (!c.laws.empty()) out["laws"] = json_of(c.laws);
  return out;
}

Json fault(const std::optional<Fault>& f) {
  if (!f) return nullptr;
  return {{"id", f->id}, {"experiments", f->runs}, {"what", f->what}, {"mend", f->mend}};
}

Json noise(const CurveExplanation& x) {
  Json channels = Json::array();
  bool heavy = false;
  for (std::size_t c = 0; c < x.noise.channels.size(); ++c) {
    const ChannelNoise& n = x.noise.channels[c];
    const Channel& channel = x.set->runs()[0].channels[c];
    heavy = heavy || n.heavy;
    channels.push_back({{"key", channel.key},
                        {"unit", channel.unit},
                        {"sigma", n.size * channel.sigma.mean()},
                        {"size_over_declared", x.noise.declared ? Json(n.size) : Json(nullptr)},
                        {"correlation_of_neighbours", n.correlation},
                        {"tail", n.heavy ? "heavy" : "normal"}});
  }
  const double sigma = channels[0]["sigma"];
  return {{"as_declared", x.noise.as_declared},
          {"declared", x.noise.declared},
          {"sigma", sigma},
          {"tail", heavy ? "heavy" : "normal"},
          {"channels", channels}};
}

}  // namespace

std::string to_json(const CurveExplanation& x) {
  Json out = {{"schema", "ostium-explanation/1"},
              {"kind", x.set->kind},
              {"verdict", to_string(x.verdict)},
              {"ended_early", x.ended_early}};
  const Channel& first = x.set->runs()[0].channels[0];
  out["declared"] = model(x.declared);
  out["declared"]["unit"] = first.unit;
  out["noise"] = noise(x);
  out["effects"] = x.found() ? Json(x.best().effects) : Json::array();
  out["candidates"] = Json::array();
  for (const Candidate& c : x.candidates) {
    Json entry = {{"name", c.name}, {"effects", c.effects}};
    entry.update(model(c));
    entry["share_removed"] = c.share_removed;
    entry["delta_bic"] = c.bic() - x.declared.bic();
    entry["only_noise_left"] = c.is_noise;
    entry["fault"] = fault(c.fault);
    out["candidates"].push_back(entry);
  }
  out["after"] = nullptr;
  if (x.found()) {
    out["after"] = model(x.best());
    out["after"]["share_removed"] = x.best().share_removed;
    out["after"]["fault"] = fault(x.best().fault);
  }
  out["remaining"] = nullptr;
  if (x.verdict == Verdict::mostly || x.verdict == Verdict::unexplained) {
    const Candidate& c = x.best();
    out["remaining"] = {{"rms_over_noise", c.model.rms()}, {"lasts_over_a_run", c.slow_shapes > 4}};
  }
  out["text"] = x.text;
  out["warnings"] = x.warnings;
  out["next_experiment"] = x.next.empty() ? Json(nullptr) : Json{{"why", x.next}};
  return out.dump(1) + "\n";
}

std::string amended(const JsonValue& root, const CurveExplanation& x) {
  const Candidate& c = x.best();
  const bool mended = c.fault && c.fault->root;
  Json file = Json::parse(data::to_json(mended ? *c.fault->root : root));
  if (c.fault && !mended)
    for (std::size_t r = file["runs"].size(); r-- > 0;)
      if (!c.fault->chosen[r][0]) file["runs"].erase(r);
  for (const Switched& s : c.model.on) {
    const EffectHead& head = c.set->effects()[s.effect];
    Json entry = {{"id", head.id}};
    if (!head.form.empty()) entry["form"] = head.form;
    for (std::size_t p = 0; p < s.values.size(); ++p) entry["parameters"][head.parameters[p].name] = s.values[p];
    file["effects"].push_back(entry);
  }
  for (std::size_t i = 0; i < x.set->free().size() && i < c.parameters.size(); ++i)
    file["fitted"][c.parameters[i].label] = c.parameters[i].value;
  return file.dump(1) + "\n";
}

std::string prediction_json(const Set& set) {
  std::vector<double> free;
  for (const EffectParameter& p : set.free()) free.push_back(p.prior);
  const std::vector<Curves> predicted = set.predict(free, {});
  Json runs = Json::array();
  for (std::size_t r = 0; r < predicted.size(); ++r) {
    const Run& run = set.runs()[r];
    Json entry = {{"id", run.id}};
    for (std::size_t c = 0; c < predicted[r].size(); ++c) {
      const Eigen::VectorXd& y = predicted[r][c];
      entry[run.channels[c].key] = std::vector<double>(y.begin(), y.end());
      entry["rms_to_measured"][run.channels[c].key] =
          std::sqrt((y - run.channels[c].measured).squaredNorm() / static_cast<double>(y.size()));
    }
    runs.push_back(entry);
  }
  return Json{{"schema", "ostium-prediction/1"}, {"kind", set.kind}, {"runs", runs}}.dump(1) + "\n";
}

std::string prediction_csv(const Set& set) {
  std::vector<double> free;
  for (const EffectParameter& p : set.free()) free.push_back(p.prior);
  const std::vector<Curves> predicted = set.predict(free, {});
  const Run& first = set.runs()[0];
  std::string out = "run," + csv_field(first.along_label + "_" + first.along_unit);
  for (const Channel& channel : first.channels)
    out += fmt::format(",{},{}", csv_field(channel.key), csv_field(channel.key + "_measured"));
  out += "\n";
  for (std::size_t r = 0; r < predicted.size(); ++r)
    for (Eigen::Index k = 0; k < set.runs()[r].samples(); ++k) {
      out += fmt::format("{},{:.9g}", csv_field(set.runs()[r].id), set.runs()[r].along[k]);
      for (std::size_t c = 0; c < predicted[r].size(); ++c)
        out += fmt::format(",{:.9g},{:.9g}", predicted[r][c][k], set.runs()[r].channels[c].measured[k]);
      out += "\n";
    }
  return out;
}

}  // namespace ostium::data::curves
