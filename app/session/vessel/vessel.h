#pragma once
/// What a session takes place in: a case's beating lumen, or a mesh that stands still. Const once made; runs share it.
#include <memory>
#include <optional>

#include "app/session/vessel/coronaries.h"
#include "app/session/vessel/vessel_index.h"
#include "core/model/state.h"
#include "core/wall/surface.h"
#include "data/catalogue/case/case.h"
#include "vascular/patient/ventricle.h"

namespace ostium::app {

struct Vessel {
  std::string name;                              ///< a case's, or the mesh's file
  core::SurfaceDescription wall;                 ///< frames of a beat, or one; frame W is the patient's
  std::shared_ptr<const core::Surface> surface;  ///< the same as contact has it
  core::EndState entry;                          ///< the introducer: within the lumen, d3 is the way in
  std::unique_ptr<const VesselIndex> way;
  Eigen::Vector3d p_middle = Eigen::Vector3d::Zero();  ///< of heart or mesh: where a C-arm looks at first, m
  double rate_1_min = 70;                              ///< of the heart, as a session begins
  std::shared_ptr<const vascular::Patient> patient;    ///< of a case
  std::unique_ptr<const Coronaries> coronaries;        ///< the same; null: a mesh
  vascular::Ventricle
      ventricle;  ///< behind the aortic valve, the wall's door; empty: instruments end on the valve's floor

  bool beats() const { return wall.frames.size() > 1; }
};

/// The aorta's diameter half-way between valve and arch, m; 0 where there is none.
double ascending_diameter_m(const Vessel& vessel);

/// Friction of vessel against instruments: estimate, hydrophilic to bare polymer in blood 0.02 to 0.2.
inline constexpr double vessel_friction = 0.1;

/// A case's vessel; takes some seconds. `person`: another one than the case's own (vascular's person(seed)).
std::shared_ptr<const Vessel> vessel_of(const data::Case& c, std::optional<std::uint64_t> person);

struct MeshEntry {
  Eigen::Vector3d p_P = Eigen::Vector3d::Zero();        ///< m, within the lumen
  Eigen::Vector3d towards_P = Eigen::Vector3d::Zero();  ///< a point that the way in leads to
};

/// Where an introducer would have to be to lead straight into an artery: in the root, 12 mm ahead of its ostium. For
/// rehearsing what comes after the ostium alone. Throws LoadError, naming those there are: LM, RCA.
core::EndState entry_ahead_of(const std::string& artery, const Vessel& vessel);

/// A mesh of anyone; one that faces inwards is turned round. Throws MeshError if it cannot be used, LoadError if the
/// entry lies outside or the wall is folded through itself. What is wrong with it is told in `warnings`: near holes and
/// crossings nothing is held back.
std::shared_ptr<const Vessel> vessel_of(const std::string& name, vascular::Mesh mesh, const MeshEntry& entry,
                                        std::string& warnings);

/// Middle of the box around ostia, left ventricle's base and apex, m.
Eigen::Vector3d heart_middle(const vascular::Patient& patient);

/// A frame with d3 along `direction`.
core::EndState end_at(const Eigen::Vector3d& p_W, const Eigen::Vector3d& direction_W);

}  // namespace ostium::app
