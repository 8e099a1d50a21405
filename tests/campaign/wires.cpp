/// ostium-wires: how well `ostium characterise` does. Wires are drawn, measured on three benches by independent
/// generators, characterised, and asked to predict three benches that were not among them, as they were found and
/// falsified by 30 %.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "core/base/units.h"
#include "data/catalogue/instrument/instrument_reader.h"
#include "data/formats/write_file.h"
#include "data/identification/characterisation/characterisation_report.h"
#include "tests/support/dice.h"
#include "tests/support/sets/bend_set.h"
#include "tests/support/sets/push_set.h"
#include "tests/support/sets/synthetic_set.h"
#include "tests/support/sets/torque_set.h"
#include "tests/support/sets/undeclared_views.h"

namespace {

using namespace ostium;
using units::Nmm2;

/// Declared up to a quarter wrong, friction up to a half.
synthetic::BenchWire drawn(unsigned seed) {
  synthetic::Dice dice("wire", seed);
  synthetic::BenchWire w;
  w.EI = dice.log_uniform(15, 35), w.GJ = w.EI * dice.uniform(0.6, 0.9), w.friction = dice.uniform(0.05, 0.12);
  w.declared_EI = w.EI * dice.log_uniform(0.75, 1.33), w.declared_GJ = w.GJ * dice.log_uniform(0.75, 1.33);
  w.declared_friction = w.friction * dice.log_uniform(0.6, 1.6);
  return w;
}

class Folder {
 public:
  explicit Folder(const std::string& path) : path_(path) {}
  std::string write(const std::string& name, const std::string& json) const {
    data::write_file((path_ / name / "measurement.json").string(), json);
    return (path_ / name).string();
  }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

std::string checked(const data::JsonValue& set, const data::CharacterisedWire& wire) {
  const data::WireCheck c = check(set, wire);
  return fmt::format("{:.2f} ({:+.0f}) {}", c.over_noise, c.moves.empty() ? 0.0 : c.moves[0].errors,
                     c.agrees() ? "yes" : "NO");
}

int run(unsigned first, int count, const std::string& to) {
  fmt::print("{:>5} {:>9} {:>7} {:>9} {:>7} {:>9} {:>7}  {:<18} {:<18} {:<18} {:<16} {:<16}\n", "seed", "EI off %",
             "+- %", "GJ off %", "+- %", "mu off %", "+- %", "push", "turned", "free", "EI false: free",
             "mu false: push");
  for (unsigned seed = first; seed < first + static_cast<unsigned>(count); ++seed) {
    const synthetic::BenchWire w = drawn(seed);
    const Folder folder(fmt::format("{}/{}", to, seed));
    const data::Characterisation found =
        data::characterise({folder.write("bend", synthetic::bend_of(w, seed).json),
                            folder.write("torque", synthetic::torque_of(w, seed).json),
                            folder.write("views", synthetic::to_json(synthetic::views_of(w, seed)))},
                           "", {});
    data::write_file(folder.file("found.json"), instrument_json(found, "found"));
    data::write_file(folder.file("found.html"), to_html(found));
    const data::CharacterisedWire known = wire_in(data::load_instrument(folder.file("found.json")));
    const auto held_out = [&](const std::string& name, const std::string& json) {
      return data::load_json(folder.write(name, json) + "/measurement.json");
    };
    const data::JsonValue push = held_out("push", synthetic::push_of(w, seed + 1).json),
                          turned = held_out("turned", synthetic::torque_of(w, seed + 1).json),
                          free = held_out("free", synthetic::to_json(synthetic::free_shapes_of(w, seed + 1)));
    data::CharacterisedWire stiffer = known, rougher = known;
    for (data::Stretch& s : stiffer.stretches) s.EI_N_m2.value *= 1.3;
    rougher.friction.value *= 1.3;
    const auto off = [](const data::Combined& n, double truth) { return 100 * (n.value / truth - 1); };
    const data::Stretch& s = known.stretches[0];
    fmt::print("{:>5} {:>9.2f} {:>7.2f} {:>9.2f} {:>7.2f} {:>9.2f} {:>7.2f}  {:<18} {:<18} {:<18} {:<16} {:<16}\n",
               seed, off(s.EI_N_m2, w.EI * Nmm2), 100 * s.EI_N_m2.sigma, off(s.GJ_N_m2, w.GJ * Nmm2),
               100 * s.GJ_N_m2.sigma, off(known.friction, w.friction), 100 * known.friction.sigma, checked(push, known),
               checked(turned, known), checked(free, known), checked(free, stiffer), checked(push, rougher));
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  unsigned first = 1;
  int count = 5;
  std::string to = "wires";
  CLI::App app("How well ostium characterise does on wires that are drawn");
  app.add_option("--first-seed", first, "");
  app.add_option("--seeds", count, "");
  app.add_option("--sets", to, "Folder for the sets and what was found");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return run(first, count, to);
}
