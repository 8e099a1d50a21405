#pragma once
/// Tests of each way to draw path lengths. A build needs OSMesa, but EGL is there only with some driver or other: where
/// it is not, its tests skip with EGL's word.
#include <gtest/gtest.h>

#include <iterator>
#include <stdexcept>
#include <string>

#include "fluoro/projection/path_lengths.h"

namespace ostium::fluoro {

class DrawnBy : public testing::TestWithParam<Renderer> {
 protected:
  void SetUp() override {
    try {
      by = make_renderer(GetParam());
      RecordProperty("device", by->device());
    } catch (const std::runtime_error& missing) {
      if (GetParam() != Renderer::egl) throw;
      GTEST_SKIP() << missing.what();
    }
  }

  std::unique_ptr<PathLengthRenderer> by;
};

/// The ending of a test's name.
inline std::string name_of(const testing::TestParamInfo<Renderer>& info) {
  return std::data(renderer_names)[static_cast<std::size_t>(info.param)];
}

}  // namespace ostium::fluoro
