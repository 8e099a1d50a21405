#pragma once
#include <string>
#include <vector>

namespace ostium {

struct ImportOptions {
  std::vector<std::string> files;
  std::string output;                ///< a folder, or the name of a case
  std::string unit = "auto";         ///< auto, mm, cm, m or in
  std::string axes = "auto";         ///< where the file's x, y, z point to: three letters of L, R, S, I, A, P
  std::string entry;                 ///< "x,y,z" in the file's unit and axes
  std::vector<std::string> renames;  ///< "3=OM1"
  std::vector<std::string> lesions;  ///< "RCA:40:12:75": branch, from mm, length mm, percent of the diameter
  bool sequence = false;             ///< the files are frames of one beat, from the R wave on
  std::string title;
  double voxel_mm = 0;
  double longest_gap_mm = 8;
  std::string picture;
  bool json = false;
};

/// `ostium import`. Exit code 0; throws MeshError or LoadError, and has written nothing then.
int import_command(const ImportOptions& options);

}  // namespace ostium
