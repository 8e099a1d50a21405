#pragma once
/// Working memory of a step. May be destroyed, or made anew, between any two steps.
#include <vector>

#include "core/model/model.h"
#include "core/model/nest_scratch.h"
#include "core/wall/pose.h"

namespace ostium::core {

/// What a step changes of a rod's state before it has a solution.
struct DriveRollback {
  EndState base, tip;
  double inserted_m = 0, slack_m = 0;
  int first = 0;
};

struct Scratch {
  /// Throws as check(model) does.
  explicit Scratch(const Model& model);

  std::vector<RodScratch> rods;             ///< one per rod; solved with it while it is in no nest
  std::vector<ContactScratch> contacts;     ///< one per rod, the same
  std::vector<Nest> nests;                  ///< one per rod, for when it is the outermost of one
  std::vector<Strand> strands;              ///< of this step, by their outermost rods
  std::vector<int> lead;                    ///< (#rods): the outermost rod of its strand
  std::vector<char> was_in_body;            ///< (#rods), before this step
  std::vector<double> fed_m;                ///< (#rods), pushed in in this step
  std::vector<DriveRollback> before_drive;  ///< (#rods), as they were before it
  std::vector<RodContact> rod_contacts;     ///< at most max_rod_contacts
  int rod_rounds = 0;
  double step_s = 0;                  ///< of this step, or of the piece of it that is tried
  std::vector<SurfacePose> surfaces;  ///< one per surface
  TridiagonalFactors factors;
};

}  // namespace ostium::core
