#pragma once
/// Arguments shared by `run` and `sweep`: vessel, script, and changes to them.
#include "app/command_line/options.h"
#include "app/session/operator/setup.h"

namespace ostium::app {

struct SessionArguments {
  std::string vessel;  ///< a case, or a mesh
  std::string script = "aorta-arch-wire";
  std::vector<std::string> set;  ///< KEY=VALUE
  std::uint64_t seed = 0;
  double seconds = 0;          ///< limit of simulated time; 0: until the script ends
  std::string unit = "auto";   ///< of a mesh
  std::string entry, towards;  ///< of a mesh: X,Y,Z
};

/// All options except vessel and seed.
void add_session_options(Options& options, SessionArguments& arguments);

/// The setup that the arguments describe. Throws LoadError or MeshError.
RunSetup setup_of(const SessionArguments& arguments);

}  // namespace ostium::app
