#pragma once
/// The vessel of a session: a case's beating lumen, or a mesh at rest. Const once made; runs share it.
#include <memory>
#include <optional>

#include "app/session/vessel/coronaries.h"
#include "app/session/vessel/vessel_index.h"
#include "core/model/state.h"
#include "core/wall/surface.h"
#include "data/catalogue/case/case.h"
#include "vascular/patient/ventricle.h"
#include "vascular/treatment/artery_layout.h"

namespace ostium::app {

struct Vessel {
  std::string name;                              ///< the case's, or the mesh file
  core::SurfaceDescription wall;                 ///< frames of a beat, or one; frame W is the patient's
  std::shared_ptr<const core::Surface> surface;  ///< the same for contact
  core::EndState entry;                          ///< the introducer: within the lumen, d3 points inwards
  std::unique_ptr<const VesselIndex> way;
  Eigen::Vector3d p_middle = Eigen::Vector3d::Zero();  ///< of heart or mesh, where the C-arm looks at first, m
  double rate_1_min = 70;                              ///< heart rate at the start
  std::shared_ptr<const vascular::Patient> patient;    ///< of a case
  std::unique_ptr<const Coronaries> coronaries;        ///< of a case; null for a mesh
  vascular::ArteryLayout arteries;                     ///< of those
  vascular::Ventricle
      ventricle;  ///< behind the aortic valve, which is the wall's door; empty: instruments stop at the valve

  bool beats() const { return wall.frames.size() > 1; }
};

/// Its wall's frame number at a cardiac phase.
double vessel_frame(const Vessel& vessel, double phase);

/// The aorta's diameter half-way between valve and arch, m; 0 if there is none.
double ascending_diameter_m(const Vessel& vessel);

/// Friction between vessel and instruments: an estimate; hydrophilic to bare polymer in blood, 0.02 to 0.2.
inline constexpr double vessel_friction = 0.1;

/// A case's vessel; takes some seconds. `person`: overrides the case's own (vascular's person(seed)).
std::shared_ptr<const Vessel> vessel_of(const data::Case& c, std::optional<std::uint64_t> person);

struct MeshEntry {
  Eigen::Vector3d p_P = Eigen::Vector3d::Zero();        ///< m, within the lumen
  Eigen::Vector3d towards_P = Eigen::Vector3d::Zero();  ///< a point that the entry direction aims at
};

/// The pose of an introducer that leads straight into an artery: in the root, 12 mm before its ostium. For simulating
/// only what comes after the ostium. Throws LoadError naming the arteries: LM, RCA.
core::EndState entry_ahead_of(const std::string& artery, const Vessel& vessel);

/// From any mesh; one oriented inwards is flipped. Throws MeshError if it cannot be used, LoadError if the entry lies
/// outside or the wall is folded through itself. Defects are reported in `warnings`: near holes and crossings the wall
/// does not hold instruments.
std::shared_ptr<const Vessel> vessel_of(const std::string& name, vascular::Mesh mesh, const MeshEntry& entry,
                                        std::string& warnings);

/// Middle of the bounding box of the ostia and the left ventricle's base and apex, m.
Eigen::Vector3d heart_middle(const vascular::Patient& patient);

/// A frame with d3 along `direction`.
core::EndState end_at(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W);

}  // namespace ostium::app
