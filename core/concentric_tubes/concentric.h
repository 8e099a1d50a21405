#pragma once
/// Static equilibrium of nested instruments whose clearance is negligible: they share one centreline and differ by the
/// angle at which each is turned about it (Dupont, Lock, Itkowitz, Butler 2010, IEEE Trans Robot 26:209; Rucker, Jones,
/// Webster 2010, IEEE Trans Robot 26:769).
///
/// All bending is that of one rod, the carrier. Where instruments i are present it has
///   EI = sum EI_i,   u_rest = sum EI_i Rz(a_i) k_i / EI,   GJ = sum GJ_i,   u_rest,z = -sum GJ_i a_i' / GJ
/// with k_i the rest curvature of instrument i and a_i(s) its angle relative to the carrier's frame, which is that of
/// the instrument that reaches furthest. The carrier's equilibrium is `find_equilibrium` of statics.h. The angles
/// minimise bending and twist energy at fixed carrier moment. The two are solved alternately until they agree, which
/// without loads is immediate. Comparison with core/nesting, which gives each instrument its own rod and clearance:
/// tests/core/concentric_test.cpp.
#include "core/step/statics.h"

namespace ostium::core {

struct ConcentricPart {
  std::vector<Section>
      sections;           ///< from its tip backwards; several parts need EI1 = EI2, a linear law and no rest twist
  double inserted_m = 0;  ///< from the base to its tip; > 0
  double roll_rad = 0;    ///< of its drive about the base's d3, right-handed; whole turns count: shafts can be wound up
  double shaft_rad_per_Nm = 0;  ///< twist of the shaft between drive and base, per torque; 0: rigid
};

/// A dead load on the centreline, divided between the two adjacent nodes.
struct ConcentricLoad {
  double from_base_m = 0;
  Eigen::Vector3d force_W_N = Eigen::Vector3d::Zero();
};

struct ConcentricDescription {
  std::string name;
  std::vector<ConcentricPart> parts;      ///< outermost first
  std::vector<double> element_lengths_m;  ///< of the carrier, from the base; they add up to the largest inserted_m
  std::vector<ConcentricLoad> loads;
};

/// A stretch of a joint's cell over which the nest's properties are constant.
struct ConcentricPiece {
  struct Member {
    int part;
    double EI_N_m2;
    Eigen::Vector2d rest_curvature_per_m;
  };
  double length_m;
  double EI_N_m2;  ///< of all members
  std::vector<Member> members;
};

/// The constant data: made once, shared freely by threads.
struct Concentric {
  Model carrier;  ///< one rod; straight at rest if there are several parts
  std::vector<ConcentricPart> parts;
  int reference = 0;                                 ///< the part whose frame is the carrier's
  std::vector<int> last_element;                     ///< (#parts): the last whose middle the part reaches; -1: none
  std::vector<std::vector<ConcentricPiece>> pieces;  ///< (#joints); empty if there is one part
  Eigen::MatrixXd GJ_N_m2;                           ///< (#parts, #joints): shares of the carrier's
};

/// Throws std::invalid_argument as `make_rod` does, and if a part violates the limits of ConcentricPart.
Concentric make_concentric(const ConcentricDescription& description, const Eigen::Vector3d& gravity_W);

struct ConcentricState {
  State carrier;
  Eigen::VectorXd base_roll_rad;  ///< (#parts): at the base, after the shaft's twist
  Eigen::MatrixXd roll_rad;       ///< (#parts, #elements): relative to the carrier's frame; beyond a tip as at the tip
  Eigen::Matrix3Xd moment_N_m;    ///< (3, #joints): the carrier's, material frame
};

/// Element lengths for these parts, with nodes where sections end: none longer than `longest_m`, none that turns by
/// more than `longest_rad` at rest, at least 16 elements.
std::vector<double> concentric_elements(const std::vector<ConcentricPart>& parts, double longest_m, double longest_rad);

/// Straight from the base, each part at its drive's roll.
ConcentricState straight_state(const Concentric& nest, const EndState& base);

/// Carries the shape of another nest of the same parts (`before`, of `before_nest`) over to this one: strains and
/// angles at the same fraction of the length from the base. A starting point, not an equilibrium.
ConcentricState carried_over(const Concentric& nest, const EndState& base, const Concentric& before_nest,
                             const ConcentricState& before);

/// Material frame at the tip of a part, w x y z.
Eigen::Vector4d tip_frame(const Concentric& nest, const ConcentricState& state, int part);

struct ConcentricEquilibrium {
  bool converged = false;
  int rounds = 0;               ///< alternations of angles and carrier
  double turn_rad = 0;          ///< largest change of an angle in the last round
  double base_push_N = 0;       ///< force along the base's d3 that holds the nest there
  int negative_directions = 0;  ///< of the carrier (statics.h); not 0 if no stable shape was found
};

/// Puts `state` into the stable equilibrium that continues from its shape; leaves shapes that are balanced but
/// unstable. `base` is the unrolled base frame. Without convergence, `state` is not an equilibrium and the report says
/// so.
ConcentricEquilibrium find_equilibrium(const Concentric& nest, const EndState& base,
                                       const Eigen::Vector3d& tip_force_W_N, ConcentricState& state);

}  // namespace ostium::core
