#pragma once
#include <string>
#include <vector>

namespace ostium {

struct CentrelineCommandOptions {
  std::string mesh;
  std::string unit = "mm";        ///< mm, cm or m
  std::string start;              ///< "x,y,z" in the file's unit; empty: the widest end
  std::vector<std::string> ends;  ///< the same; empty: all that stand out
  std::string output;             ///< .json or .vtp
};

/// `ostium centreline`. Exit code 0; throws MeshError or LoadError.
int centreline_command(const CentrelineCommandOptions& options);

}  // namespace ostium
