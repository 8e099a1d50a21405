/// VTK's surfaces are read in every encoding, and what was cut or damaged is refused, in other formats as well.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/vascular/geometry/shapes.h"
#include "tests/vascular/geometry/vtk_files.h"
#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::vascular {
namespace {

std::string as_file(const std::string& name, const std::string& bytes) {
  const std::string path =
      (std::filesystem::path(testing::TempDir()) / ("ostium_" + std::to_string(getpid()) + "_" + name)).string();
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string refusal(const std::string& name, const std::string& bytes) {
  const std::string path = as_file(name, bytes);
  try {
    read_mesh(path, LengthUnit::millimetre);
  } catch (const MeshError& error) {
    EXPECT_EQ(std::string(error.what()).find(path), 0u) << error.what();
    return error.what();
  }
  return "accepted";
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), with);
}

testing::AssertionResult says(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos
             ? testing::AssertionSuccess()
             : testing::AssertionFailure() << "\"" << message << "\" does not say \"" << part << "\"";
}

/// The corners are exact, and volume and area are those of a cube only if all faces are there and face outwards.
void expect_cube(const std::string& path) {
  const MeshFile file = read_mesh(path, LengthUnit::millimetre);
  const double edge = 1e-3 * test::vtk_edge;
  ASSERT_EQ(file.mesh.vertices.size(), 8u);
  EXPECT_EQ(file.mesh.triangles.size(), 12u);
  EXPECT_EQ(file.skipped_faces, 2);
  EXPECT_EQ(file.dropped_triangles, 0);
  for (const Eigen::Vector3d& p : file.mesh.vertices)
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(p[k] == 0 || p[k] == edge) << p.transpose();
  // Rounding only: a dozen terms of about 1e-6 m3 and 1e-4 m2.
  EXPECT_NEAR(volume_m3(file.mesh), edge * edge * edge, 1e-20);
  EXPECT_NEAR(area_m2(file.mesh), 6 * edge * edge, 1e-17);
}

std::vector<test::VtkEncoding> encodings() {
  std::vector<test::VtkEncoding> all;
  for (const bool wide : {false, true}) {
    all.push_back({.wide = wide});
    for (const bool zlib : {false, true})
      for (const bool big : {false, true}) {
        all.push_back({"binary", false, zlib, big, wide});
        all.push_back({"appended", false, zlib, big, wide});
        all.push_back({"appended", true, zlib, big, wide});
      }
  }
  return all;
}

TEST(Vtk, XmlIsReadInEveryEncoding) {
  for (const test::VtkEncoding& e : encodings()) {
    SCOPED_TRACE(e.format + (e.base64 ? " base64" : "") + (e.zlib ? " zlib" : "") + (e.big_endian ? " big" : "") +
                 (e.wide ? " 64" : " 32"));
    expect_cube(as_file("cube.vtp", test::vtp(e)));
    expect_cube(as_file("cube.vtu", test::vtu(e)));
  }
}

TEST(Vtk, LegacyFilesAreReadInEveryVersion) {
  for (const char* version : {"2.0", "3.0", "4.2", "5.1"})
    for (const bool binary : {false, true})
      for (const bool grid : {false, true}) {
        SCOPED_TRACE(std::string(version) + (binary ? " binary" : " ascii") + (grid ? " grid" : " polydata"));
        expect_cube(as_file("cube.vtk", test::VtkLegacyWriter(binary, version).file(grid)));
      }
}

TEST(Vtk, EndingsInUpperCaseAreTheSame) {
  expect_cube(as_file("CUBE.VTP", test::vtp({})));
  const Mesh sphere = test::sphere(0.01, 6);
  for (const std::string name : {"S.STL", "S.PLY", "S.Obj"}) {
    const std::string path = as_file(name, "");
    std::ofstream(path, std::ios::binary) << mesh_bytes(path, sphere, LengthUnit::millimetre);
    EXPECT_EQ(read_mesh(path, LengthUnit::millimetre).mesh.triangles.size(), sphere.triangles.size()) << name;
    EXPECT_TRUE(has_mesh_ending(path));
  }
}

TEST(Vtk, AFileCutAnywhereIsRefusedOrWhole) {
  // Behind the surface stands only what is not read, so there a cut does no harm.
  std::vector<std::pair<std::string, std::string>> files;
  for (const test::VtkEncoding& e : encodings()) files.emplace_back("cut.vtp", test::vtp(e));
  for (const char* version : {"2.0", "5.1"})
    for (const bool binary : {false, true})
      files.emplace_back("cut.vtk", test::VtkLegacyWriter(binary, version).file(true));
  for (const auto& [name, text] : files)
    for (std::size_t length = 0; length < text.size(); length += 31) {
      const std::string answer = refusal(name, text.substr(0, length));
      if (answer == "accepted") expect_cube(as_file(name, text.substr(0, length)));
    }
}

TEST(Vtk, PromisesThatTheFileCannotHoldAreRefused) {
  const std::string huge = "1000000000000000000", xml = test::vtp({}), grid = test::vtu({});
  EXPECT_TRUE(says(refusal("a.vtp", replaced(xml, "NumberOfPoints=\"8\"", "NumberOfPoints=\"" + huge + "\"")),
                   huge + " points"));
  EXPECT_TRUE(says(refusal("a.vtp", replaced(xml, "NumberOfPolys=\"3\"", "NumberOfPolys=\"" + huge + "\"")), huge));
  EXPECT_TRUE(says(refusal("a.vtu", replaced(grid, "NumberOfCells=\"6\"", "NumberOfCells=\"-6\"")), "whole number"));
  const std::string legacy = test::VtkLegacyWriter(true, "4.2").file(false);
  EXPECT_TRUE(says(refusal("a.vtk", replaced(legacy, "POINTS 8", "POINTS " + huge)), "cut short"));
  EXPECT_TRUE(says(refusal("a.vtk", replaced(legacy, "POLYGONS 3", "POLYGONS " + huge)), "cut short"));
  // The first array's header: its length, or the number of its blocks.
  for (test::VtkEncoding e : encodings()) {
    if (e.format != "appended" || e.base64) continue;
    std::string text = test::vtp(e);
    const std::size_t header = text.find('_', text.find("<AppendedData")) + 1;
    for (std::size_t k = 0; k < (e.wide ? 8u : 4u); ++k) text[header + k] = '\x7f';
    EXPECT_TRUE(says(refusal("a.vtp", text), "cut short"));
  }
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex " + huge +
                          "\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n";
  EXPECT_TRUE(says(refusal("a.ply", ply), huge));
  EXPECT_TRUE(says(refusal("a.off", "OFF\n4000000000 1 0\n0 0 0\n3 0 0 0\n"), "4000000000"));
}

TEST(Vtk, WhatIsNoSurfaceIsRefusedWithACure) {
  const std::string xml = test::vtp({}), legacy = test::VtkLegacyWriter(false, "4.2").file(true);
  EXPECT_TRUE(says(refusal("a.vtu", test::vtu({}, {5, 5, 10, 6, 1, 3})), "extract it"));
  EXPECT_TRUE(says(refusal("a.vtk", replaced(legacy, "5 5 9", "5 5 10")), "extract it"));
  EXPECT_TRUE(says(refusal("a.vtu", test::vtu({}, {22, 5, 9, 6, 1, 3})), "curved"));
  EXPECT_TRUE(says(refusal("a.vtu", test::vtu({}, {1, 1, 2, 4, 1, 3})), "6 points or lines"));
  EXPECT_TRUE(says(refusal("a.vtp", replaced(xml, "1\n2\n3\n4\n5\n7", "1\n2\n3\n4\n5\n8")), "point 8 of 8"));
  EXPECT_TRUE(says(refusal("a.vtp", replaced(xml, "10.250000", "nan")), "nan"));
  EXPECT_TRUE(says(refusal("a.vtp", replaced(xml, "10.250000", "1o.25")), "1o.25"));
  EXPECT_TRUE(says(refusal("a.vtp", replaced(xml, "PolyData", "ImageData")), "VTK's ImageData"));
  EXPECT_TRUE(says(refusal("a.vtk", replaced(legacy, "UNSTRUCTURED_GRID", "STRUCTURED_POINTS")), "structured_points"));
  const std::string lz4 = replaced(test::vtp({.format = "binary", .zlib = true}), "vtkZLib", "vtkLZ4");
  EXPECT_TRUE(says(refusal("a.vtp", lz4), "vtkLZ4DataCompressor"));
}

TEST(Vtk, AFormatThatIsNotReadIsRefusedWithThoseThatAre) {
  for (const char* name : {"a.docx", "a.mrk.json", "a.vti", "a.nrrd"}) {
    const std::string answer = refusal(name, "hello");
    EXPECT_TRUE(says(answer, ".stl, .ply, .obj, .vtp, .vtu, .vtk"));
  }
}

TEST(Stl, SaysWhatIsMissing) {
  std::string text = "solid a\n";
  for (const char* corners : {"0 0 0 0 1 0 1 0 0", "0 0 0 1 0 0 0 0 1", "0 0 0 0 0 1 0 1 0", "1 0 0 0 1 0 0 0 1"}) {
    std::istringstream numbers(corners);
    text += "facet normal 0 0 0\nouter loop\n";
    for (double x, y, z; numbers >> x >> y >> z;)
      text += "vertex " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    text += "endloop\nendfacet\n";
  }
  EXPECT_EQ(refusal("a.stl", text + "endsolid a\n"), "accepted");
  EXPECT_TRUE(says(refusal("a.stl", text), "cut short: no \"endsolid\" stands after its 4 whole facets"));

  const std::string path = as_file("b.stl", "");
  std::ofstream(path, std::ios::binary) << mesh_bytes(path, test::cube(0.01), LengthUnit::millimetre);
  std::ifstream file(path, std::ios::binary);
  const std::string binary((std::istreambuf_iterator<char>(file)), {});
  EXPECT_TRUE(says(refusal("b.stl", binary.substr(0, 84 + 5 * 50 + 7)), "promises 12 triangles, and 5 are there"));
  EXPECT_TRUE(says(refusal("b.stl", binary + "more"), "promises 12 triangles, and 12 and 4 more bytes"));
}

}  // namespace
}  // namespace ostium::vascular
