/// Files appear whole or not at all, whatever their format.
#include "data/formats/write_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <sstream>

#include "data/catalogue/case/tree_file.h"
#include "data/formats/dicom/dicom.h"
#include "data/formats/mesh_writer.h"
#include "data/formats/png.h"
#include "data/formats/svg.h"
#include "data/formats/video.h"

namespace ostium::data {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::stringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// No file of this process grows beyond so many bytes, as on a disk that is full: writes fail with EFBIG.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

struct Written {
  std::string file;
  std::function<void(const std::string& path)> write;
};

std::vector<Written> writers() {
  fluoro::Picture picture;
  picture.width = picture.height = 64;
  std::mt19937 noise(1);  // so that no compression makes it small
  for (int i = 0; i < 64 * 64; ++i) picture.grey.push_back(static_cast<std::uint8_t>(noise()));
  vascular::Mesh mesh;
  for (int i = 0; i < 300; ++i) mesh.vertices.emplace_back(1e-3 * i, 1e-3 * (i % 7), 1e-3 * (i % 11));
  for (int i = 0; i + 2 < 300; ++i) mesh.triangles.push_back({i, i + 1, i + 2});
  Drawing drawing(100, 100);
  for (int i = 0; i < 200; ++i) drawing.text({1.0 * i, 2}, "words");
  vascular::SphereTree tree;
  tree.branches.resize(1);
  for (int i = 0; i < 200; ++i) tree.branches[0].spheres.push_back({{1e-3 * i, 0, 0}, 1e-3, 1e-3 * i});
  fluoro::CineRun run;
  run.view.pixels = 64, run.programme = fluoro::cine(15), run.frames = {picture, picture};
  const auto mesh_writer = [mesh](const std::string& path) {
    write_mesh(path, mesh, vascular::LengthUnit::millimetre);
  };
  return {{"a.txt", [](const std::string& path) { write_file(path, std::string(10'000, 'x')); }},
          {"a.png", [picture](const std::string& path) { write_png(path, picture); }},
          {"a.dcm", [run](const std::string& path) { write_dicom(path, run); }},
          {"a.svg", [drawing](const std::string& path) { drawing.write(path); }},
          {"a.json", [tree](const std::string& path) { write_tree(path, tree); }},
          {"a.vtp", [tree](const std::string& path) { write_tree(path, tree); }},
          {"a.obj", mesh_writer},
          {"a.stl", mesh_writer},
          {"a.ply", mesh_writer}};
}

class WriteFile : public testing::Test {
 protected:
  WriteFile() { fs::create_directories(folder_); }
  ~WriteFile() override { fs::remove_all(folder_); }
  std::string in(const std::string& name) const { return (folder_ / name).string(); }
  int files() const { return static_cast<int>(std::distance(fs::directory_iterator(folder_), {})); }

 private:
  fs::path folder_ = fs::temp_directory_path() / ("ostium-write-" + std::to_string(getpid()));
};

TEST_F(WriteFile, OnAFullDiskWhatWasThereStays) {
  for (const Written& w : writers()) {
    std::ofstream(in(w.file)) << "before";
    {
      const FullDisk full(1000);
      EXPECT_THROW(w.write(in(w.file)), WriteError) << w.file;
    }
    EXPECT_EQ(text_of(in(w.file)), "before") << w.file;
    EXPECT_EQ(files(), 1) << w.file << ": nothing is left beside it";
    w.write(in(w.file));
    EXPECT_GT(fs::file_size(in(w.file)), 1000u) << w.file;
    EXPECT_EQ(files(), 1) << w.file;
    fs::remove(in(w.file));
  }
}

bool film_of_noise(const std::string& file) {
  VideoWriter writer(file, 64, 64, 15);
  std::mt19937 noise(2);
  fluoro::Picture picture;
  picture.width = picture.height = 64;
  for (int frame = 0; frame < 9; ++frame) {
    picture.grey.clear();
    for (int i = 0; i < 64 * 64; ++i) picture.grey.push_back(static_cast<std::uint8_t>(noise()));
    writer.add(picture);
  }
  return writer.finish();
}

/// ffmpeg takes what stands before a colon for a protocol, and what begins with a dash for an option.
TEST_F(WriteFile, AFilmMayBeCalledAsATimeOrAnOption) {
  if (std::system("ffmpeg -version >/dev/null 2>&1")) GTEST_SKIP() << "ffmpeg is not there";
  const fs::path before = fs::current_path();
  fs::current_path(in("."));
  for (const char* name : {"12:30.mp4", "tcp:7.mp4", "-version.mp4", "%d.mp4"}) {
    EXPECT_TRUE(film_of_noise(name)) << name;
    EXPECT_TRUE(fs::exists(name)) << name;
  }
  fs::current_path(before);
}

/// ffmpeg ends well even where it could not write a film's last part.
TEST_F(WriteFile, AFilmCutShortIsNone) {
  if (std::system("ffmpeg -version >/dev/null 2>&1")) GTEST_SKIP() << "ffmpeg is not there";
  const auto film = [&] { return film_of_noise(in("a.mp4")); };
  ASSERT_TRUE(film());
  const auto whole = fs::file_size(in("a.mp4"));
  std::ofstream(in("a.mp4")) << "before";
  for (const auto bytes : {whole / 5, whole / 2, 4 * whole / 5, whole - 1}) {
    const FullDisk full(bytes);
    EXPECT_FALSE(film()) << bytes << " of " << whole;
    EXPECT_EQ(text_of(in("a.mp4")), "before");
    EXPECT_EQ(files(), 1);
  }
}

TEST_F(WriteFile, AFilmWithoutFramesIsNone) {
  if (std::system("ffmpeg -version >/dev/null 2>&1")) GTEST_SKIP() << "ffmpeg is not there";
  VideoWriter writer(in("none.mp4"), 64, 64, 15);
  EXPECT_FALSE(writer.finish());
  EXPECT_NE(writer.problem().find("no frame"), std::string::npos) << writer.problem();
  EXPECT_FALSE(std::filesystem::exists(in("none.mp4")));
}

TEST_F(WriteFile, WhereNothingCanBeWrittenItSaysSo) {
  for (const Written& w : writers()) {
    EXPECT_THROW(w.write("/proc/nowhere/" + w.file), WriteError) << w.file;
    fs::create_directory(in(w.file));
    EXPECT_THROW(w.write(in(w.file)), WriteError) << w.file << ": a folder of its name";
    EXPECT_TRUE(fs::is_directory(in(w.file)));
    fs::remove(in(w.file));
  }
}

TEST_F(WriteFile, ALinkStaysOneAndLeadsToTheNewFile) {
  std::ofstream(in("target")) << "before";
  fs::create_symlink("target", in("link"));
  write_file(in("link"), "after");
  EXPECT_TRUE(fs::is_symlink(in("link")));
  EXPECT_EQ(text_of(in("target")), "after");
}

TEST_F(WriteFile, WhatIsNotFinishedIsNotThere) {
  std::ofstream(in("a")) << "before";
  {
    const NewFile file(in("a"));
    std::ofstream(file.beside()) << "half";
  }
  EXPECT_EQ(text_of(in("a")), "before");
  EXPECT_EQ(files(), 1);
}

TEST_F(WriteFile, FilesThatBelongTogetherAreAllThereOrNone) {
  std::ofstream(in("a")) << "before";
  fs::create_directory(in("b"));
  EXPECT_THROW(write_files({{in("a"), "after"}, {in("b"), "after"}}), WriteError);
  EXPECT_EQ(text_of(in("a")), "before");
  EXPECT_EQ(files(), 2);
  fs::remove(in("b"));
  write_files({{in("a"), "after"}, {in("b"), "after"}});
  EXPECT_EQ(text_of(in("a")) + text_of(in("b")), "afterafter");
}

/// A pipe of that name would wait for somebody who reads it.
TEST_F(WriteFile, APipeWhereAFileIsMadeIsRefused) {
  ASSERT_EQ(mkfifo(in("a.unfinished").c_str(), 0600), 0);
  EXPECT_THROW(write_file(in("a"), "text"), WriteError);
  EXPECT_FALSE(fs::exists(in("a")));
}

/// Two films into one file would end as frames of both, under one name.
TEST_F(WriteFile, OneProgramWritesAFileAtATime) {
  std::ofstream(in("a")) << "before";
  {
    NewFile first(in("a"));
    std::ofstream(first.beside()) << "first";
    EXPECT_THROW(NewFile(in("a")), WriteError);
    EXPECT_THROW(write_file(in("a"), "second"), WriteError);
    EXPECT_EQ(text_of(first.beside()), "first");
    first.finish();
  }
  EXPECT_EQ(text_of(in("a")), "first");
  write_file(in("a"), "second");  // the lock ended with its holder
  EXPECT_EQ(text_of(in("a")), "second");
  std::ofstream(in("a.unfinished")) << "left behind by a kill";
  write_file(in("a"), "third");
  EXPECT_EQ(text_of(in("a")), "third");
  EXPECT_EQ(files(), 1);
}

}  // namespace
}  // namespace ostium::data
