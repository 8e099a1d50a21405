#include "data/identification/curves/kinds.h"

#include <fmt/format.h>

#include "data/identification/curves/density/density.h"
#include "data/identification/curves/pressure_diameter/pressure_diameter.h"
#include "data/identification/curves/push_pull/push_pull.h"
#include "data/identification/curves/three_point_bend/three_point_bend.h"
#include "data/identification/curves/torque_response/torque_response.h"

namespace ostium::data::curves {

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list = {three_point_bend::kind(), torque_response::kind(), push_pull::kind(),
                                         density::kind(), pressure_diameter::kind()};
  return list;
}

const Kind* kind_of(const JsonValue& root) {
  const JsonValue* named = root.find("kind");
  if (!named || named->type != JsonValue::Type::text) return nullptr;
  if (named->text == "centrelines" || named->text == "projections") return nullptr;
  std::string names = "\"centrelines\", \"projections\"";
  for (const Kind& kind : kinds()) {
    if (kind.name == named->text) return &kind;
    names += ", \"" + kind.name + "\"";
  }
  named->refuse("a kind of measurement: " + names);
}

namespace {

/// Numbers that are each in range may together foretell what is none, as friction in many bends does.
void require_sound(const Set& set) {
  constexpr double most = 1e12;  // as of numbers in files
  std::vector<double> free;
  for (const EffectParameter& p : set.free()) free.push_back(p.prior);
  const std::vector<Curves> foretold = set.predict(free, {});
  for (std::size_t r = 0; r < foretold.size(); ++r)
    for (std::size_t c = 0; c < foretold[r].size(); ++c) {
      const Run& run = set.runs()[r];
      for (const Eigen::VectorXd* numbers : {&foretold[r][c], &run.channels[c].sigma})
        if (!(numbers->array().abs() <= most).all())
          throw LoadError(
              fmt::format("{}: {}: {} or its noise would be beyond 1e12 {} with what is declared; expected "
                          "numbers of an instrument, a rig and a path that exist",
                          set.file, run.place, run.channels[c].key, run.channels[c].unit));
    }
}

}  // namespace

std::unique_ptr<Set> read_set(const JsonValue& root) {
  const Kind* kind = kind_of(root);
  if (!kind) root.fail("no \"kind\"; expected one whose runs are curves");
  std::unique_ptr<Set> set = kind->read(root);
  require_sound(*set);
  return set;
}

}  // namespace ostium::data::curves
