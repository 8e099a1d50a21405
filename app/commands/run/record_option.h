#pragma once
/// The option --record of `run` and `sweep`: what a recording holds.
#include <string>

#include "app/session/recorder/recorder.h"

namespace ostium::app {

std::string record_help();
std::string record_words();  ///< what it may be, for --help

/// Without the file's name. Empty: "events". Throws LoadError saying what it may be.
RecorderOptions recorder_of(const std::string& record);

}  // namespace ostium::app
