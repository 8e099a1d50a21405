#pragma once
/// Working memory of a step. May be destroyed or recreated between any two steps.
#include <vector>

#include "core/base/phase_clock.h"
#include "core/model/model.h"
#include "core/model/nest_scratch.h"
#include "core/model/report.h"
#include "core/wall/pose.h"

namespace ostium::core {

/// What a step changes in a rod's state before it has a solution, to be undone.
struct DriveRollback {
  EndState base, tip;
  double inserted_m = 0, slack_m = 0;
  int first = 0;
};

struct Scratch {
  /// Throws as check(model) does.
  explicit Scratch(const Model& model);

  std::vector<RodScratch> rods;             ///< one per rod; used while it is in no nest
  std::vector<ContactScratch> contacts;     ///< one per rod, likewise
  std::vector<Lookouts> lookouts;           ///< one per rod; none without walls
  std::vector<Nest> nests;                  ///< one per rod, used when it is the outermost of a nest
  std::vector<Strand> strands;              ///< of this step, by outermost rod
  std::vector<int> lead;                    ///< (#rods): the outermost rod of its nest
  std::vector<int> around;                  ///< (#rods): the last rod around it; -1: none
  std::vector<int> branch;                  ///< (#rods): of its nest, from 1; 0: rods that all the others run in
  std::vector<Exit> exits;                  ///< (#rods): from those around it
  std::vector<char> was_in_body;            ///< (#rods), before this step
  std::vector<double> fed_m;                ///< (#rods), length pushed in during this step
  std::vector<DriveRollback> before_drive;  ///< (#rods), values before the drives moved
  std::vector<RodContact> rod_contacts;     ///< at most max_rod_contacts
  int rod_rounds = 0;
  double step_s = 0;                  ///< of this step, or of the part being attempted
  std::vector<SurfacePose> surfaces;  ///< one per surface
  TridiagonalFactors factors;
  StepCounts counts;            ///< of this step
  PhaseClock* clock = nullptr;  ///< counts the time of phases (step/phases.h), if there is one
};

/// Calls visit(tree) for each single strand, and each with its branches.
template <class Visit>
void for_trees(const Scratch& scratch, Visit&& visit) {
  const Tree all(scratch.strands);
  for (std::size_t i = 0; i < all.size(); i += 1 + static_cast<std::size_t>(all[i].branches))
    visit(all.subspan(i, 1 + static_cast<std::size_t>(all[i].branches)));
}

}  // namespace ostium::core
