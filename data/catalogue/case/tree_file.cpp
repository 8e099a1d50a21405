#include "data/catalogue/case/tree_file.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/units.h"
#include "data/catalogue/case/tree_keys.h"
#include "data/formats/json/json_object.h"
#include "data/formats/write_file.h"
#include "vascular/geometry/mesh/patient_frame.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::data {

namespace {

using units::mm;

vascular::TreeSphere read_sphere(const JsonValue& value, const vascular::TreeBranch& branch) {
  const std::string expected = "[x, y, z, radius] in mm, radius > 0";
  if (value.type != JsonValue::Type::array || value.items.size() != 4) value.refuse(expected);
  for (const JsonValue& item : value.items)
    if (item.type != JsonValue::Type::number) value.refuse(expected);
  vascular::TreeSphere sphere;
  sphere.p = mm * Eigen::Vector3d(value.items[0].number, value.items[1].number, value.items[2].number);
  sphere.radius_m = mm * value.items[3].number;
  if (!(sphere.radius_m > 0)) value.refuse(expected);
  if (!branch.spheres.empty()) sphere.s_m = branch.spheres.back().s_m + (sphere.p - branch.spheres.back().p).norm();
  return sphere;
}

vascular::TreeBranch read_branch(const JsonValue& value, const vascular::SphereTree& before) {
  const JsonObject object(value, tree_keys::branch);
  vascular::TreeBranch branch{.name = object.text("name"), .spheres = {}};
  branch.parent = object.whole("parent");
  branch.parent_sphere = object.whole("parent_sphere");
  if (branch.parent < -1 || branch.parent >= static_cast<int>(before.branches.size())) object.refuse("parent");
  const int spheres =
      branch.parent < 0 ? 0 : static_cast<int>(before.branches[static_cast<std::size_t>(branch.parent)].spheres.size());
  if (branch.parent < 0 ? branch.parent_sphere != -1 : branch.parent_sphere < 0 || branch.parent_sphere >= spheres)
    object.refuse("parent_sphere");
  for (const JsonValue& sphere : object.list("spheres")) branch.spheres.push_back(read_sphere(sphere, branch));
  if (branch.spheres.empty()) object.refuse("spheres");
  return branch;
}

vascular::SphereTree tree_of(const JsonValue& file) {
  const JsonObject root(file, tree_keys::tree);
  if (root.text("schema") != "ostium-tree/1") root.refuse("schema");
  vascular::SphereTree tree;
  for (const JsonValue& branch : root.list("branches")) tree.branches.push_back(read_branch(branch, tree));
  return tree;
}

std::string data_array(const char* type, const char* name, const std::string& values, const char* more = "") {
  return fmt::format("<DataArray type=\"{}\"{}{}{} format=\"ascii\">\n{}</DataArray>\n", type, *name ? " Name=\"" : "",
                     name, *name ? std::string("\"") + more : more, values);
}

}  // namespace

vascular::SphereTree read_tree(const std::string& file, const std::string& text) {
  return tree_of(parse_json(file, text));
}
vascular::SphereTree load_tree(const std::string& file) { return tree_of(load_json(file)); }

std::string tree_to_json(const vascular::SphereTree& tree) {
  std::string text = "{\n\"schema\": \"ostium-tree/1\",\n\"branches\": [";
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    const vascular::TreeBranch& branch = tree.branches[b];
    text += fmt::format("{}\n{{ \"name\": \"{}\", \"parent\": {}, \"parent_sphere\": {}, \"spheres\": [", b ? "," : "",
                        branch.name, branch.parent, branch.parent_sphere);
    for (std::size_t i = 0; i < branch.spheres.size(); ++i) {
      const Eigen::Vector3d p = vascular::mm_from_patient(branch.spheres[i].p);
      text += fmt::format("{}\n[{:.4f}, {:.4f}, {:.4f}, {:.4f}]", i ? "," : "", p.x(), p.y(), p.z(),
                          branch.spheres[i].radius_m / mm);
    }
    text += "] }";
  }
  return text + "\n]\n}\n";
}

std::string tree_to_vtp(const vascular::SphereTree& tree, std::optional<vascular::LengthUnit> own_unit) {
  const double unit_m = own_unit ? metres(*own_unit) : mm;
  const int digits = own_unit ? 4 + static_cast<int>(std::lround(std::log10(unit_m / mm))) : 4;
  std::string points, radii, connectivity, offsets, ids, parents, names;
  std::size_t count = 0, lines = 0;
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    const vascular::TreeBranch& branch = tree.branches[b];
    std::vector<vascular::TreeSphere> line = branch.spheres;
    if (branch.parent >= 0)
      line.insert(line.begin(), tree.branches[static_cast<std::size_t>(branch.parent)]
                                    .spheres[static_cast<std::size_t>(branch.parent_sphere)]);
    for (const vascular::TreeSphere& sphere : line) {
      const Eigen::Vector3d p = own_unit ? Eigen::Vector3d(sphere.p / unit_m) : vascular::lps_mm_from_patient(sphere.p);
      points += fmt::format("{0:.{3}f} {1:.{3}f} {2:.{3}f}\n", p.x(), p.y(), p.z(), digits);
      radii += fmt::format("{:.{}f}\n", sphere.radius_m / unit_m, digits);
      connectivity += fmt::format("{}\n", count++);
    }
    offsets += fmt::format("{}\n", count);
    ids += fmt::format("{}\n", b);
    parents += fmt::format("{}\n", branch.parent);
    for (char c : branch.name) names += fmt::format("{} ", static_cast<int>(c));
    names += "0\n";
    ++lines;
  }
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<PolyData>\n"
         "<FieldData>\n" +
         data_array("String", "BranchNames", names, fmt::format(" NumberOfTuples=\"{}\"", lines).c_str()) +
         "</FieldData>\n" +
         fmt::format(
             "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"{}\" NumberOfStrips=\"0\" "
             "NumberOfPolys=\"0\">\n",
             count, lines) +
         "<PointData Scalars=\"MaximumInscribedSphereRadius\">\n" +
         data_array("Float32", "MaximumInscribedSphereRadius", radii) + "</PointData>\n<CellData>\n" +
         data_array("Int32", "BranchId", ids) + data_array("Int32", "ParentId", parents) + "</CellData>\n<Points>\n" +
         data_array("Float64", "", points, " NumberOfComponents=\"3\"") + "</Points>\n<Lines>\n" +
         data_array("Int32", "connectivity", connectivity) + data_array("Int32", "offsets", offsets) +
         "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

bool writes_tree_as_json(const std::string& file) {
  const std::string ending = vascular::ending_of(file);
  if (ending != ".json" && ending != ".vtp")
    throw LoadError(
        fmt::format("{}: the ending \"{}\" names no format of a tree; expected .json or .vtp", file, ending));
  return ending == ".json";
}

void write_tree(const std::string& file, const vascular::SphereTree& tree,
                std::optional<vascular::LengthUnit> own_unit) {
  write_file(file, writes_tree_as_json(file) ? tree_to_json(tree) : tree_to_vtp(tree, own_unit));
}

}  // namespace ostium::data
