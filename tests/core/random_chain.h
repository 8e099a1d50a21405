#pragma once
/// Random linear systems of chains for tests of the solver.
#include <Eigen/Dense>
#include <random>
#include <vector>

#include "core/base/tolerances.h"
#include "core/solver/block_tridiagonal.h"

namespace ostium::core {

/// v x w as a matrix that acts on w.
inline Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// A random chain and the same system as a dense matrix.
struct RandomChain {
  RandomChain(int N, unsigned seed, double softening = 0, int rolls = 0)
      : chain(N, rolls), matrix(Eigen::MatrixXd::Zero((6 + rolls) * N, (6 + rolls) * N)), right((6 + rolls) * N) {
    std::mt19937 generator(seed);
    std::normal_distribution<> normal;
    const auto vector = [&]() -> Eigen::Vector3d { return {normal(generator), normal(generator), normal(generator)}; };
    const auto spd = [&] {
      Eigen::Matrix3d a;
      a << vector(), vector(), vector();
      return Eigen::Matrix3d(a * a.transpose());
    };
    const auto six = [](const Eigen::Matrix3d& m) {
      Eigen::Matrix<double, 6, 1> v;
      v << m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2);
      return v;
    };
    std::vector<Eigen::Matrix3d> P, H;
    std::vector<Eigen::Vector3d> m;
    for (int i = 0; i <= N; ++i) {
      P.push_back(i == 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Zero()) : spd());  // the base is held
      H.push_back(spd());
      m.push_back(vector());
      chain.compliance.set(i, six(P[i]));
      chain.joint_stiffness.set(i, six(H[i]));
      chain.joint_moment.set(i, m[i]);
    }
    for (int j = 0; j < N; ++j) {
      const Eigen::Matrix3d K = H[j] + H[j + 1] + 3 * spd() - softening * Eigen::Matrix3d::Identity();
      const Eigen::Vector3d d = vector(), torque = vector(), gap = vector();
      chain.stiffness.set(j, six(K));
      chain.arm.set(j, d);
      chain.torque.set(j, torque);
      chain.gap.set(j, gap);
      const int at = 6 * j;
      matrix.block<3, 3>(at, at) = K;
      matrix.block<3, 3>(at, at + 3) = -cross_matrix(d);
      matrix.block<3, 3>(at + 3, at) = cross_matrix(d);
      matrix.block<3, 3>(at + 3, at + 3) = -(P[j] + P[j + 1] + tolerances::axial_give_per_N_m * d * d.transpose());
      if (j + 1 < N) {
        matrix.block<3, 3>(at, at + 6) = -H[j + 1] + 0.5 * cross_matrix(m[j + 1]);
        matrix.block<3, 3>(at + 3, at + 9) = P[j + 1];
      }
      if (j > 0) {
        matrix.block<3, 3>(at, at - 6) = -H[j] - 0.5 * cross_matrix(m[j]);
        matrix.block<3, 3>(at + 3, at - 3) = P[j];
      }
      right.segment<3>(at) = torque;
      right.segment<3>(at + 3) = gap;
    }
    const auto couple = [&](int a, int b, double c) { matrix(a, b) = matrix(b, a) = c; };
    for (int n = 0; n < rolls; ++n) {
      Roll& roll = chain.rolls[n];
      const auto at = [&](int j) { return 6 * N + n * N + j; };
      for (int j = 0; j < N; ++j) {
        const Eigen::Vector3d b = vector();
        roll.stiffness.at(0)[j] = matrix(at(j), at(j)) = 40;
        roll.with_turn.set(j, b);
        for (int k = 0; k < 3; ++k) couple(6 * j + k, at(j), b[k]);
        roll.torque.at(0)[j] = right[at(j)] = normal(generator);
        if (n > 0) couple(at(j) - N, at(j), roll.beside.at(0)[j] = normal(generator));
        if (j == 0) continue;
        const Eigen::Vector3d u = vector(), w = vector();
        roll.ahead.set(j, u), roll.behind.set(j, w);
        for (int k = 0; k < 3; ++k) couple(6 * (j - 1) + k, at(j), u[k]), couple(at(j - 1), 6 * j + k, w[k]);
        couple(at(j - 1), at(j), roll.both.at(0)[j] = normal(generator));
      }
    }
  }

  Eigen::VectorXd solution() const {
    Eigen::VectorXd x(right.size());
    const int N = chain.elements;
    for (int j = 0; j < N; ++j) {
      x.segment<3>(6 * j) = chain.turn[j], x.segment<3>(6 * j + 3) = chain.force[j];
      for (std::size_t m = 0; m < chain.rolls.size(); ++m)
        x[6 * N + static_cast<int>(m) * N + j] = chain.rolls[m].turn.at(0)[j];
    }
    return x;
  }
  double relative_error() const {
    const Eigen::VectorXd exact = matrix.fullPivLu().solve(right);
    return (solution() - exact).norm() / exact.norm();
  }

  BlockTridiagonal chain;
  Eigen::MatrixXd matrix;
  Eigen::VectorXd right;
};

}  // namespace ostium::core
