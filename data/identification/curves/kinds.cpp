#include "data/identification/curves/kinds.h"

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

std::unique_ptr<Set> read_set(const JsonValue& root) {
  const Kind* kind = kind_of(root);
  if (!kind) root.fail("no \"kind\"; expected one whose runs are curves");
  return kind->read(root);
}

}  // namespace ostium::data::curves
