#include "data/identification/characterisation/characterise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/base/units.h"
#include "data/formats/csv_table.h"
#include "data/identification/characterisation/characterisation_report.h"
#include "data/identification/curves/curve_report.h"
#include "data/identification/curves/kinds.h"
#include "data/identification/curves/set/run_table.h"
#include "data/identification/measurement/measurement_reader.h"
#include "data/identification/report/explanation_report.h"

namespace ostium::data {

namespace {

using Json = nlohmann::ordered_json;

using units::mm, units::Nmm2;

/// The set's folder, or its file if that has a name of its own; with a number if another set is called so.
std::string name_of(const std::string& file, const std::vector<CharacterisedSet>& others) {
  const std::filesystem::path path = std::filesystem::absolute(file).lexically_normal();
  const std::string stem = path.stem().string();
  const std::string name = stem == "measurement" ? path.parent_path().filename().string() : stem;
  const auto taken = [&](const std::string& n) {
    return std::any_of(others.begin(), others.end(), [&](const CharacterisedSet& s) { return s.name == n; });
  };
  std::string out = name;
  for (int k = 2; taken(out); ++k) out = fmt::format("{}-{}", name, k);
  return out;
}

/// Why a set does not count; empty: it does.
std::string why_unused(Verdict verdict) {
  switch (verdict) {
    case Verdict::unexplained:
      return "it is unexplained: what it says of stiffness stands for something else";
    case Verdict::ambiguous:
      return "it is ambiguous: its stiffness depends on which effect is taken";
    case Verdict::cannot_be_judged:
      return "its noise is unknown";
    default:
      return "";
  }
}

constexpr const char* ended = "its search was ended before everything was tried";

void explain_curves_of(CharacterisedSet& s, const CharacteriseOptions& options) {
  curves::CurveOptions how;
  how.progress = options.progress, how.stop = options.stop;
  const curves::CurveExplanation found = explain_curves(s.root, how);
  s.found = found;
  s.why_unused = found.ended_early ? ended : why_unused(found.verdict);
  if (found.verdict == Verdict::cannot_be_judged) s.why_unused = "it cannot be judged; that takes " + found.next;
  if (!s.used()) return;
  s.stiffness = estimates_of(s.root, found);
  s.friction = friction_of(s.root, found);
}

void explain_shapes_of(CharacterisedSet& s, const CharacteriseOptions& options) {
  s.shapes = load_measurement(*s.root.file);
  ExplainOptions how;
  how.library = true, how.threads = options.threads, how.progress = options.progress, how.stop = options.stop;
  const Explanation found = explain(s.shapes, how);
  s.found = found;
  s.why_unused = found.ended_early ? ended : why_unused(found.verdict);
  if (s.used()) s.stiffness = estimates_of(s.shapes, found);
}

/// The set as it was found, with its effects declared: what another's stiffness is tried in.
JsonValue as_found(const CharacterisedSet& s) {
  const std::string text = std::visit(
      [&](const auto& found) {
        if constexpr (std::is_same_v<std::decay_t<decltype(found)>, Explanation>)
          return amended(to_json(s.root), s.shapes, found);
        else
          return curves::amended(s.root, found);
      },
      s.found);
  return parse_json(*s.root.file, text);
}

std::vector<DeclaredStretch> declared_in(const std::string& instrument) {
  std::vector<DeclaredStretch> out;
  const Json file = Json::parse(instrument);
  for (const Json& s : file["sections"]["list"]) {
    const double EI =
        s.contains("EI_Nmm2") ? double(s["EI_Nmm2"]) : 0.5 * (double(s["EI1_Nmm2"]) + double(s["EI2_Nmm2"]));
    out.push_back(
        {double(s["from_tip_mm"][0]) * mm, double(s["from_tip_mm"][1]) * mm, EI * Nmm2, double(s["GJ_Nmm2"]) * Nmm2});
  }
  return out;
}

/// What the used sets but `without` say; none without: all of them.
CharacterisedWire wire_of(const Characterisation& c, std::optional<std::size_t> without) {
  std::vector<std::vector<StiffnessEstimate>> stiffness;
  std::vector<std::optional<FrictionEstimate>> friction;
  for (std::size_t k = 0; k < c.sets.size(); ++k) {
    const bool counts = k != without;
    stiffness.push_back(counts ? c.sets[k].stiffness : std::vector<StiffnessEstimate>{});
    friction.push_back(counts ? c.sets[k].friction : std::nullopt);
  }
  return combined(c.declared, stiffness, friction);
}

/// Whether every stiffness that the set itself shows is measured by others.
bool covers(const CharacterisedWire& others, const CharacterisedSet& set) {
  return std::all_of(set.stiffness.begin(), set.stiffness.end(), [&](const StiffnessEstimate& e) {
    return std::all_of(others.stretches.begin(), others.stretches.end(), [&](const Stretch& s) {
      const double middle = (s.from_tip_m + s.to_tip_m) / 2;
      const Combined& c = e.of == Stiffness::bending ? s.EI_N_m2 : s.GJ_N_m2;
      return middle < e.from_tip_m || middle > e.to_tip_m || c.measured();
    });
  });
}

void check_by_the_others(Characterisation& c, const CharacteriseOptions& options) {
  for (std::size_t k = 0; k < c.sets.size(); ++k) {
    CharacterisedSet& s = c.sets[k];
    if (!s.used() || s.stiffness.empty()) continue;
    const CharacterisedWire others = wire_of(c, k);
    if (!covers(others, s)) continue;
    const auto told = [&](const std::string& words) {
      if (options.progress) options.progress(s.name + " by the others: " + words);
    };
    try {
      s.check = check(as_found(s), others, told);
    } catch (const LoadError&) {  // no noise is declared, or its frame is free: it cannot be predicted
    }
  }
}

std::string where(const Stretch& s) {
  return fmt::format("{:g} to {:g} mm from the tip", s.from_tip_m / mm, s.to_tip_m / mm);
}

std::string disagreement(const Characterisation& c, const std::string& what, const Combined& number) {
  std::string out = what + ": the sets disagree by more than their errors (";
  for (std::size_t i = 0; i < number.sets.size(); ++i)
    out += fmt::format("{}{} {:+.1f} sigma", i > 0 ? ", " : "", c.sets[number.sets[i]].name, number.off[i]);
  return out +
         "); the error is widened. A wrong weight moves only free shapes without a load, a wrong load cell only "
         "benches.";
}

void put_into_words(Characterisation& c) {
  for (const CharacterisedSet& s : c.sets) {
    for (const std::string& doubt : curves::doubts_of_tables(s.root)) c.text.push_back(doubt);
    if (const std::string& table = s.shapes.table; !table.empty())
      if (std::string doubt = doubt_of_end(table); !doubt.empty()) c.text.push_back(std::move(doubt));
  }
  for (const CharacterisedSet& s : c.sets)
    if (!s.used()) c.text.push_back(fmt::format("{} is not used: {}.", s.name, s.why_unused));
  double measured = 0;
  for (const Stretch& s : c.wire.stretches) {
    if (s.EI_N_m2.measured()) measured += s.to_tip_m - s.from_tip_m;
    if (s.EI_N_m2.disagree()) c.text.push_back(disagreement(c, "EI, " + where(s), s.EI_N_m2));
    if (s.GJ_N_m2.disagree()) c.text.push_back(disagreement(c, "GJ, " + where(s), s.GJ_N_m2));
  }
  if (c.wire.friction.disagree()) c.text.push_back(disagreement(c, "friction", c.wire.friction));
  c.text.insert(c.text.begin(), fmt::format("EI was measured on {:.0f} of {:.0f} mm; the rest is as declared.",
                                            measured / mm, c.declared.back().to_tip_m / mm));
  c.text.insert(c.text.begin() + 1,
                fmt::format("Each error holds {:g} % of calibration, which no fit sees, besides what `explain` gives.",
                            100 * calibrated_to));
  for (const CharacterisedSet& s : c.sets)
    if (s.check)
      c.text.push_back(s.name + ", predicted by the others with nothing fitted: off by " + words_of(*s.check) + ".");
}

}  // namespace

Verdict CharacterisedSet::verdict() const {
  return std::visit([](const auto& x) { return x.verdict; }, found);
}

std::vector<std::string> CharacterisedSet::effects() const {
  if (const auto* x = std::get_if<Explanation>(&found)) return x->effects();
  const auto& x = std::get<curves::CurveExplanation>(found);
  return x.found() ? x.best().effects : std::vector<std::string>{};
}

namespace {

/// What is in two sets would count as measured twice: its error would shrink, and it would agree with itself.
void require_no_copies(const std::vector<std::vector<MeasuredNumbers>>& of_sets, const Characterisation& c) {
  for (std::size_t k = 0; k < of_sets.size(); ++k)
    for (std::size_t l = 0; l < k; ++l)
      for (const MeasuredNumbers& one : of_sets[l])
        for (const MeasuredNumbers& other : of_sets[k])
          if (!one.numbers.empty() && one.numbers == other.numbers)
            throw LoadError(fmt::format(
                "{}: {} is the same measurement as {} of {}, number for number; expected each measurement once",
                *c.sets[k].root.file, other.id, one.id, *c.sets[l].root.file));
}

/// A wire and a catheter are no one instrument; calipers differ by less.
void require_one_width(const Characterisation& c) {
  constexpr double most_apart = 1.1;
  const auto radius_mm = [](const CharacterisedSet& s) {
    return s.root.find("instruments")->items[0].find("outer_radius_mm")->number;
  };
  for (const CharacterisedSet& s : c.sets) {
    const double own = radius_mm(s), first = radius_mm(c.sets[0]);
    if (std::max(own, first) > most_apart * std::min(own, first))
      throw LoadError(
          fmt::format("{}: its instrument has an outer radius of {:g} mm, and that of {} has {:g} mm; expected sets of "
                      "one instrument",
                      *s.root.file, own, *c.sets[0].root.file, first));
  }
}

}  // namespace

Characterisation characterise(const std::vector<std::string>& files, const std::string& like,
                              const CharacteriseOptions& options) {
  Characterisation c;
  c.like = like;
  std::vector<std::vector<MeasuredNumbers>> measured;
  // All are read before the first is explained, so that a mistake in the last costs no time.
  for (const std::string& file : files) {
    CharacterisedSet s;
    s.root = load_json(measurement_file(file));
    s.name = name_of(*s.root.file, c.sets);
    s.why_unused = "it was not reached";
    set_with(s.root, {});
    if (curves::kind_of(s.root)) {
      s.root = curves::with_tables(s.root);
      measured.push_back(curves::measured_numbers(curves::read_set(s.root)->runs()));
    } else {
      measured.push_back(measured_numbers(load_measurement(file)));
    }
    c.sets.push_back(std::move(s));
  }
  require_no_copies(measured, c);
  require_one_width(c);
  for (CharacterisedSet& s : c.sets) {
    if (options.stop && options.stop()) break;
    if (options.progress) options.progress(s.name);
    curves::kind_of(s.root) ? explain_curves_of(s, options) : explain_shapes_of(s, options);
    if (c.like.empty() && s.used())
      if (const auto* x = std::get_if<Explanation>(&s.found)) c.like = instrument_json(s.shapes, *x, 0);
  }
  if (c.like.empty() && options.stop && options.stop())
    throw std::runtime_error("ended before a set that gives weight and sizes was explained: nothing is known so far");
  if (c.like.empty())
    throw LoadError(
        "none of the sets gives weight and sizes, as explained sets of shapes do: name an instrument that has them "
        "(--like wire-014-workhorse, or a file)");
  if (std::none_of(c.sets.begin(), c.sets.end(), [](const CharacterisedSet& s) { return s.used(); })) {
    std::string why;
    for (const CharacterisedSet& s : c.sets)
      why += fmt::format("{}{}: {}", why.empty() ? "" : "; ", s.name, s.why_unused);
    throw std::runtime_error("no set says anything of the instrument, so none is written; " + why);
  }
  c.declared = declared_in(c.like);
  c.wire = wire_of(c, {});
  check_by_the_others(c, options);
  put_into_words(c);
  return c;
}

}  // namespace ostium::data
