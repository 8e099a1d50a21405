#pragma once
/// The coronary arteries as beams in the muscle: they give way where instruments press on them or straighten them, and
/// come back.
///
/// For the distance z by which the centreline lies aside, per length of artery:
///   k (z + T dz/dt) + (EI z'')'' = f - (m (u + z''))''
/// where f is the force of what touches the wall, and m the moment of an inflated balloon, which would be straight,
/// where the artery curves by u without it. Origins at the aorta stay where they are; a side branch goes with its
/// parent and keeps its angle as a beam does. Walls stay walls (artery_layout.h).
///
/// k: an artery half embedded in muscle of E = 15 kPa is held by half of 4 pi G / ln(L / r), G = E / 3, over
/// L / r = 10. EI: pi r^3 t E of a wall of t = 0.5 mm and E = 1 MPa. [estimates; both of the right order] T is no
/// property of tissue: contact's wall is moved in small pieces, and the rest has to follow.
#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/base/fields.h"
#include "vascular/treatment/artery_layout.h"
#include "vascular/treatment/pressurised_tube.h"

namespace ostium::vascular {

struct ArteryBedLaw {
  double bed_N_m2 = 13.6e3;    ///< k
  double wall_Pa = 1e6;        ///< E
  double wall_m = 0.5e-3;      ///< t
  double yields_s = 0.3;       ///< T
  double most_aside_m = 3e-3;  ///< farther it does not go
  double steepest = 0.35;      ///< share of the room between cells that each part of z may differ by
};

struct ArteryBedModel {
  ArteryBedLaw law;
  ArteryLayout layout;
  std::vector<double> length_m;  ///< (#cells)
  std::vector<double> EI_N_m2;   ///< (#cells)
};
ArteryBedModel make_artery_bed(const FlowTree& tree, ArteryLayout layout, const ArteryBedLaw& law = {});

struct ArteryBedState {
  std::vector<Eigen::Vector3d> aside_P;  ///< z (#cells), m; empty: arteries that do not give way
};
constexpr auto fields(const ArteryBedState*) { return std::tuple{core::field("aside_m", &ArteryBedState::aside_P)}; }

/// A balloon across the joint between a cell's two neighbours upstream and the cell.
struct BedTube {
  int cell = 0;
  PressurisedTube tube;
  Eigen::Vector3d curvature_P = Eigen::Vector3d::Zero();  ///< u, 1/m: towards the centre of the bend
};

struct ArteryBedInputs {
  std::span<const Eigen::Vector3d> load_P_N;  ///< f on each cell (#cells)
  std::span<const BedTube> tubes;
};

struct ArteryBedScratch {
  std::vector<double> diagonal, to_upstream, to_second;  ///< of the matrix: a cell, and the two upstream of it
  std::vector<Eigen::Vector3d> right;
  std::vector<Eigen::Array3d> lower, upper;
};

/// One step of any length. Linear in the number of cells: they are eliminated from the ends to the origins. Does not
/// allocate after the first call with the same scratch.
void step(const ArteryBedModel& model, const ArteryBedInputs& inputs, double dt_s, ArteryBedState& state,
          ArteryBedScratch& scratch);

/// Curvature vector of a line of three points at its middle one, 1/m.
Eigen::Vector3d curvature_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace ostium::vascular
