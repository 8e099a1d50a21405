#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/base/units.h"
#include "data/formats/dicom/dicom_runs.h"
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

}  // namespace
}  // namespace ostium::data
