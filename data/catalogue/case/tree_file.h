#pragma once
/// The centreline-sphere tree in files: JSON (data/schemas/tree.schema.json; the tree's own axes, mm), and VTK polydata
/// for VMTK and 3D Slicer.
#include <optional>
#include <string>

#include "vascular/geometry/centreline/sphere_tree.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::data {

/// The format of a name's ending: .json, or else .vtp. Throws LoadError for any other, so that a command can refuse it
/// before it begins to work.
bool writes_tree_as_json(const std::string& file);
/// `own_unit`: see tree_to_vtp. Throws LoadError as above, WriteError.
void write_tree(const std::string& file, const vascular::SphereTree& tree,
                std::optional<vascular::LengthUnit> own_unit = {});

/// .json only. Throws LoadError with file, line and what was expected.
vascular::SphereTree load_tree(const std::string& file);
vascular::SphereTree read_tree(const std::string& file, const std::string& text);

std::string tree_to_json(const vascular::SphereTree& tree);
/// One polyline per branch, with point data "MaximumInscribedSphereRadius" (VMTK's name) and cell data "BranchId",
/// "ParentId"; the names are in field data "BranchNames". A branch's line begins at its parent's sphere. The tree of a
/// patient goes from frame P to LPS, mm; that of somebody's mesh keeps its axes, in `own_unit`, and so fits the mesh.
std::string tree_to_vtp(const vascular::SphereTree& tree, std::optional<vascular::LengthUnit> own_unit = {});

}  // namespace ostium::data
