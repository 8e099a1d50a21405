/// Meshes survive writing and reading; invalid ones are refused.
#include "vascular/geometry/mesh/mesh.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "tests/vascular/geometry/shapes.h"
#include "vascular/geometry/mesh/surface_check.h"
#include "vascular/geometry/mesh_files/formats.h"
#include "vascular/geometry/mesh_files/open_end.h"
#include "vascular/geometry/mesh_files/rounding.h"
#include "vascular/geometry/mesh_files/written_mesh.h"

namespace ostium::vascular {
namespace {

std::string temporary(const std::string& name) {
  return (std::filesystem::path(testing::TempDir()) / ("ostium_" + std::to_string(getpid()) + "_" + name)).string();
}

std::string written(const std::string& name, const std::string& text) {
  const std::string path = temporary(name);
  std::ofstream(path) << text;
  return path;
}

std::string refusal(const std::string& path) {
  try {
    read_mesh(path, LengthUnit::millimetre);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

void write_mesh(const std::string& path, const Mesh& mesh, LengthUnit unit) {
  std::ofstream(path, std::ios::binary) << mesh_bytes(path, mesh, unit);
}

TEST(Mesh, VolumeAndAreaOfACube) {
  const Mesh cube = test::cube(0.02);
  EXPECT_NEAR(volume_m3(cube), 8e-6, 1e-18);
  EXPECT_NEAR(area_m2(cube), 6 * 4e-4, 1e-15);
}

TEST(Mesh, VolumeIsTheSameFarFromTheOrigin) {
  Mesh mesh = test::sphere(0.03, 24);
  const double volume = volume_m3(mesh);
  for (Eigen::Vector3d& p : mesh.vertices) p += Eigen::Vector3d(4000, -3000, 5000);
  // What is left is the rounding of the coordinates themselves, 1e-12 m.
  EXPECT_NEAR(volume_m3(mesh), volume, 1e-9 * volume);
  EXPECT_TRUE(check_surface(mesh).sound());
}

TEST(Mesh, RoundingIsThatOfTheFilesNumbers) {
  Mesh mesh = test::sphere(10, 16);
  EXPECT_LT(rounding_step(mesh), 1e-14);
  for (Eigen::Vector3d& p : mesh.vertices) p.x() += 4e6;
  mesh = test::in_single(mesh);
  EXPECT_EQ(rounding_step(mesh), 0.25);  // 24 bits for 2^21 to 2^22
  for (Eigen::Vector3d& p : mesh.vertices) p.x() -= 4e6;
  for (Eigen::Vector3d& p : mesh.vertices) p = (p * 100).array().round() / 100;
  EXPECT_NEAR(rounding_step(mesh), 0.01, 1e-12);
}

TEST(Mesh, EveryFormatBringsBackWhatWasWritten) {
  const Mesh sphere = test::sphere(0.01, 24);
  for (const char* name : {"a.obj", "a.stl", "a.ply"}) {
    write_mesh(temporary(name), sphere, LengthUnit::millimetre);
    const MeshFile back = read_mesh(temporary(name), LengthUnit::millimetre);
    EXPECT_EQ(back.mesh.vertices.size(), sphere.vertices.size()) << name;
    EXPECT_EQ(back.mesh.triangles.size(), sphere.triangles.size()) << name;
    EXPECT_EQ(back.dropped_triangles, 0) << name;
    // Single precision: 2^-24 relative.
    EXPECT_NEAR(volume_m3(back.mesh), volume_m3(sphere), 1e-6 * volume_m3(sphere)) << name;
  }
}

/// A corner of a cube, 90 mm, in the metres of glTF.
const std::string corner_gltf =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primi)"
    R"(tives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[{"bufferView":0,"componentType":51)"
    R"(26,"count":4,"type":"VEC3"},{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}],"buffe)"
    R"(rViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":24}],"buffers":[{"byt)"
    R"(eLength":72,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAA7FG4PQAAAAAAAAAAAAAAAOxRuD0A)"
    R"(AAAAAAAAAAAAAADsUbg9AAACAAEAAAABAAMAAQACAAMAAAADAAIA"}]})";

TEST(Mesh, GltfIsReadInItsMetres) {
  const Mesh mesh = read_mesh(written("corner.gltf", corner_gltf), LengthUnit::metre).mesh;
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_NEAR(volume_m3(mesh), 0.09 * 0.09 * 0.09 / 6, 1e-9);
}

TEST(Mesh, PartsOfGltfLieWhereTheirNodesPlaceThem) {
  const auto volume = [](const std::string& node) {
    std::string file = corner_gltf;
    file.replace(file.find(R"({"mesh":0})"), 10, node);
    const Mesh mesh = read_mesh(written("placed.gltf", file), LengthUnit::metre).mesh;
    return std::pair(volume_m3(mesh) / (0.09 * 0.09 * 0.09 / 6), mesh.vertices.size());
  };
  const auto [twice, corners] = volume(R"({"mesh":0,"scale":[2,1,1]})");
  EXPECT_NEAR(twice, 2, 1e-6);
  EXPECT_EQ(corners, 4u);
  EXPECT_NEAR(volume(R"({"mesh":0,"scale":[-1,1,1]})").first, 1, 1e-6) << "mirrored, and not inside out";
  const auto [both, eight] = volume(R"({"mesh":0,"children":[1]},{"mesh":0,"translation":[1,0,0],"scale":[1,1,-1]})");
  EXPECT_NEAR(both, 2, 1e-5);
  EXPECT_EQ(eight, 8u);
}

TEST(Mesh, WhatWasCutShortOrBrokenIsRefused) {
  const std::string ascii =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 1 2\n";
  EXPECT_NE(refusal(written("cut.ply", ascii)).find("5 of the 6 lines"), std::string::npos);
  EXPECT_EQ(refusal(written("whole.ply", ascii + "3 0 2 3\n")), "accepted");
  for (const char* name : {"utf16.ply", "utf16.stl", "utf16.obj"}) {  // of an STL it would be a binary header
    std::string wide = "\xFF\xFE";
    for (const char c : ascii) wide += c, wide += '\0';
    EXPECT_NE(refusal(written(name, wide)).find("is UTF-16; save it as UTF-8"), std::string::npos) << name;
  }
  EXPECT_NE(refusal(written("index.ply", ascii + "3 0 2 77\n")).find("vertex 77 of 4"), std::string::npos);
  EXPECT_NE(refusal(written("header.ply", ascii.substr(0, 60))).find("is cut short"), std::string::npos);
  // Binary formats, truncated anywhere.
  for (const char* name : {"binary.ply", "binary.stl"}) {
    write_mesh(temporary(name), test::sphere(0.01, 6), LengthUnit::millimetre);
    std::ifstream file(temporary(name), std::ios::binary);
    const std::string whole((std::istreambuf_iterator<char>(file)), {});
    EXPECT_EQ(refusal(temporary(name)), "accepted");
    for (double share : {0.01, 0.3, 0.6, 0.999}) {
      const std::string cut = whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size())));
      EXPECT_NE(refusal(written(std::string("cut_") + name, cut)), "accepted") << name << " " << share;
    }
  }
  EXPECT_NE(refusal(written("zero.stl", std::string(84, '\0'))), "accepted");
  for (std::size_t length : {0u, 40u, 300u, 500u})
    EXPECT_NE(refusal(written("cut.gltf", corner_gltf.substr(0, length))), "accepted");
  for (const char* broken : {"\"bufferView\":1", "\"POSITION\":0", "\"count\":4,"}) {
    std::string text = corner_gltf;
    const std::size_t at =
        text.find(broken) + std::string(broken).size() - (text.find(broken) == text.find("\"count") ? 2 : 1);
    text[at] = '9';
    EXPECT_NE(refusal(written("broken.gltf", text)), "accepted") << broken;
  }
}

/// What was cut within the last number is read as another face.
TEST(Mesh, ATextWhoseLastLineHasNoEndIsDoubted) {
  const std::string obj = "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 2 3";
  const std::string ply = "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n3 0 1 2";
  const auto doubted = [](const std::string& name, const std::string& text) {
    return doubt_of_mesh_end(written(name, text)).find("last number may have been cut") != std::string::npos;
  };
  for (const auto& [name, text] : {std::pair{"end.obj", obj},
                                   {"end.ply", ply},
                                   {"end.off", "OFF\n0 1 0\n3 0 1 2"},
                                   {"end.vtk", "# vtk DataFile Version 3.0\nx\nASCII\n3 0 1 2"}}) {
    EXPECT_TRUE(doubted(name, text)) << name;
    for (const char* whole : {"\n", "\r\n", " ", "\n# made by hand"})
      EXPECT_FALSE(doubted(name, text + std::string(whole)));
  }
  EXPECT_FALSE(doubted("binary.ply", "ply\nformat binary_little_endian 1.0\nend_header\n3 0 1 2"));
  EXPECT_FALSE(doubted("end.stl", "solid x\nendsolid x"));
  EXPECT_EQ(doubt_of_mesh_end(temporary("no-such.obj")), "");
}

TEST(Mesh, AFaceThatWouldBeLeftOutIsRefused) {
  const std::string points = "0 0 0\n9 0 0\n0 9 0\n0 0 9\n";
  const std::string off = "OFF\n4 2 0\n" + points + "3 0 1 2\n";
  EXPECT_EQ(refusal(written("whole.off", off + "3 0 2 3\n")), "accepted");
  EXPECT_NE(refusal(written("none.off", off + "0\n")).find("face 1 has 0 corners"), std::string::npos);
  EXPECT_NE(refusal(written("cut.off", off)).find("promises 2 faces, and 1 could be read"), std::string::npos);
  EXPECT_NE(refusal(written("index.off", off + "3 0 2 4\n")).find("face 1 names vertex 4 of 4"), std::string::npos);
  EXPECT_NE(refusal(written("flat.off", "OFF\n4 1 0\n0 0\n9 0 0\n0 9 0\n")).find("for a coordinate"),
            std::string::npos);
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n" +
      points + "3 0 1 2\n";
  EXPECT_NE(refusal(written("none.ply", ply + "0\n")).find("face 1 has no corners"), std::string::npos);
}

/// As tools for making tubes write it: two lids of forty corners, colours, comments, a normal behind each vertex.
TEST(Mesh, AnOFFHasFacesOfAnyNumberOfCorners) {
  constexpr int round = 40;
  std::string vertices, side, lids[2];
  for (int k = 0; k < round; ++k) {
    const double angle = 2 * std::numbers::pi * k / round;
    // The lid has dents, which a fan would fill.
    const double r = k % 2 ? 3 : 2;
    for (const int z : {0, 10})
      vertices += std::to_string(r * std::cos(angle)) + " " + std::to_string(r * std::sin(angle)) + " " +
                  std::to_string(z) + " 0 0 1\n";
    const int next = (k + 1) % round;
    side += "4 " + std::to_string(2 * k) + " " + std::to_string(2 * next) + " " + std::to_string(2 * next + 1) + " " +
            std::to_string(2 * k + 1) + " 255 0 0 # red\n";
    lids[0] = " " + std::to_string(2 * k) + lids[0], lids[1] += " " + std::to_string(2 * k + 1);
  }
  const std::string text = "# made by hand\nNOFF 80 42 0\r\n" + vertices + side + "40" + lids[0] + "\n40" + lids[1];
  const Mesh mesh = read_mesh(written("lids.off", text), LengthUnit::metre).mesh;
  const double star = 0.5 * round * 2 * 3 * std::sin(2 * std::numbers::pi / round);
  EXPECT_NEAR(volume_m3(mesh), 10 * star, 1e-3);
  double lid = 0;  // the area that looks up
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]], normal = (mesh.vertices[t[1]] - a).cross(mesh.vertices[t[2]] - a);
    if (a.z() > 9 && normal.norm() > 0 && normal.normalized().z() > 0.99) lid += normal.norm() / 2;
    EXPECT_GT(normal.z(), -1e-9 - 100 * (a.z() < 1)) << "a triangle of the upper lid looks down";
  }
  EXPECT_NEAR(lid, star, 1e-3);
}

TEST(Mesh, AnSTLMayBeInCapitals) {
  std::string text = "SOLID TUBE\n";
  const Mesh sphere = test::sphere(0.01, 6);
  for (const auto& t : sphere.triangles) {
    text += "FACET NORMAL 0 0 1\nOUTER LOOP\n";
    for (const int v : t)
      text += "VERTEX " + std::to_string(sphere.vertices[v].x()) + " " + std::to_string(sphere.vertices[v].y()) + " " +
              std::to_string(sphere.vertices[v].z()) + "E0\n";
    text += "ENDLOOP\nENDFACET\n";
  }
  EXPECT_EQ(read_mesh(written("capitals.stl", text + "ENDSOLID TUBE\n"), LengthUnit::metre).mesh.triangles.size(),
            sphere.triangles.size());
  EXPECT_NE(refusal(written("capitals.stl", text)).find("is cut short"), std::string::npos);
  // Some words of it, too.
  for (const std::string word : {"VERTEX", "ENDFACET", "ENDLOOP", "OUTER LOOP"}) {
    std::string some = text + "ENDSOLID TUBE\n";
    for (std::size_t at = 0; (at = some.find(word, at)) != std::string::npos; ++at)
      some.replace(at, word.size(), in_lower_case(word));
    EXPECT_EQ(read_mesh(written("capitals.stl", some), LengthUnit::metre).mesh.triangles.size(),
              sphere.triangles.size())
        << word;
  }
}

TEST(Mesh, ARefusalIsShortWhateverTheFileHolds) {
  const std::string stl = "solid a\n facet normal 0 0 1\n  outer loop\n   vertex \x1b[2J" + std::string(20000, 'x') +
                          "\n  endloop\n endfacet\nendsolid a\n";
  const std::string said = refusal(written("words.stl", stl));
  EXPECT_LT(said.size(), 1000u);
  EXPECT_EQ(said.find('\x1b'), std::string::npos);
}

TEST(Mesh, OnlyTheFormatsThatAreListedAreTried) {
  for (const char* name : {"a.blend", "a.assbin", "a.3mf", "a.zip", "a"})
    EXPECT_NE(refusal(written(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).find("names no format"), std::string::npos)
        << name;
}

TEST(Mesh, AsWrittenIsWhatAFileBringsBack) {
  Mesh mesh = test::sphere(0.0123456789, 8, {0.3, -0.1, 0.7});
  const std::string path = testing::TempDir() + "ostium_as_written.ply";
  write_mesh(path, mesh, LengthUnit::millimetre);
  const Mesh read = read_mesh(path, LengthUnit::millimetre).mesh, said = as_written(mesh, LengthUnit::millimetre);
  ASSERT_EQ(read.vertices.size(), said.vertices.size());
  for (std::size_t t = 0; t < said.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ((read.vertices[read.triangles[t][k]] - said.vertices[said.triangles[t][k]]).norm(), 0);
}

TEST(Mesh, UnitsAreThoseThatAreNamed) {
  write_mesh(temporary("unit.obj"), test::cube(0.02), LengthUnit::millimetre);
  EXPECT_NEAR(volume_m3(read_mesh(temporary("unit.obj"), LengthUnit::centimetre).mesh), 8e-3, 1e-9);
}

TEST(Mesh, CornersWithinTheToleranceBecomeOne) {
  // A tetrahedron whose corners are written slightly differently each time (0.0002 mm apart), and a sliver.
  const std::string path = written("weld.obj",
                                   "v 0 0 0\nv 0 10 0\nv 10 0 0\nv 0 0 10\nv 0.0002 0 0\nv 10 0.0002 0\n"
                                   "f 1 2 3\nf 5 3 4\nf 1 4 2\nf 6 2 4\nf 1 5 4\n");
  const MeshFile file = read_mesh(path, LengthUnit::millimetre);
  EXPECT_EQ(file.mesh.vertices.size(), 4u);
  EXPECT_EQ(file.mesh.triangles.size(), 4u);
  EXPECT_EQ(file.welded_vertices, 2);
  EXPECT_EQ(file.dropped_triangles, 1);
  EXPECT_NEAR(volume_m3(file.mesh), 1e-6 / 6, 1e-10);
}

TEST(Mesh, ASequenceKeepsItsVerticesWhereverTheyMove) {
  // In the second frame two vertices meet, which must not make them one.
  const std::string a = written("0.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const std::string b = written("1.obj", "v 0 0 0\nv 1 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  const std::vector<Mesh> frames = read_mesh_sequence({a, b}, LengthUnit::metre);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].vertices.size(), 4u);
  EXPECT_EQ(frames[1].vertices.size(), 4u);
  EXPECT_EQ(frames[0].triangles, frames[1].triangles);
  EXPECT_NEAR(volume_m3(frames[0]), 1.0 / 6, 1e-12);
  const std::string c = written("2.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_THROW(read_mesh_sequence({a, c}, LengthUnit::metre), MeshError);
}

TEST(Mesh, WhatIsNoSurfaceIsRefused) {
  EXPECT_NE(refusal("/nowhere.obj").find("there is no such file"), std::string::npos);
  EXPECT_NE(refusal(written("text.stl", "hello")).find("cannot be read as a mesh"), std::string::npos);
  EXPECT_NE(refusal(written("empty.obj", "v 0 0 0\nv 1 0 0\n")).find(".obj"), std::string::npos);
  EXPECT_EQ(
      read_mesh(written("line.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n"), LengthUnit::metre).skipped_faces,
      1);
  EXPECT_NE(refusal(written("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")).find("finite"), std::string::npos);
  EXPECT_THROW(mesh_bytes("a.docx", test::cube(1), LengthUnit::metre), MeshError);
}

}  // namespace
}  // namespace ostium::vascular
