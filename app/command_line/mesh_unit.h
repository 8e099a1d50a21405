#pragma once
/// The length unit of mesh files, for every command that reads some.
#include "vascular/geometry/repair/units.h"

namespace ostium::app {

struct MeshUnit {
  vascular::LengthUnit unit = vascular::LengthUnit::millimetre;
  enum class Source { option, file, size, none } source = Source::none;  ///< none: no unit makes a vessel of it
  std::string vessel;  ///< what its size is that of; empty: of no artery
  double extent_m = 0, calibre_m = 0;

  bool known() const { return source != Source::none; }
};
/// Throws MeshError where no unit makes a vessel of it.
void require_known(const std::string& file, const MeshUnit& unit);

/// Of `raw`: the files' numbers taken as metres, nothing welded. What the user said goes first ("auto": nothing), then
/// what the files say, then the size of the vessels: of a wall, of the lumen inside it. Throws MeshError if several
/// units are possible, if two files say different ones, or if it is longer than any body.
MeshUnit unit_of(const std::vector<std::string>& files, const vascular::Mesh& raw, const std::string& said);

/// "X,Y,Z" in the unit of the file that `mesh` (in metres) is of, in metres. Throws LoadError if it is no point, or
/// farther outside the mesh than a tenth of its size: nothing there is nearest to it.
Eigen::Vector3d point_of(const vascular::Mesh& mesh, vascular::LengthUnit unit, const std::string& text);

/// "mm, as you said".
std::string describe(const MeshUnit& unit);
/// For JSON: option, file, size or none.
std::string name_of(MeshUnit::Source source);

}  // namespace ostium::app
