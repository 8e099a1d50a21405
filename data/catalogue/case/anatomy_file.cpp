#include "data/catalogue/case/anatomy_file.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/units.h"
#include "data/catalogue/case/anatomy_keys.h"

namespace ostium::data {

namespace {

using units::mm;

std::string quoted(const std::string& text) { return nlohmann::json(text).dump(); }

std::string point(const Eigen::Vector3d& p, double unit) {
  return fmt::format("[{:.5f}, {:.5f}, {:.5f}]", p.x() / unit, p.y() / unit, p.z() / unit);
}

Eigen::Vector3d vector(const JsonObject& object, const std::string& key) {
  const std::vector<double> v = object.numbers(key, 3);
  return {v[0], v[1], v[2]};
}

Eigen::Vector3d direction(const JsonObject& object, const std::string& key) {
  const Eigen::Vector3d v = vector(object, key);
  if (v.norm() < 1e-6) object.refuse(key);
  return v.normalized();
}

int index(const JsonObject& object, const std::string& key, int least, std::size_t count) {
  const double n = object.number(key);
  if (n != std::floor(n) || n < least || n >= static_cast<double>(count)) object.refuse(key);
  return static_cast<int>(n);
}

vascular::Tube read_tube(const JsonObject& object, std::size_t before) {
  vascular::Tube tube{.name = object.text("name"), .nodes = {}};
  tube.parent = index(object, "parent", -1, before);
  tube.blend = object.positive("blend");
  for (const JsonValue& value : object.list("nodes")) {
    if (value.type != JsonValue::Type::array || value.items.size() != 4) object.refuse("nodes");
    for (const JsonValue& item : value.items)
      if (item.type != JsonValue::Type::number) object.refuse("nodes");
    vascular::TubeNode node;
    node.p = mm * Eigen::Vector3d(value.items[0].number, value.items[1].number, value.items[2].number);
    node.radius_m = mm * value.items[3].number;
    const double step = tube.nodes.empty() ? 1 : (node.p - tube.nodes.back().p).norm();
    if (!(node.radius_m > 0) || !(step > 0)) object.refuse("nodes");
    node.s_m = tube.nodes.empty() ? 0 : tube.nodes.back().s_m + step;
    tube.nodes.push_back(node);
  }
  if (tube.nodes.size() < 2) object.refuse("nodes");
  return tube;
}

vascular::NamedBranch read_branch(const JsonObject& object, const std::vector<vascular::Tube>& tubes) {
  vascular::NamedBranch branch{.name = object.text("name"), .tube = index(object, "tube", 0, tubes.size())};
  // Files have five digits, so rounding may put a branch's end beyond its tube's.
  const double length = tubes[static_cast<std::size_t>(branch.tube)].length_m();
  branch.from_m = mm * object.not_negative("from_mm");
  branch.to_m = std::min(mm * object.not_negative("to_mm"), length);
  if (branch.from_m > length) object.refuse("from_mm");
  if (branch.to_m < branch.from_m) object.refuse("to_mm");
  return branch;
}

vascular::Landmarks read_landmarks(const JsonObject& object) {
  vascular::Landmarks marks;
  marks.p_access = mm * vector(object, "access_mm");
  marks.access_direction = direction(object, "access_direction");
  marks.p_left_ostium = mm * vector(object, "left_ostium_mm");
  marks.p_right_ostium = mm * vector(object, "right_ostium_mm");
  marks.p_annulus = mm * vector(object, "annulus_mm");
  marks.root_axis = direction(object, "root_axis");
  marks.p_lv_base = mm * vector(object, "lv_base_mm");
  marks.p_lv_apex = mm * vector(object, "lv_apex_mm");
  marks.right_groove = direction(object, "right_groove");
  if ((marks.p_lv_apex - marks.p_lv_base).norm() < 10 * mm) object.refuse("lv_apex_mm");
  return marks;
}

vascular::Anatomy anatomy_of(const JsonValue& file) {
  const JsonObject root(file, anatomy_keys::root);
  if (root.text("schema") != "ostium-anatomy/1") root.refuse("schema");
  vascular::Anatomy anatomy;
  anatomy.aorta = root.boolean("aorta");
  anatomy.ascending_m = mm * root.positive("ascending_mm");
  if (anatomy.ascending_m <= 20 * mm) root.refuse("ascending_mm");
  for (const JsonValue& value : root.list("tubes"))
    anatomy.tubes.push_back(read_tube(JsonObject(value, anatomy_keys::tube), anatomy.tubes.size()));
  if (anatomy.tubes.empty()) root.refuse("tubes");
  for (const JsonValue& value : root.list("branches"))
    anatomy.branches.push_back(read_branch(JsonObject(value, anatomy_keys::branch), anatomy.tubes));
  anatomy.landmarks = read_landmarks(JsonObject(root["landmarks"], anatomy_keys::landmarks));
  return anatomy;
}

}  // namespace

std::string anatomy_to_json(const vascular::Anatomy& anatomy) {
  std::string text = fmt::format(
      "{{\n\"schema\": \"ostium-anatomy/1\",\n\"aorta\": {},\n\"ascending_mm\": {:.5f},\n\"landmarks\": {{\n",
      anatomy.aorta ? "true" : "false", anatomy.ascending_m / mm);
  const vascular::Landmarks& m = anatomy.landmarks;
  text += fmt::format("  \"access_mm\": {},\n  \"access_direction\": {},\n", point(m.p_access, mm),
                      point(m.access_direction, 1));
  text += fmt::format("  \"left_ostium_mm\": {},\n  \"right_ostium_mm\": {},\n", point(m.p_left_ostium, mm),
                      point(m.p_right_ostium, mm));
  text += fmt::format("  \"annulus_mm\": {},\n  \"root_axis\": {},\n", point(m.p_annulus, mm), point(m.root_axis, 1));
  text += fmt::format("  \"lv_base_mm\": {},\n  \"lv_apex_mm\": {},\n  \"right_groove\": {}\n}},\n\"branches\": [",
                      point(m.p_lv_base, mm), point(m.p_lv_apex, mm), point(m.right_groove, 1));
  for (std::size_t b = 0; b < anatomy.branches.size(); ++b) {
    const vascular::NamedBranch& branch = anatomy.branches[b];
    text += fmt::format("{}\n{{ \"name\": {}, \"tube\": {}, \"from_mm\": {:.5f}, \"to_mm\": {:.5f} }}", b ? "," : "",
                        quoted(branch.name), branch.tube, branch.from_m / mm, branch.to_m / mm);
  }
  text += "\n],\n\"tubes\": [";
  for (std::size_t t = 0; t < anatomy.tubes.size(); ++t) {
    const vascular::Tube& tube = anatomy.tubes[t];
    text += fmt::format("{}\n{{ \"name\": {}, \"parent\": {}, \"blend\": {:g}, \"nodes\": [", t ? "," : "",
                        quoted(tube.name), tube.parent, tube.blend);
    for (std::size_t i = 0; i < tube.nodes.size(); ++i) {
      const Eigen::Vector3d p = tube.nodes[i].p / mm;
      text += fmt::format("{}\n[{:.5f}, {:.5f}, {:.5f}, {:.5f}]", i ? "," : "", p.x(), p.y(), p.z(),
                          tube.nodes[i].radius_m / mm);
    }
    text += "] }";
  }
  return text + "\n]\n}\n";
}

vascular::Anatomy read_anatomy(const std::string& file, const std::string& text) {
  return anatomy_of(parse_json(file, text));
}
vascular::Anatomy load_anatomy(const std::string& file) { return anatomy_of(load_json(file)); }

}  // namespace ostium::data
