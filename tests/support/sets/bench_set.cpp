#include "tests/support/sets/bench_set.h"

#include "tests/support/sets/bend_set.h"
#include "tests/support/sets/density_set.h"
#include "tests/support/sets/inflation_set.h"
#include "tests/support/sets/push_set.h"
#include "tests/support/sets/torque_set.h"

namespace ostium::synthetic {

namespace {

/// "veiling_glare constant" is a form of veiling_glare.
BenchSet with_effect(const std::string& json, const std::string& effect) {
  BenchSet out;
  out.json = json;
  if (!effect.empty()) out.effects = {effect.substr(0, effect.find(' '))};
  return out;
}

std::string effect_of(const std::string& content) { return content == "clean" ? "" : content; }

std::vector<std::string> contents(const std::vector<std::string>& effects) {
  std::vector<std::string> out = {"clean"};
  out.insert(out.end(), effects.begin(), effects.end());
  return out;
}

BenchSet density(const std::string& content, double size, unsigned seed) {
  const std::string effect = effect_of(content);
  return with_effect(bench_sets::density_set(effect, size, seed).json, effect);
}

BenchSet inflation(const std::string& content, double size, unsigned seed) {
  const std::string effect = effect_of(content);
  return with_effect(bench_sets::inflation_set(effect, size, seed), effect);
}

}  // namespace

const std::vector<BenchKind>& bench_kinds() {
  static const std::vector<BenchKind> list = {
      bend_kind(),
      torque_kind(),
      push_kind(),
      {"density", contents(bench_sets::density_effects()), density},
      {"pressure_diameter", contents(bench_sets::inflation_effects()), inflation}};
  return list;
}

}  // namespace ostium::synthetic
