/// Files are read apart as they are here, and whatever becomes of the reader, the file is named and nothing else ends.
#include "app/reader/read_apart.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "app/reader/surface_bytes.h"
#include "data/formats/load_error.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::app {
namespace {

namespace fs = std::filesystem;

/// A file in a folder of this test's own.
std::string written(const std::string& name, const std::string& text) {
  const fs::path folder = fs::path(testing::TempDir()) / ("ostium-apart-" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / name, std::ios::binary) << text;
  return (folder / name).string();
}

/// A reader that does what a shell's line says.
std::string reader(const std::string& line) {
  const std::string path = written("reader", "#!/bin/sh\n" + line + "\n");
  fs::permissions(path, fs::perms::owner_all);
  return path;
}

std::string refusal(const ReaderCall& call, const std::string& file) {
  try {
    read_apart(call, file);
  } catch (const data::LoadError& error) {
    return error.what();
  }
  return "accepted";
}

ReaderCall by(const std::string& line, unsigned seconds = 20) {
  return {"mesh", "expected another", {seconds}, line.empty() ? OSTIUM_READER : reader(line)};
}

const std::string tetrahedron = "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nl 1 2\n";

TEST(ReadApart, AMeshIsThatWhichIsReadHere) {
  const std::string file = written("whole.obj", tetrahedron);
  const vascular::RawSurface here = vascular::read_surface(file), apart = surface_of(read_apart(by(""), file), file);
  ASSERT_EQ(apart.corners.size(), 12u);
  EXPECT_EQ(apart.corners, here.corners);
  EXPECT_EQ(apart.skipped, 1);
}

TEST(ReadApart, ARefusalIsThatWhichIsSaidHere) {
  for (const std::string& file :
       {written("none.obj", "v 0 0 0\n"), written("thing.docx", "x"), std::string("/nowhere")}) {
    std::string here = "accepted";
    try {
      vascular::read_surface(file);
    } catch (const vascular::MeshError& error) {
      here = error.what();
    }
    EXPECT_EQ(refusal(by(""), file), here);
    EXPECT_EQ(here.find(file), 0u);
  }
}

TEST(ReadApart, ADeathNamesTheFileTheSignalAndTheCure) {
  EXPECT_EQ(refusal(by("kill -SEGV $$"), "a.fbx"),
            "a.fbx: is damaged: what reads such files was ended by signal 11 (Segmentation fault); expected another");
  EXPECT_EQ(refusal(by("kill -XCPU $$"), "a.fbx"), "a.fbx: takes longer than 20 s to read; expected another");
  EXPECT_EQ(refusal(by("exit 7"), "a.fbx"),
            "a.fbx: could not be read (its reader ended with code 7); expected another");
  EXPECT_EQ(refusal(by("printf \"$3: no\"; exit 3"), "a.fbx"), "a.fbx: no");
  EXPECT_EQ(refusal(by("head -c 9999 /dev/zero | tr '\\0' x; exit 3"), "a.fbx").size(), 4096u);
  ReaderCall missing = by("");
  missing.program = "/nowhere/ostium-reader";
  EXPECT_EQ(refusal(missing, "a.fbx").find("/nowhere/ostium-reader: cannot be run"), 0u);
}

TEST(ReadApart, WhatDoesNotEndIsEnded) {
  const auto before = std::chrono::steady_clock::now();
  EXPECT_EQ(refusal(by("exec sleep 30", 1), "a.dae"), "a.dae: takes longer than 1 s to read; expected another");
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(15));
}

TEST(ReadApart, AReaderMayTakeLittleMemory) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "a sanitizer takes all addresses, so the reader has no limit";
#endif
  std::string file = written("large.stl", "");
  std::ofstream stl(file, std::ios::binary);
  stl << std::string(80, ' ') << std::string("\0\0\0\1", 4);  // 2^24 triangles, little-endian
  stl.close();
  fs::resize_file(file, 84 + 50ull * (1u << 24));  // a hole, which takes no room on the disk
  const std::string said = refusal(by(""), file);
  EXPECT_EQ(said.find(file), 0u) << said;
  EXPECT_NE(said.find("memory"), std::string::npos) << said;
  fs::remove(file);
}

TEST(ReadApart, BytesOfASurfaceAreTakenWholeOrNotAtAll) {
  vascular::RawSurface surface;
  surface.corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  surface.skipped = 4;
  char* bytes = nullptr;
  std::size_t size = 0;
  std::FILE* memory = open_memstream(&bytes, &size);
  ASSERT_TRUE(write_surface(surface, memory));
  std::fclose(memory);
  const std::string whole(bytes, size);
  std::free(bytes);
  EXPECT_EQ(surface_of(whole, "a").corners, surface.corners);
  EXPECT_EQ(surface_of(whole, "a").skipped, 4);
  for (std::size_t length = 0; length < size; ++length)
    EXPECT_THROW(surface_of(whole.substr(0, length), "a"), data::LoadError) << length;
  EXPECT_THROW(surface_of(whole + "x", "a"), data::LoadError);
  std::string other = whole;
  other[0] = 'x';
  EXPECT_THROW(surface_of(other, "a"), data::LoadError);
}

TEST(ReadApart, NoFileOutsideOfItsFolderIsOpened) {
  const std::string secret = written("secret.bin", std::string(72, 'x'));
  const std::string folder = fs::path(secret).parent_path() / "mesh";
  fs::create_directories(folder);
  const auto refusal_here = [&](const std::string& name, const std::string& text) {
    return refusal(by(""), written("mesh/" + name, text));
  };
  const std::string gltf =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{)"
      R"("attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"}],)"
      R"("bufferViews":[{"buffer":0,"byteLength":72}],"buffers":[{"byteLength":72,"uri":"NAME"}]})";
  const auto of = [](std::string text, const std::string& name) { return text.replace(text.find("NAME"), 4, name); };
  fs::copy_file(secret, folder + "/beside.bin", fs::copy_options::overwrite_existing);
  EXPECT_EQ(refusal_here("a.gltf", of(gltf, "beside.bin")), "accepted");
  for (const std::string& name : {std::string("../secret.bin"), std::string("x/../../secret.bin")})
    EXPECT_NE(refusal_here("a.gltf", of(gltf, name)).find("does not lie in its folder"), std::string::npos) << name;
  fs::create_symlink(secret, folder + "/link.bin");
  EXPECT_NE(refusal_here("a.gltf", of(gltf, "link.bin")).find("does not lie in its folder"), std::string::npos);
  for (const std::string& name : {secret, std::string("../../x.mtl")})
    EXPECT_NE(refusal_here("a.obj", "mtllib " + name + "\n" + tetrahedron).find("does not lie in its folder"),
              std::string::npos)
        << name;
  EXPECT_EQ(refusal_here("a.obj", "mtllib none.mtl\n" + tetrahedron), "accepted");
}

}  // namespace
}  // namespace ostium::app
