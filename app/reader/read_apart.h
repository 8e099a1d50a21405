#pragma once
/// Files that others made are read by a program of its own, `ostium-reader`, with limits of memory and time. The
/// libraries that read meshes and recordings may end by a signal, ask for gigabytes or never end where a file is
/// damaged; then the reader ends, and the program says so.
#include <string>

#include "vascular/geometry/mesh_files/raw_surface.h"

namespace ostium::app {

/// What `ostium-reader` allows itself; whoever called it also looks at the clock.
struct ReaderLimits {
  static constexpr unsigned long long bytes = 2ull << 30;  ///< of address space
  unsigned seconds = 20;                                   ///< of processor
  /// On the clock, so many times that: a machine may be busy with other things.
  static constexpr unsigned patience = 3;
};

/// How a file is asked for: `ostium-reader KIND SECONDS FILE`.
struct ReaderCall {
  std::string kind;  ///< "mesh", "axes" or "recording"
  std::string cure;  ///< of a file that the reader cannot cope with, for the message
  ReaderLimits limits = {};
  std::string program = {};  ///< empty: the one beside the running program
};

/// Where ostium-reader is, if not beside the running program. For the start of a program, before it has threads.
void set_reader(const std::string& program);

/// What the reader wrote. Throws data::LoadError that begins with the file's name: what the reader refuses, or how it
/// ended.
std::string read_apart(const ReaderCall& call, const std::string& file);

/// As vascular::read_surface, apart. Throws MeshError.
vascular::RawSurface read_surface_apart(const std::string& file);

/// As vascular::axes_mark_of, apart: "LPS", "RAS" or empty. Throws data::LoadError.
std::string read_axes_apart(const std::string& file);

/// Reads the recording apart, from beginning to end; what is read after that is known to be whole. Throws
/// data::LoadError.
void require_whole_recording(const std::string& file);

}  // namespace ostium::app
