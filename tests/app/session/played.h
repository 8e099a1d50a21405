#pragma once
/// Runs of a wire in the small vessel, to the end of the script.
#include <gtest/gtest.h>

#include "app/session/run/play.h"
#include "tests/app/session/tube_vessel.h"

namespace ostium::app {

inline PlayReport played(const RunSetup& setup, bool real = false, RecordMode mode = RecordMode::none) {
  ScriptedRun run(setup, tube_vessel());
  PlayOptions options;
  options.recorder.mode = mode;
  options.recorder.penetration = false;
  options.real = real;
  return play(run, setup, options);
}

/// `script` with the first `from` replaced.
inline std::string with(std::string script, const std::string& from, const std::string& to) {
  const std::size_t at = script.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return script.replace(at, from.size(), to);
}

}  // namespace ostium::app
