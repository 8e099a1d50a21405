#pragma once
/// A case's coronary arteries as contrast, balloons and stents need them. Const once made; runs share them.
#include <span>

#include "app/angiography/textbook_treatment.h"
#include "vascular/treatment/stent_ties.h"

namespace ostium::app {

/// Vertices of the lumen that belong to a cell.
struct CellVertices {
  std::vector<int> first, vertices;  ///< vertices[first[cell], first[cell + 1])
  std::span<const int> of(std::size_t cell) const {
    return std::span(vertices).subspan(static_cast<std::size_t>(first[cell]),
                                       static_cast<std::size_t>(first[cell + 1] - first[cell]));
  }
};

struct Coronaries {
  std::shared_ptr<const vascular::Patient> patient;
  vascular::PhysiologyModel physiology;  ///< of the mean person; a session has its own, by seed
  vascular::LumenMap map;
  std::unique_ptr<const vascular::WallShape> shape;
  std::unique_ptr<const vascular::StentTies> ties;
  vascular::TreatmentModel treatment;  ///< without devices
  std::vector<Plan> lesions;           ///< in the case's order, without devices
  /// In the first lesion's artery: the cell beyond its ostium and the TIMI landmark, or -1.
  int ostium_cell = -1, landmark_cell = -1;
  vascular::PhysiologyState at_rest;  ///< the circulation once pressure and flow repeat from beat to beat
  CellVertices opened_with;           ///< those that follow a cell's radius,
  CellVertices aside_with;            ///< and those that go aside with it

  const vascular::FlowTree& tree() const { return physiology.flow.tree; }
};

/// Takes about a second. Null if the patient has no coronary artery.
std::unique_ptr<const Coronaries> make_coronaries(std::shared_ptr<const vascular::Patient> patient, double rate_1_min);

}  // namespace ostium::app
