#include "app/gates/dodge.h"

#include <cassert>
#include <cmath>

#include "core/base/units.h"

namespace ostium::app::gates {

namespace {

using units::degree, units::cm;

/// Points of a tube by arc length.
class Places {
 public:
  explicit Places(const vascular::Anatomy& anatomy) : anatomy_(anatomy) {}

  double start(const char* branch) const { return named(branch).from_m; }
  double end(const char* branch) const { return named(branch).to_m; }
  /// Where `child` leaves the tube of `branch`.
  double origin(const char* child, const char* branch) const {
    return nearest_s(tube(branch), anatomy_.tubes[named(child).tube].nodes.front().p);
  }
  Eigen::Vector3d at(const char* branch, double s) const { return tube(branch).at(s).p; }
  Eigen::Vector3d middle(const char* branch) const { return at(branch, (start(branch) + end(branch)) / 2); }

 private:
  const vascular::NamedBranch& named(const char* name) const {
    const vascular::NamedBranch* found = find_branch(anatomy_, name);
    assert(found);
    return *found;
  }
  const vascular::Tube& tube(const char* branch) const { return anatomy_.tubes[named(branch).tube]; }
  const vascular::Anatomy& anatomy_;
};

/// Segments as in BARI and CASS. LAD: the first ends at S1, the second half-way from there to the apex. Right coronary:
/// the first ends half-way to the acute margin, the second there, the third at the PDA. Circumflex: at its marginals.
Eigen::Vector3d in_patient(const std::string& point, const vascular::Anatomy& anatomy) {
  const Places p(anatomy);
  const double s1 = p.origin("S1", "LAD"), lad = p.start("LAD"), apex = p.end("LAD") - 22e-3;
  const double second = (s1 + apex) / 2;
  if (point == "L1-mid") return p.at("LAD", (lad + s1) / 2);
  if (point == "L2-mid") return p.at("LAD", (s1 + second) / 2);
  if (point == "L3-mid") return p.at("LAD", (second + apex) / 2);
  if (point == "L4-proximal") return p.at("LAD", apex);
  if (point == "D1-mid") return p.middle("D1");
  if (point == "D2-mid") return p.middle("D2");
  if (point == "S1-mid") return p.middle("S1");
  const double m1 = p.origin("OM1", "LCx"), m2 = p.origin("OM2", "LCx");
  if (point == "C1-mid") return p.at("LCx", (p.start("LCx") + m1) / 2);
  if (point == "C2-mid") return p.at("LCx", (m1 + m2) / 2);
  if (point == "C3-mid") return p.at("LCx", (m2 + p.end("LCx")) / 2);
  if (point == "M1-mid") return p.middle("OM1");
  if (point == "M2-mid") return p.middle("OM2");
  const double margin = p.origin("RV", "RCA"), ostium = p.start("RCA"), half = (ostium + margin) / 2;
  const double pda = p.origin("PDA", "RCA"), crux_end = p.origin("PLV2", "RCA");
  if (point == "R1-mid") return p.at("RCA", (ostium + half) / 2);
  if (point == "R2-mid") return p.at("RCA", (half + margin) / 2);
  if (point == "R3-mid") return p.at("RCA", (margin + pda) / 2);
  if (point == "R4-mid") return p.at("RCA", (pda + crux_end) / 2);
  if (point == "RD-mid") return p.middle("PDA");
  assert(point == "RP-mid");
  return p.at("RCA", (crux_end + p.end("PLV")) / 2);
}

}  // namespace

Eigen::Vector3d place(const DodgePoint& point) {
  const double theta = point.theta_deg * degree, phi = point.phi_deg * degree;
  return point.r_cm * cm *
         Eigen::Vector3d(std::cos(phi) * std::sin(theta), std::sin(phi), std::cos(phi) * std::cos(theta));
}

Eigen::Matrix3d covariance(const DodgePoint& point) {
  const double theta = point.theta_deg * degree, phi = point.phi_deg * degree, r = point.r_cm * cm;
  Eigen::Matrix3d J;
  J.col(0) = point.r_sd_cm * cm * place(point).normalized();
  J.col(1) = point.theta_sd_deg * degree * r * std::cos(phi) * Eigen::Vector3d(std::cos(theta), 0, -std::sin(theta));
  J.col(2) = point.phi_sd_deg * degree * r *
             Eigen::Vector3d(-std::sin(phi) * std::sin(theta), std::cos(phi), -std::sin(phi) * std::cos(theta));
  return J * J.transpose();
}

Eigen::Vector3d our_place(const DodgePoint& point, const vascular::Anatomy& anatomy) {
  return in_patient(point.name, anatomy) -
         (point.right ? anatomy.landmarks.p_right_ostium : anatomy.landmarks.p_left_ostium);
}

}  // namespace ostium::app::gates
