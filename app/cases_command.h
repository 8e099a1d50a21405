#pragma once
#include <string>

namespace ostium {

struct CasesOptions {
  std::string name;  ///< empty: all
  bool json = false;
  std::string folder;  ///< if not empty: the case's surfaces and centrelines are written there
};

/// `ostium cases`. Returns the exit code; throws LoadError or MeshError.
int cases_command(const CasesOptions& options);

}  // namespace ostium
