#include "tests/support/sets/torque_set.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/bench_noise.h"
#include "tests/support/dice.h"

namespace ostium::synthetic {

namespace {

using Json = nlohmann::ordered_json;
using Series = std::vector<double>;

constexpr double to_rad = 3.14159265358979 / 180;

/// What is true of the wire, its walls and its drive, in mm, N and rad.
struct Torqued {
  double length = 1000, radius = 0.178, EI = 40;
  double tip_length = 0, tip_GJ = 30, GJ = 30;  ///< the last part may be softer
  double friction = 0.05;
  double curved = 0, curved_towards = 0;  ///< at rest
  double handed = 1, slip = 0, dead = 0, dead_left = 0;
  std::size_t reseated = 99;
  double reseated_by = 0;
};

struct Bent {
  double at, radius, length, force;
};

struct Path {
  std::string name;
  std::vector<Bent> bends;
  Series drive_deg;
};

struct Measured {
  Series distal_deg, torque;
};

/// A piece of wire: a spring towards the drive, friction, and a pull by curvature at rest.
struct Piece {
  double at = 0, friction = 0, pull = 0, compliance = 0, angle = 0, stood = 0;
};

double twist_per_torque(const Torqued& t, double from, double to) {
  double out = 0;
  constexpr int parts = 400;
  for (int k = 0; k < parts; ++k) {
    const double at = from + (k + 0.5) / parts * (to - from);
    out += (to - from) / parts / (at > t.length - t.tip_length ? t.tip_GJ : t.GJ);
  }
  return out;
}

std::vector<Piece> pieces(const Torqued& t, const Path& path) {
  std::vector<Piece> out;
  for (const Bent& b : path.bends) {
    const double most = t.friction * b.force * t.radius;
    out.push_back({b.at, most});
    // Trapezoids: half a cell at each end.
    const int cells = t.curved == 0 ? 0 : std::max(4, static_cast<int>(b.length / 7));
    for (int k = 0; k <= cells && cells > 0; ++k) {
      const double share = k == 0 || k == cells ? 0.5 : 1;
      const double at = std::clamp(b.length * k / cells, 0.05, b.length - 0.05);
      out.push_back({b.at + at, 0, t.EI * t.curved / b.radius * b.length / cells * share});
    }
    out.push_back({b.at + b.length, most});
  }
  double from = 0;
  for (Piece& p : out) p.compliance = twist_per_torque(t, from, p.at), from = p.at;
  return out;
}

double spring(const Torqued& t, double compliance, double twist) {
  return (twist > 0 ? std::sqrt(t.handed) : 1 / std::sqrt(t.handed)) / compliance;
}

/// Sweeps until nothing turns any more. Friction holds each piece as near to where it stood as it can.
void relax(const Torqued& t, double drive, std::vector<Piece>& wire) {
  for (int sweep = 0; sweep < 4000; ++sweep) {
    double most = 0;
    for (std::size_t i = 0; i < wire.size(); ++i) {
      Piece& p = wire[i];
      const double before = i > 0 ? wire[i - 1].angle : drive, was = p.angle;
      const double k = spring(t, p.compliance, before - was);
      const bool last = i + 1 == wire.size();
      const double after = last ? 0 : wire[i + 1].angle, kn = last ? 0 : spring(t, wire[i + 1].compliance, was - after);
      if (p.friction > 0) {
        const double rest = (k * before + kn * after) / (k + kn), half = p.friction / (k + kn);
        p.angle = std::clamp(p.stood, rest - half, rest + half);
      } else {
        const double phase = was - t.curved_towards;
        const double torque = k * (before - was) - kn * (was - after) - p.pull * std::sin(phase);
        const double stiff = k + kn + std::max(p.pull * std::cos(phase), 0.0);
        p.angle += std::clamp(1.7 * torque / stiff, -0.1, 0.1);
      }
      most = std::max(most, std::fabs(p.angle - was));
    }
    if (most < 1e-8) return;
  }
}

Measured measure(const Torqued& t, const Path& path, std::size_t run) {
  Measured out;
  std::vector<Piece> wire = pieces(t, path);
  double at = path.drive_deg[0] * to_rad, arrived = at, gap = 0;
  relax(t, arrived, wire);
  const bool up = path.drive_deg[1] > path.drive_deg[0];
  // How far the drive can still go up before it meets the wire.
  gap = up ? t.dead_left * t.dead : t.dead - t.dead_left * t.dead;
  for (const double to_deg : path.drive_deg) {
    const double goal = to_deg * to_rad;
    const int steps = std::max(1, static_cast<int>(std::ceil(std::fabs(goal - at) / 0.05)));
    const double by = (goal - at) / steps;
    for (int k = 0; k < steps; ++k) {
      gap -= by;
      double moved = 0;
      if (gap < 0) moved = -gap, gap = 0;
      if (gap > t.dead) moved = t.dead - gap, gap = t.dead;
      arrived += (1 - t.slip) * moved;
      for (Piece& p : wire) p.stood = p.angle;
      relax(t, arrived, wire);
    }
    at = goal;
    const double distal = wire.empty() ? arrived : wire.back().angle;
    out.distal_deg.push_back(distal / to_rad + (run >= t.reseated ? t.reseated_by : 0));
    const double twist = wire.empty() ? 0 : arrived - wire[0].angle;
    out.torque.push_back(wire.empty() ? 0 : spring(t, wire[0].compliance, twist) * twist);
  }
  return out;
}

std::vector<Measured> measure(const Torqued& t, const std::vector<Path>& paths) {
  std::vector<Measured> out;
  for (std::size_t r = 0; r < paths.size(); ++r) out.push_back(measure(t, paths[r], r));
  return out;
}

Bent bend(Dice& dice, double at, double radius, double angle) {
  constexpr double gap = 0.1, EI = 40;
  return {at, radius, radius * angle, EI / radius * std::sqrt(2 / (3 * radius * gap)) * dice.uniform(0.9, 1.1)};
}

/// Turned so far that a reader cannot tell by the numbers alone.
constexpr const char* both_in_radians = "fault:both_radians";

/// A straight path, one bend, two and a loop, each turned both ways and back, `as_far` as a bench mostly does.
std::vector<Path> design(Dice& dice, double as_far) {
  const std::vector<Bent> one = {bend(dice, dice.uniform(350, 450), dice.uniform(20, 35), 1.57)},
                          two = {bend(dice, dice.uniform(200, 300), dice.uniform(30, 50), 1.57),
                                 bend(dice, dice.uniform(550, 650), dice.uniform(20, 35), dice.uniform(1, 2.4))},
                          loop = {bend(dice, dice.uniform(250, 350), dice.uniform(40, 60), 6.28)};
  std::vector<Path> out;
  const auto add = [&](const std::string& name, const std::vector<Bent>& bends, double side, double most) {
    Path p{name, bends, {}};
    for (double at = 0; at < most * as_far; at += 12) p.drive_deg.push_back(side * at);
    for (double at = most * as_far; at >= 0; at -= 12) p.drive_deg.push_back(side * at);
    out.push_back(p);
  };
  add("straight", {}, 1, 360);
  for (const double side : {1.0, -1.0}) add("one bend", one, side, 720);
  for (const double side : {1.0, -1.0}) add("two bends", two, side, 720);
  for (const double side : {1.0, -1.0}) add("loop", loop, side, 720);
  return out;
}

/// `amount`: 0 is nothing, 1 more than a bench has.
void switch_on(const std::string& content, double amount, double side, Dice& dice, Torqued& t) {
  const double u = dice.uniform(0, 1), v = dice.uniform(0, 1);
  if (content == "wall_friction") t.friction *= side > 0 ? 1 + 9 * amount : 1 - 0.95 * amount;
  if (content == "whip") t.curved = 0.02 * std::pow(amount, 3), t.curved_towards = 6.28 * u;
  if (content == "handed_stiffness") t.handed = std::exp(side * 2.5 * amount);
  if (content == "drive_slip") t.slip = 0.6 * amount;
  if (content == "drive_backlash") t.dead = 1.5 * amount, t.dead_left = v < 0.4 ? 0 : v < 0.7 ? 0.5 : u;
  if (content == "reseated_instrument") {
    t.reseated = 1 + static_cast<std::size_t>(u * 5.99), t.reseated_by = side * 180 * amount;
  }
}

/// Root mean square of a difference over the noise, less what another GJ would take of it.
double excess(const std::vector<Measured>& with, const std::vector<Measured>& plain,
              const std::vector<Measured>& stiffer, double distal_noise, double torque_noise) {
  double dd = 0, ds = 0, ss = 0, count = 0;
  const auto add = [&](const Series& a, const Series& b, const Series& c, double noise) {
    for (std::size_t k = 0; k < a.size(); ++k) {
      const double d = (a[k] - b[k]) / noise, s = (c[k] - b[k]) / noise;
      dd += d * d, ds += d * s, ss += s * s, ++count;
    }
  };
  for (std::size_t r = 0; r < with.size(); ++r) {
    add(with[r].distal_deg, plain[r].distal_deg, stiffer[r].distal_deg, distal_noise);
    add(with[r].torque, plain[r].torque, stiffer[r].torque, torque_noise);
  }
  return std::sqrt((dd - (ss > 0 ? ds * ds / ss : 0)) / count);
}

void spoil(const std::string& content, Dice& dice, Json& runs, BenchSet& out) {
  const auto r = static_cast<std::size_t>(dice.whole(1, 6));
  const auto scaled = [&](const char* key, double factor) {
    for (Json& v : runs[r][key]) v = v.get<double>() * factor;
  };
  out.effects = {"unit_error"};
  if (content == "fault:radians") scaled("distal_deg", to_rad);
  if (content == "fault:turned_radians") scaled("proximal_deg", to_rad);
  if (content == both_in_radians)
    for (Json& run : runs)
      for (const char* key : {"proximal_deg", "distal_deg"})
        for (Json& v : run[key]) v = v.get<double>() * to_rad;
  if (content == "fault:mN_m") scaled("torque_Nmm", 1e-3);
  if (content == "fault:swapped") {
    const std::size_t other = r % 2 ? r + 1 : r - 1;  // the other sense of the same path
    for (const char* key : {"distal_deg", "torque_Nmm"}) std::swap(runs[r][key], runs[other][key]);
    out.effects = {"swapped_experiments"};
  }
  if (content == "fault:outlier") scaled("distal_deg", dice.uniform(0.85, 0.95)), out.effects = {"outlier_experiment"};
}

BenchSet make_of(const BenchWire* wire, const std::string& content, double size, unsigned seed) {
  Dice dice("torque:" + content, seed);
  Torqued declared;
  declared.GJ = dice.log_uniform(20, 45), declared.tip_GJ = declared.GJ, declared.friction = dice.uniform(0.03, 0.08);
  if (dice.uniform(0, 1) < 0.5) declared.tip_length = dice.uniform(450, 550), declared.tip_GJ *= dice.uniform(0.5, 0.8);
  Torqued plain = declared;
  plain.GJ *= dice.log_uniform(0.75, 1.33), plain.tip_GJ *= dice.log_uniform(0.75, 1.33);
  if (wire) {
    declared.tip_length = 0, declared.EI = wire->declared_EI;
    declared.GJ = declared.tip_GJ = wire->declared_GJ, declared.friction = wire->declared_friction;
    plain = declared;
    plain.EI = wire->EI, plain.GJ = plain.tip_GJ = wire->GJ, plain.friction = wire->friction;
  }
  const std::vector<Path> paths = design(dice, content == both_in_radians ? 2 : 1);
  const double distal_noise = dice.uniform(1, 2), torque_noise = 0.002 * dice.log_uniform(0.5, 1.5);
  std::vector<Measured> measured = measure(plain, paths);
  BenchSet out;
  if (content != "clean" && content.find(':') == std::string::npos) {
    const std::vector<Measured> without = measured;
    Torqued other = plain;
    other.GJ *= 1.05, other.tip_GJ *= 1.05;
    const std::vector<Measured> stiffer = measure(other, paths);
    const Dice at = dice;
    double side = Dice(at).sign();
    const auto with = [&](double amount) {
      Dice same = at;
      Torqued t = plain;
      switch_on(content, amount, side, same, t);
      return measure(t, paths);
    };
    const auto size_of = [&](double amount) {
      return excess(with(amount), without, stiffer, distal_noise, torque_noise);
    };
    if (side < 0 && size_of(1) < size) side = 1;
    double low = 0, high = 1;
    for (int i = 0; i < 9; ++i) {
      const double middle = (low + high) / 2;
      (size_of(middle) < size ? low : high) = middle;
    }
    measured = with((low + high) / 2), out.effects = {content};
  }
  Json runs = Json::array();
  NoiseMaker noise(content, dice);
  for (std::size_t r = 0; r < paths.size(); ++r) {
    Measured& m = measured[r];
    const Series on_distal = noise.run(m.torque.size()), on_torque = noise.run(m.torque.size());
    for (std::size_t k = 0; k < m.torque.size(); ++k)
      m.distal_deg[k] += distal_noise * on_distal[k], m.torque[k] += torque_noise * on_torque[k];
    Json bends = Json::array(), contacts = Json::array();
    for (const Bent& b : paths[r].bends) {
      bends.push_back({{"at_mm", b.at}, {"radius_mm", b.radius}, {"length_mm", b.length}});
      for (const double place : {b.at, b.at + b.length})
        contacts.push_back({{"at_mm", place}, {"contact_force_N", b.force}});
    }
    runs.push_back({{"id", "t" + std::to_string(r)},
                    {"path", paths[r].name},
                    {"bends", bends},
                    {"contacts", contacts},
                    {"proximal_deg", paths[r].drive_deg},
                    {"distal_deg", m.distal_deg},
                    {"torque_Nmm", m.torque}});
  }
  if (content.rfind("fault:", 0) == 0) spoil(content, dice, runs, out);
  Json sections = Json::array();
  const auto section = [&](double from, double to, double GJ) {
    sections.push_back({{"from_tip_mm", {from, to}}, {"EI_Nmm2", declared.EI}, {"GJ_Nmm2", GJ}});
  };
  if (declared.tip_length > 0) section(0, declared.tip_length, declared.tip_GJ);
  section(declared.tip_length, declared.length, declared.GJ);
  const Json file = {
      {"schema", "ostium-measurement/2"},
      {"kind", "torque_response"},
      {"title", "torque response"},
      {"instruments",
       {{{"name", "0.014in wire"},
         {"outer_radius_mm", declared.radius},
         {"length_mm", declared.length},
         {"sections", sections}}}},
      {"rig", {{"friction", declared.friction}, {"lumen_clearance_mm", 0.1}}},
      {"noise",
       {{"distal_deg", distal_noise * noise.declared_share() * (content == both_in_radians ? to_rad : 1)},
        {"torque_Nmm", torque_noise * noise.declared_share()}}},
      {"runs", runs}};
  out.json = file.dump();
  return out;
}

BenchSet make(const std::string& content, double size, unsigned seed) { return make_of(nullptr, content, size, seed); }

}  // namespace

BenchSet torque_of(const BenchWire& wire, unsigned seed) { return make_of(&wire, "clean", 0, seed); }

BenchKind torque_kind() {
  return {"torque_response",
          {"clean", "noise:shared", "noise:heavy", "noise:twice", "wall_friction", "whip", "handed_stiffness",
           "drive_slip", "drive_backlash", "reseated_instrument", "fault:radians", "fault:turned_radians", "fault:mN_m",
           "fault:swapped", "fault:outlier"},
          make};
}

}  // namespace ostium::synthetic
