/// Which units a mesh's numbers may have, by the size of its vessels, and by what its file says.
#include "vascular/geometry/repair/units.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "core/base/units.h"
#include "tests/vascular/geometry/bent_tube.h"
#include "tests/vascular/geometry/damage.h"
#include "vascular/geometry/implicit/contour.h"
#include "vascular/geometry/mesh_files/unit_mark.h"
#include "vascular/geometry/mesh_files/written_mesh.h"

namespace ostium::vascular {
namespace {

using units::mm;

std::string readings_of(const Mesh& mesh) {
  std::string all;
  for (const UnitReading& reading : unit_readings(vessel_size(mesh)))
    all += (all.empty() ? "" : " ") + name_of(reading.unit);
  return all;
}

TEST(LengthUnits, ATubesSizeIsMeasured) {
  // The chord of an arc of 90 over 80 mm, and the half widths of its ends; lids or not, in whatever unit.
  for (double scale : {1e-3, 1.0, 1e3})
    for (bool lids : {true, false}) {
      const VesselSize size = vessel_size(mesh_of(test::BentTube{90 * scale, 3 * scale, 80 * scale, lids}));
      EXPECT_NEAR(size.extent / scale, (80 + 1.5) * std::sin(90.0 / 80), 0.1);
      EXPECT_NEAR(size.wide / scale, 3, 0.06);  // a polygon of 32 corners, and chords that are askew where it bends
      EXPECT_NEAR(size.narrow / scale, 3, 0.06);
    }
}

TEST(LengthUnits, WhatIsPossibleIsListed) {
  const struct {
    test::BentTube tube;
    const char* readings;
  } cases[] = {{{90, 3, 80}, "mm"},       // 735 mm of 30 mm throughout are no aorta
               {{60, 5, 100}, "mm"},      // neither are 580 of 50
               {{50, 6.5, 100}, "mm"},    //
               {{40, 3.2, 60}, "mm cm"},  // a coronary artery, or 390 mm of aorta
               {{30, 1, 50}, "mm cm"},    // a side branch, or an artery of the leg
               {{0.05, 0.004, 0.1}, "m"}, {{2e5, 1e4, 1e6}, ""}, {{3, 3, 100}, ""}};  // as long as wide
  for (const auto& c : cases)
    for (bool lids : {true, false}) {
      test::BentTube tube = c.tube;
      tube.lids = lids;
      EXPECT_EQ(readings_of(mesh_of(tube)), c.readings) << tube.length << " " << tube.diameter << " " << lids;
    }
}

TEST(LengthUnits, TreesAreToldAndInchesAreListed) {
  const std::vector<Tube> aorta = {make_tube("aorta", -1,
                                             {{{0, 0, 0}, 15 * mm},
                                              {{-0.02, 0.1, 0}, 14 * mm},
                                              {{0.05, 0.1, -0.03}, 13 * mm},
                                              {{0.05, -0.3, -0.03}, 8 * mm}})};
  const std::vector<Tube> coronary = {
      make_tube("LAD", -1, {{{0, 0, 0}, 2.2 * mm}, {{0.03, 0, 0.03}, 1.8 * mm}, {{0.05, -0.09, 0.05}, 0.9 * mm}}),
      make_tube("LCx", 0,
                {{{0.01, 0, 0.01}, 1.8 * mm}, {{0.02, -0.04, -0.03}, 1.5 * mm}, {{0, -0.07, -0.05}, 1 * mm}})};
  const ContourSettings coarse{.cell_at_1_mm_m = 2 * mm, .finest_m = 0.6 * mm, .relaxations = 0};
  for (const std::vector<Tube>* tubes : {&aorta, &coronary}) {
    const Mesh mesh = contour(TubeUnion(*tubes), coarse).mesh;
    for (LengthUnit unit : {LengthUnit::metre, LengthUnit::centimetre, LengthUnit::millimetre, LengthUnit::inch}) {
      const std::string found = " " + readings_of(test::scaled(mesh, 1 / metres(unit))) + " ";
      EXPECT_NE(found.find(" " + name_of(unit) + " "), std::string::npos) << name_of(unit) << " is not among" << found;
      if (unit == LengthUnit::millimetre || unit == LengthUnit::metre) {
        EXPECT_EQ(found, " " + name_of(unit) + " ");
      }
    }
  }
}

class UnitMark : public testing::TestWithParam<const char*> {
 protected:
  std::string path_ = testing::TempDir() + "unit-" + std::to_string(getpid()) + GetParam();
  void TearDown() override { std::remove(path_.c_str()); }
  void write(const std::string& bytes) { std::ofstream(path_, std::ios::binary) << bytes; }
};

TEST_P(UnitMark, WhatIsWrittenHereSaysItsUnit) {
  const Mesh mesh = mesh_of(test::BentTube{0.04, 0.003, 0.06});
  for (LengthUnit unit : length_units) {
    write(mesh_bytes(path_, mesh, unit));
    ASSERT_EQ(unit_mark_of(path_), unit);
    const Mesh read = read_mesh(path_, unit).mesh, said = as_written(mesh, unit);
    EXPECT_EQ(read.triangles.size(), said.triangles.size());
    EXPECT_NEAR(volume_m3(read), volume_m3(said), 1e-6 * volume_m3(said));
  }
}

TEST_P(UnitMark, OthersSayNone) {
  write("nothing\n");
  EXPECT_EQ(unit_mark_of(path_), std::nullopt);
  std::remove(path_.c_str());
  EXPECT_EQ(unit_mark_of(path_), std::nullopt);
}

/// As 3D Slicer writes them.
TEST_P(UnitMark, AxesStandBesideTheUnit) {
  const std::string path = path_, sign = path.ends_with(".ply")   ? "ply\nformat ascii 1.0\ncomment "
                                         : path.ends_with(".obj") ? "# "
                                                                  : "";
  for (const std::string axes : {"LPS", "RAS"}) {
    write(sign + "3D Slicer output. SPACE=" + axes + "\nend_header\n");
    EXPECT_EQ(axes_mark_of(path_), axes);
  }
  for (const char* other : {"3D Slicer output.\n", "SPACE=XYZ\n", "SPACE = LPS\n"}) {
    write(sign + other);
    EXPECT_EQ(axes_mark_of(path_), std::nullopt) << other;
  }
}

TEST(LengthUnits, AxesOfVTKAreInItsTitle) {
  const std::string path = testing::TempDir() + "title_" + std::to_string(getpid()) + ".vtk";
  std::ofstream(path) << "# vtk DataFile Version 4.2\n3D Slicer output. SPACE=RAS\nASCII\n";
  EXPECT_EQ(axes_mark_of(path), "RAS");
  std::ofstream(path) << "# vtk DataFile Version 4.2\nvtk output\nSPACE=RAS\n";
  EXPECT_EQ(axes_mark_of(path), std::nullopt);
  std::remove(path.c_str());
}

/// A text is its bytes, the last of them zero; 3D Slicer writes it compressed and appended unless told otherwise.
TEST(LengthUnits, AxesOfVTKsXMLAreAField) {
  const std::string path = testing::TempDir() + "field_" + std::to_string(getpid()) + ".vtp";
  const auto said = [&](const std::string& field, const std::string& attributes = "", const std::string& after = "") {
    std::ofstream(path) << "<VTKFile type=\"PolyData\" byte_order=\"LittleEndian\" header_type=\"UInt32\"" << attributes
                        << "><PolyData><FieldData>" << field << "</FieldData><Piece NumberOfPoints=\"0\"/></PolyData>"
                        << after << "</VTKFile>";
    return axes_mark_of(path);
  };
  EXPECT_EQ(said(R"(<Array type="String" Name="SPACE" NumberOfTuples="1" format="ascii">76 80 83 0</Array>)"), "LPS");
  EXPECT_EQ(said(R"(<Array type="String" Name="SPACE" NumberOfTuples="1" format="binary">BAAAAFJBUwA=</Array>)"),
            "RAS");
  // "RAS" and a zero by zlib: one block of 32768 bytes, the last of 4, of 12 compressed; in base64
  EXPECT_EQ(said(R"(<Array type="String" Name="SPACE" NumberOfTuples="1" format="appended" offset="0"/>)",
                 " compressor=\"vtkZLibDataCompressor\"",
                 R"(<AppendedData encoding="base64">_AQAAAACAAAAEAAAADAAAAA==eJwLcgxmAAACtQDn</AppendedData>)"),
            "RAS");
  EXPECT_EQ(said(R"(<Array type="String" Name="SPACE" NumberOfTuples="1" format="ascii">88 89 90 0</Array>)"),
            std::nullopt);
  EXPECT_EQ(said(""), std::nullopt);
  EXPECT_THROW(said(R"(<Array type="String" Name="SPACE" NumberOfTuples="1" format="appended" offset="0"/>)"),
               MeshError);
  std::remove(path.c_str());
}

INSTANTIATE_TEST_SUITE_P(LengthUnits, UnitMark, testing::Values(".ply", ".obj", ".stl"));

}  // namespace
}  // namespace ostium::vascular
