#pragma once
/// A wire as a chain of nodes with torsion springs between them, friction at some, and a pull towards an angle at
/// others.
#include <Eigen/Core>
#include <vector>

namespace ostium::data::torque_response {

struct Node {
  double compliance = 0;  ///< of the spring towards the drive, rad/(N m)
  double most_Nm = 0;     ///< friction
  /// Torque pull_Nm[1] cos(angle) - pull_Nm[0] sin(angle), from a curvature at rest in a bend.
  double pull_Nm[2]{};
};

class TwistedChain {
 public:
  /// `handed`: stiffness under positive torque against that under negative.
  TwistedChain(std::vector<Node> nodes, double handed);

  void turn(double proximal_rad);
  double distal_rad() const;
  double torque_Nm() const;  ///< at the drive

 private:
  using Vector = Eigen::VectorXd;
  enum class State { stands, slips_up, slips_down };

  void settle(const Vector& before);
  bool relax();  ///< Newton's method for the nodes that slip; false if it did not settle
  double stiffness(Eigen::Index spring) const;
  double twist(Eigen::Index spring) const { return (spring > 0 ? angle_[spring - 1] : proximal_) - angle_[spring]; }
  double net(Eigen::Index node) const;
  double free_of(Eigen::Index node) const;

  std::vector<Node> nodes_;
  double root_of_handed_;
  bool pulled_ = false;
  double most_turned_ = 0, proximal_ = 0;
  Vector spring_;  ///< stiffness towards the drive
  Vector angle_;
  std::vector<State> state_;
};

}  // namespace ostium::data::torque_response
