#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "core/base/units.h"
#include "data/formats/dicom/dicom_runs.h"
#include "data/formats/dicom/segmentation.h"
#include "data/formats/png.h"
#include "data/formats/write_file.h"

namespace ostium::data {
namespace {

struct Outcome {
  int code = -1;
  std::string words;
};

Outcome run(const std::string& command) {
  Outcome out;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer;
  while (std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) out.words.append(buffer.data(), n);
  out.code = pclose(pipe);
  return out;
}

bool there_is(const char* program) { return run(std::string("command -v ") + program).code == 0; }

fluoro::CineRun ramp(std::size_t frames, int width, int height) {
  using units::degree;
  fluoro::CineRun out;
  out.view.arm.lao_rad = -30 * degree;
  out.view.arm.cran_rad = -20 * degree;
  out.view.pixels = width;
  out.programme = fluoro::cine(15);
  out.exposure.tube.peak_kV = 78;
  for (std::size_t f = 0; f < frames; ++f) {
    fluoro::Picture picture{width, height, std::vector<std::uint8_t>(std::size_t(width * height))};
    for (std::size_t i = 0; i < picture.grey.size(); ++i) picture.grey[i] = std::uint8_t(i + 10 * f);
    out.frames.push_back(picture);
  }
  return out;
}

std::string file_for(const std::string& name) {
  return (std::filesystem::temp_directory_path() / (std::to_string(getpid()) + "-" + name)).string();
}

TEST(Dicom, OneFrameAndManyPassTheStandardsValidator) {
  if (!there_is("dciodvfy")) GTEST_SKIP() << "dciodvfy (dicom3tools) is not installed";
  for (std::size_t frames : {1u, 4u}) {
    const std::string file = file_for("ostium-dicom-test.dcm");
    write_dicom(file, ramp(frames, 64, 64));
    const Outcome checked = run("dciodvfy " + file);
    EXPECT_EQ(checked.words.find("Error"), std::string::npos) << checked.words;
    EXPECT_NE(checked.words.find("XAImage"), std::string::npos) << checked.words;
    std::filesystem::remove(file);
  }
}

TEST(Dicom, DcmdumpReadsTheGeometryBack) {
  if (!there_is("dcmdump")) GTEST_SKIP() << "dcmdump (dcmtk) is not installed";
  const std::string file = file_for("ostium-dicom-geometry.dcm");
  write_dicom(file, ramp(3, 50, 25));  // an odd number of bytes
  const Outcome dumped = run("dcmdump " + file);
  EXPECT_EQ(dumped.code, 0);
  for (const char* expected :
       {"(0018,1510) DS [-30]", "(0018,1511) DS [-20]", "(0018,1110) DS [1100]", "(0018,1111) DS [765]",
        "(0018,1164) DS [4\\4]", "(0018,1063) DS [66.6667]", "(0028,0008) IS [3]", "(0018,0060) DS [78]",
        "(0018,1155) CS [GR]", "(0028,0009) AT (0018,1063)", "=XRayAngiographicImageStorage"})
    EXPECT_NE(dumped.words.find(expected), std::string::npos) << expected << "\n" << dumped.words;
  std::filesystem::remove(file);
}

TEST(Dicom, PixelsSurvive) {
  if (!there_is("dcmdump")) GTEST_SKIP() << "dcmdump (dcmtk) is not installed";
  const std::string file = file_for("ostium-dicom-pixels.dcm");
  write_dicom(file, ramp(1, 4, 2));
  EXPECT_NE(run("dcmdump " + file).words.find("00\\01\\02\\03\\04\\05\\06\\07"), std::string::npos);
  std::filesystem::remove(file);
}

TEST(Dicom, WhatCannotBeWrittenIsNamed) {
  try {
    write_dicom("/proc/nowhere/run.dcm", ramp(1, 8, 8));
    FAIL();
  } catch (const WriteError& error) {
    EXPECT_NE(std::string(error.what()).find("/proc/nowhere/run.dcm"), std::string::npos);
  }
  EXPECT_THROW(write_png("/proc/nowhere/frame.png", ramp(1, 8, 8).frames[0]), WriteError);
  EXPECT_THROW(write_png("/dev/full", ramp(1, 8, 8).frames[0]), WriteError);
  EXPECT_THROW(write_dicom("/dev/full", ramp(1, 8, 8)), WriteError);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));  // only our own files are removed
}

/// CineRate is a whole number (IS); the frame time is exact.
TEST(Dicom, EveryRateModeAndFieldPassesTheStandardsValidator) {
  if (!there_is("dciodvfy") || !there_is("dcmdump")) GTEST_SKIP() << "dciodvfy (dicom3tools) or dcmdump is missing";
  for (const double rate : {3.75, 7.5, 15.0, 30.0})
    for (const bool cine : {false, true})
      for (const double field_m : {0.2, 0.16, 0.13}) {
        const std::string file = file_for("ostium-dicom-rate.dcm");
        fluoro::CineRun made = ramp(3, 32, 32);
        made.programme = cine ? fluoro::cine(rate) : fluoro::fluoroscopy(rate), made.view.field_m = field_m;
        write_dicom(file, made);
        const Outcome checked = run("dciodvfy " + file), dumped = run("dcmdump " + file);
        EXPECT_EQ(checked.words.find("Error"), std::string::npos) << rate << " " << cine << "\n" << checked.words;
        EXPECT_NE(dumped.words.find("(0018,0040) IS [" + std::to_string(std::lround(rate)) + "]"), std::string::npos)
            << dumped.words;
        std::filesystem::remove(file);
      }
}

TEST(DicomRuns, AnotherViewOrFieldIsAnotherFile) {
  const fluoro::CineRun first = ramp(1, 8, 8);
  fluoro::CineRun turned = first, zoomed = first;
  turned.view.arm.lao_rad += 0.1, zoomed.view.field_m = 0.13;
  DicomRuns runs;
  runs.add(first, first.frames[0]), runs.add(first, first.frames[0]);
  runs.add(turned, first.frames[0]), runs.add(zoomed, first.frames[0]), runs.add(first, first.frames[0]);
  const std::string file = file_for("runs.dcm");
  const std::vector<std::string> names = runs.write(file);
  ASSERT_EQ(names.size(), 4u);
  EXPECT_EQ(names[0], file);
  EXPECT_NE(names[3].find("runs-4.dcm"), std::string::npos);
  EXPECT_EQ(runs.runs()[0].frames.size(), 2u);
  for (const std::string& name : names) EXPECT_TRUE(std::filesystem::remove(name)) << name;
}

/// A viewer shows the views of one film under one study, a series each.
TEST(DicomRuns, AFilmIsOneStudyWithASeriesForEachFile) {
  if (!there_is("dcmdump")) GTEST_SKIP() << "dcmdump (dcmtk) is not installed";
  const fluoro::CineRun first = ramp(1, 8, 8);
  fluoro::CineRun turned = first;
  turned.view.arm.lao_rad += 0.1;
  DicomRuns runs;
  runs.add(first, first.frames[0]), runs.add(turned, first.frames[0]);
  const auto value = [](const std::string& name, const std::string& tag) {
    const std::string words = run("dcmdump +P " + tag + " " + name).words;
    return words.substr(0, words.find(']'));
  };
  const std::vector<std::string> names = runs.write(file_for("study.dcm"));
  ASSERT_EQ(names.size(), 2u);
  EXPECT_EQ(value(names[0], "0020,000d"), value(names[1], "0020,000d")) << "study";
  EXPECT_NE(value(names[0], "0020,000e"), value(names[1], "0020,000e")) << "series";
  EXPECT_NE(value(names[0], "0008,0018"), value(names[1], "0008,0018")) << "instance";
  EXPECT_NE(value(names[0], "0020,0011").find("IS [1"), std::string::npos);
  EXPECT_NE(value(names[1], "0020,0011").find("IS [2"), std::string::npos);
  for (const std::string& name : names) EXPECT_TRUE(std::filesystem::remove(name)) << name;
}

/// Lengths in DICOM have 32 bits.
TEST(DicomRuns, AFilmLongerThanAFileCanHoldGoesOnInTheNext) {
  const fluoro::CineRun some = ramp(1, 8, 8);
  DicomRuns runs(3 * 64 + 63);
  for (int i = 0; i < 7; ++i) runs.add(some, some.frames[0]);
  ASSERT_EQ(runs.runs().size(), 3u);
  EXPECT_EQ(runs.runs()[0].frames.size(), 3u);
  EXPECT_EQ(runs.runs()[2].frames.size(), 1u);
  EXPECT_LT(dicom_most_bytes, std::uint64_t{1} << 32);
}

const DicomSegment wire = {"wire", {"260787004", "SCT", "Physical object"}, {"WIRE", "99OSTIUM", "Guide wire"}, "wire"},
                   artery = {"Arterie ä",
                             {"91723000", "SCT", "Anatomical Structure"},
                             {"13647002", "SCT", "Right Coronary Artery"},
                             "RCA"};

TEST(DicomSegmentation, BitsAreThePixels) {
  constexpr int side = 64, bytes = side * side / 8;
  for (const std::size_t frames : {1u, 3u}) {
    const std::string film = file_for("film.dcm"), file = file_for("film-seg.dcm");
    write_dicom(film, ramp(frames, side, side));
    // Column 2 from row 5 on, seven pixels; and the last pixel of all.
    const int last = static_cast<int>(frames);
    write_segmentation(file, film, "1", {wire, artery},
                       {{1, 2, {2 * side + 5, 7, side * side - 2 * side - 12}}, {last, 1, {side * side - 1, 1}}});
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    ASSERT_GT(in.tellg(), 2 * bytes);
    in.seekg(-2 * bytes,
             std::ios::end);  // the pixels are the last of a file: eight in a byte, the first lowest (PS3.5 8.1.1)
    std::vector<char> packed(2 * bytes);
    in.read(packed.data(), 2 * bytes);
    for (int frame = 0; frame < 2; ++frame)
      for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
          const int at = row * side + column;
          const bool set = packed[static_cast<std::size_t>(frame * bytes + at / 8)] >> (at % 8) & 1;
          EXPECT_EQ(set, frame == 0 ? column == 2 && row >= 5 && row < 12 : at == side * side - 1) << row << column;
        }
    if (there_is("dciodvfy")) {
      const Outcome checked = run("dciodvfy " + file);
      EXPECT_EQ(checked.words.find("Error"), std::string::npos) << checked.words;
      EXPECT_EQ(checked.words.find("Segmentation\n"), 0u) << checked.words;
    }
    if (there_is("dcmdump")) {
      EXPECT_NE(run("dcmdump +U8 +P 0062,0005 " + file).words.find("[Arterie ä]"), std::string::npos);
    }
    std::filesystem::remove(film), std::filesystem::remove(file);
  }
}

TEST(DicomSegmentation, WhatIsNotThereIsRefusedAndLeavesNothing) {
  const std::string film = file_for("film.dcm"), file = file_for("film-seg.dcm");
  write_dicom(film, ramp(2, 8, 8));
  EXPECT_THROW(write_segmentation(file, film, "1", {wire}, {{3, 1, {64}}}), std::invalid_argument);
  EXPECT_THROW(write_segmentation(file, film, "1", {wire}, {{1, 2, {64}}}), std::invalid_argument);
  EXPECT_THROW(write_segmentation(file, film, "1", {wire}, {{1, 1, {60, 5}}}), std::invalid_argument);
  EXPECT_THROW(write_segmentation(file, film + ".none", "1", {wire}, {{1, 1, {63, 1}}}), WriteError);
  EXPECT_FALSE(std::filesystem::exists(file) || std::filesystem::exists(file + ".unfinished"));
  std::filesystem::remove(film);
}

}  // namespace
}  // namespace ostium::data
