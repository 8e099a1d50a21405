#include "tests/bench/corde.h"

#include <time.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/units.h"

namespace ostium::bench {
namespace {

using units::pi;

double area(const CordeSettings& s) { return pi * s.radius_m * s.radius_m; }
double second_moment(const CordeSettings& s) { return 0.25 * area(s) * s.radius_m * s.radius_m; }
double element_length(const CordeSettings& s) { return s.length_m / s.elements; }
double element_mass(const CordeSettings& s) { return s.density_kg_m3 * area(s) * element_length(s); }
double bending_stiffness(const CordeSettings& s) { return s.E_Pa * second_moment(s); }              // EI
double torsional_stiffness(const CordeSettings& s) { return bending_stiffness(s) / (1.0 + s.nu); }  // GJ = 2 G I
double transverse_inertia(const CordeSettings& s) {
  const double l = s.inertia == FrameInertia::cylinder ? element_length(s) : 0.0;
  return element_mass(s) * (3.0 * s.radius_m * s.radius_m + l * l) / 12.0;
}
double axial_inertia(const CordeSettings& s) { return 0.5 * element_mass(s) * s.radius_m * s.radius_m; }

double thread_cpu_s() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// column = sqrt(column). By Eigen, because std::sqrt in a loop may set errno and is not vectorised.
void square_root(std::vector<double>& column) {
  Eigen::Map<Eigen::ArrayXd> values(column.data(), static_cast<Eigen::Index>(column.size()));
  values = values.sqrt();
}

}  // namespace

Corde::Corde(const CordeSettings& settings)
    : settings_(settings),
      l_(element_length(settings)),
      K1_(bending_stiffness(settings)),
      K3_(torsional_stiffness(settings)),
      Kp_(settings.alignment_N > 0.0 ? settings.alignment_N : free_alignment_spring(settings)),
      J1_(transverse_inertia(settings)),
      J3_(axial_inertia(settings)) {
  const int n = settings_.elements;
  assert(n >= 3 && settings_.step_s > 0.0);
  for (Column* c : {&x_,  &y_,     &z_,     &vx_,    &vy_,     &vz_,     &w_,      &qw_,       &qx_,  &qy_,
                    &qz_, &o1_,    &o2_,    &o3_,    &length_, &tx_,     &ty_,     &tz_,       &fx_,  &fy_,
                    &fz_, &left1_, &left2_, &left3_, &right1_, &right2_, &right3_, &diagonal_, &off_, &lambda_})
    c->assign(n + 1, 0.0);
  const double m = element_mass(settings_);
  for (int i = 0; i <= n; ++i) {
    x_[i] = i * l_;
    w_[i] = i == 0 ? 0.0 : i == n ? 2.0 / m : 1.0 / m;
    qw_[i] = qy_[i] = std::sqrt(0.5);  // z turned to x
  }
}

// The loops below are the model's cost. `ivdep` lets the compiler vectorise them: no iteration reads what another
// writes.
void Corde::step() {
  measure_elements();
  bend_joints();
  align_frames();
  if (settings_.stretch == Stretch::penalty || settings_.stretch_friction_N_s > 0.0) pull_elements();
  if (settings_.rotation_friction_N_m2_s > 0.0) rub_joints();
  integrate_forces();
  if (settings_.stretch == Stretch::global) solve_distances_globally();
  if (settings_.stretch == Stretch::local)
    for (int k = 0; k < settings_.local_sweeps; ++k) solve_distances_locally();
  integrate_velocities();
}

/// Length of r', and the unnormalised direction; `align_frames` continues with eq. 4.
void Corde::measure_elements() {
  const int n = settings_.elements;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double x = x_[i + 1] - x_[i], y = y_[i + 1] - y_[i], z = z_[i + 1] - z_[i];
    tx_[i] = x, ty_[i] = y, tz_[i] = z;
    length_[i] = x * x + y * y + z * z;
  }
  square_root(length_);
}

/// Eq. 8, E_p = sum l K_p (1 - t . d3) with t = r' / |r'|, differentiated:
///   force on the far point   -dE_p/dr = K_p (l / |r_{i+1} - r_i|) (d3 - (t . d3) t), and its opposite on the near one
///   torque on the frame      l K_p d3 x t, which is l K_p (-d2 . t, d1 . t, 0) in material axes
void Corde::align_frames() {
  const int n = settings_.elements;
  const double Kp_l = Kp_ * l_;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double w = qw_[i + 1], x = qx_[i + 1], y = qy_[i + 1], z = qz_[i + 1];
    const double inverse = 1.0 / length_[i], a = inverse * tx_[i], b = inverse * ty_[i], c = inverse * tz_[i];
    const double d1_t = (1.0 - 2.0 * (y * y + z * z)) * a + 2.0 * ((x * y + w * z) * b + (x * z - w * y) * c);
    const double d2_t = (1.0 - 2.0 * (x * x + z * z)) * b + 2.0 * ((x * y - w * z) * a + (y * z + w * x) * c);
    const double d3x = 2.0 * (x * z + w * y), d3y = 2.0 * (y * z - w * x), d3z = 1.0 - 2.0 * (x * x + y * y);
    const double d3_t = d3x * a + d3y * b + d3z * c, pull = Kp_l * inverse;
    tx_[i] = a, ty_[i] = b, tz_[i] = c;
    fx_[i] = pull * (d3x - d3_t * a), fy_[i] = pull * (d3y - d3_t * b), fz_[i] = pull * (d3z - d3_t * c);
    right1_[i] -= Kp_l * d2_t, right2_[i] += Kp_l * d1_t;  // joint i acts on this frame, too
  }
}

/// Eqs. 3, 5 and 6 in a joint of length l between frames q and Q. B_k q is q times the k-th unit quaternion, and it is
/// skew, so 2 B_k (q + Q)/2 . (Q - q)/l is twice the k-th part of p = q* Q over l: u = (2 / l) Im p. With the moment
/// M_k = K_k u_k, differentiating V_b = l/2 sum K_k u_k^2 and taking tau_k = -1/2 dV_b/dq . (q e_k) leaves
///   torque on q: p_w M + p x M in q's axes      torque on Q: -(p_w M - p x M) in Q's
/// where p x M has no third part, since K_1 = K_2.
void Corde::bend_joints() {
  const int n = settings_.elements;
  const auto bend = [this](int j, double k1, double k3) {
    const double a = qw_[j], b = qx_[j], c = qy_[j], d = qz_[j];
    const double A = qw_[j + 1], B = qx_[j + 1], C = qy_[j + 1], D = qz_[j + 1];
    const double pw = a * A + b * B + c * C + d * D;
    const double p1 = a * B - b * A - c * D + d * C, p2 = a * C - c * A - d * B + b * D;
    const double p3 = a * D - d * A - b * C + c * B;
    const double m1 = pw * k1 * p1, m2 = pw * k1 * p2, m3 = pw * k3 * p3, turn = (k3 - k1) * p3;
    left1_[j] = m1 + turn * p2, left2_[j] = m2 - turn * p1, left3_[j] = m3;
    right1_[j] = turn * p2 - m1, right2_[j] = -turn * p1 - m2, right3_[j] = -m3;
  };
  const double k1 = 2.0 * K1_ / l_, k3 = 2.0 * K3_ / l_;
#pragma GCC ivdep
  for (int j = 1; j < n; ++j) bend(j, k1, k3);
  bend(0, 2.0 * k1, 2.0 * k3);  // the clamp's joint is half as long
}

/// Tension of eq. 2, K_s (|r'| - 1) with |r'| = |r_{i+1} - r_i| / l, and of CoRdE's friction along the tangent.
void Corde::pull_elements() {
  const int n = settings_.elements;
  const double K_s = settings_.stretch == Stretch::penalty ? settings_.stretch_Pa * area(settings_) : 0.0;
  const double friction = settings_.stretch_friction_N_s;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double x = vx_[i + 1] - vx_[i], y = vy_[i + 1] - vy_[i], z = vz_[i + 1] - vz_[i];
    const double rate = tx_[i] * x + ty_[i] * y + tz_[i] * z;
    const double tension = K_s * (length_[i] / l_ - 1.0) + friction * rate / l_;
    fx_[i] -= tension * tx_[i], fy_[i] -= tension * ty_[i], fz_[i] -= tension * tz_[i];
  }
}

/// CoRdE's rotational friction: a moment gamma_r times the relative rotation rate of neighbouring frames.
void Corde::rub_joints() {
  for (int j = 1; j < settings_.elements; ++j) {
    const Eigen::Quaterniond p = frame(j - 1).conjugate() * frame(j);
    const Eigen::Vector3d near{o1_[j], o2_[j], o3_[j]}, far{o1_[j + 1], o2_[j + 1], o3_[j + 1]};
    const Eigen::Vector3d M = settings_.rotation_friction_N_m2_s / l_ * (p * far - near), N = p.conjugate() * M;
    left1_[j] += M[0], left2_[j] += M[1], left3_[j] += M[2];
    right1_[j] -= N[0], right2_[j] -= N[1], right3_[j] -= N[2];
  }
}

/// Velocities of the points as particles, of the frames as rigid bodies: J domega/dt = tau - omega x J omega.
void Corde::integrate_forces() {
  const int n = settings_.elements;  // element n and joint n do not exist: their forces stay zero
  const double h = settings_.step_s;
  const Eigen::Vector3d g = h * settings_.gravity_m_s2;
  const double gx = g[0], gy = g[1], gz = g[2];
#pragma GCC ivdep
  for (int i = 1; i <= n; ++i) {
    const double hw = h * w_[i];
    vx_[i] += gx + hw * (fx_[i - 1] - fx_[i]);
    vy_[i] += gy + hw * (fy_[i - 1] - fy_[i]);
    vz_[i] += gz + hw * (fz_[i - 1] - fz_[i]);
  }
  const double h1 = h / J1_, h3 = h / J3_, gyro = h * (J1_ - J3_) / J1_;
#pragma GCC ivdep
  for (int k = 1; k <= n; ++k) {
    const double a = o1_[k], b = o2_[k], c = gyro * o3_[k];
    o1_[k] = a + c * b + h1 * (left1_[k] + right1_[k - 1]);
    o2_[k] = b - c * a + h1 * (left2_[k] + right2_[k - 1]);
    o3_[k] += h3 * (left3_[k] + right3_[k - 1]);
  }
}

/// Eq. 17, J W J^T lambda = -k_d J v - (k_s / h) C, with C_i = |r_{i+1} - r_i| - l: tridiagonal. Thomas algorithm from
/// both ends at once, since its cost is the latency of one division after another.
void Corde::solve_distances_globally() {
  const int n = settings_.elements, mid = n / 2;
  const double beta = settings_.k_s / settings_.step_s, k_d = settings_.k_d, l = l_;
  Column &d = diagonal_, &b = lambda_;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double x = vx_[i + 1] - vx_[i], y = vy_[i + 1] - vy_[i], z = vz_[i + 1] - vz_[i];
    d[i] = w_[i] + w_[i + 1];
    b[i] = -k_d * (tx_[i] * x + ty_[i] * y + tz_[i] * z) - beta * (length_[i] - l);
    off_[i] = -w_[i + 1] * (tx_[i] * tx_[i + 1] + ty_[i] * ty_[i + 1] + tz_[i] * tz_[i + 1]);  // rows i and i + 1
  }
  // Rows 0..mid-1 downwards and n-1..mid+1 upwards: d becomes off / pivot, b what the row says of its lambda.
  double s = 1.0 / d[0], S = 1.0 / d[n - 1], y = b[0] * s, Y = b[n - 1] * S;
  d[0] = off_[0] * s, d[n - 1] = off_[n - 2] * S, b[0] = y, b[n - 1] = Y;
  for (int i = 1, k = n - 2; i < mid; ++i, --k) {
    s = 1.0 / (d[i] - off_[i - 1] * off_[i - 1] * s), y = (b[i] - off_[i - 1] * y) * s;
    d[i] = off_[i] * s, b[i] = y;
    if (k == mid) continue;
    S = 1.0 / (d[k] - off_[k] * off_[k] * S), Y = (b[k] - off_[k] * Y) * S;
    d[k] = off_[k - 1] * S, b[k] = Y;
  }
  const double e = off_[mid - 1], E = off_[mid];
  y = Y = b[mid] = (b[mid] - e * y - E * Y) / (d[mid] - e * e * s - E * E * S);
  for (int i = mid - 1, k = mid + 1; i >= 0; --i, ++k) {
    b[i] = y = b[i] - d[i] * y;
    b[k] = Y = b[k] - d[k] * Y;  // with n even the last of these is b[n], of no row
  }
  b[n] = 0.0;
#pragma GCC ivdep
  for (int i = 1; i <= n; ++i) {  // v += W J^T lambda
    vx_[i] += w_[i] * (b[i - 1] * tx_[i - 1] - b[i] * tx_[i]);
    vy_[i] += w_[i] * (b[i - 1] * ty_[i - 1] - b[i] * ty_[i]);
    vz_[i] += w_[i] * (b[i - 1] * tz_[i - 1] - b[i] * tz_[i]);
  }
}

/// Eq. 17 one row at a time, each with the velocities its predecessors left.
void Corde::solve_distances_locally() {
  const double beta = settings_.k_s / settings_.step_s, k_d = settings_.k_d;
  for (int i = 0; i < settings_.elements; ++i) {
    const double a = tx_[i], b = ty_[i], c = tz_[i], near = w_[i], far = w_[i + 1];
    const double rate = a * (vx_[i + 1] - vx_[i]) + b * (vy_[i + 1] - vy_[i]) + c * (vz_[i + 1] - vz_[i]);
    const double lambda = -(k_d * rate + beta * (length_[i] - l_)) / (near + far);
    vx_[i] -= near * lambda * a, vy_[i] -= near * lambda * b, vz_[i] -= near * lambda * c;
    vx_[i + 1] += far * lambda * a, vy_[i + 1] += far * lambda * b, vz_[i + 1] += far * lambda * c;
  }
}

/// Semi-implicit Euler: positions and frames with the new velocities, dq/dt = q omega / 2, and eq. 9 by projection.
void Corde::integrate_velocities() {
  const int n = settings_.elements;
  const double h = settings_.step_s;
  Column& norm = diagonal_;
#pragma GCC ivdep
  for (int i = 1; i <= n; ++i) x_[i] += h * vx_[i], y_[i] += h * vy_[i], z_[i] += h * vz_[i];
#pragma GCC ivdep
  for (int k = 0; k <= n; ++k) {
    const double a = 0.5 * h * o1_[k], b = 0.5 * h * o2_[k], c = 0.5 * h * o3_[k];
    const double w = qw_[k], x = qx_[k], y = qy_[k], z = qz_[k];
    const double W = w - x * a - y * b - z * c, X = x + w * a + y * c - z * b;
    const double Y = y + w * b + z * a - x * c, Z = z + w * c + x * b - y * a;
    qw_[k] = W, qx_[k] = X, qy_[k] = Y, qz_[k] = Z;
    norm[k] = W * W + X * X + Y * Y + Z * Z;
  }
  square_root(norm);
#pragma GCC ivdep
  for (int k = 0; k <= n; ++k) {
    const double scale = 1.0 / norm[k];
    qw_[k] *= scale, qx_[k] *= scale, qy_[k] *= scale, qz_[k] *= scale;
  }
}

// --- looking at the rod, posing it -----------------------------------------------------------------------------------
Eigen::Quaterniond Corde::frame(int element) const {
  const int k = element + 1;
  return {qw_[k], qx_[k], qy_[k], qz_[k]};
}

double Corde::stretch_percent() const {
  double sum = 0.0;
  for (int i = 0; i < settings_.elements; ++i) sum += (position(i + 1) - position(i)).norm();
  return 100.0 * (sum / settings_.length_m - 1.0);
}

double Corde::misalignment() const {
  double most = 0.0;
  for (int i = 0; i < settings_.elements; ++i) {
    const Eigen::Vector3d d3 = frame(i) * Eigen::Vector3d::UnitZ(), t = position(i + 1) - position(i);
    most = std::max(most, std::atan2(d3.cross(t).norm(), d3.dot(t)));
  }
  return most;
}

Eigen::Vector3d Corde::moment_N_m(int element) const {
  const Eigen::Quaterniond p = frame(element - 1).conjugate() * frame(element);  // frame -1 is the clamp's
  return 2.0 / (element == 0 ? 0.5 * l_ : l_) * Eigen::Vector3d(K1_ * p.x(), K1_ * p.y(), K3_ * p.z());
}

double Corde::energy_J() const {
  double energy = 0.0;
  const double K_s = settings_.stretch == Stretch::penalty ? settings_.stretch_Pa * area(settings_) : 0.0;
  for (int i = 1; i <= settings_.elements; ++i) {
    const Eigen::Vector3d v(vx_[i], vy_[i], vz_[i]), moved = position(i) - Eigen::Vector3d(i * l_, 0.0, 0.0);
    energy += (0.5 * v.squaredNorm() - settings_.gravity_m_s2.dot(moved)) / w_[i];
    energy += 0.5 * (J1_ * (o1_[i] * o1_[i] + o2_[i] * o2_[i]) + J3_ * o3_[i] * o3_[i]);
    const Eigen::Vector3d M = moment_N_m(i - 1), e = position(i) - position(i - 1);
    energy += (i == 1 ? 0.25 : 0.5) * l_ * ((M[0] * M[0] + M[1] * M[1]) / K1_ + M[2] * M[2] / K3_);
    energy += l_ * Kp_ * (1.0 - e.normalized().dot(frame(i - 1) * Eigen::Vector3d::UnitZ()));
    energy += 0.5 * l_ * K_s * (e.norm() / l_ - 1.0) * (e.norm() / l_ - 1.0);
  }
  return energy;
}

void Corde::set_frame(int element, const Eigen::Quaterniond& q) {
  const int k = element + 1;
  qw_[k] = q.w(), qx_[k] = q.x(), qy_[k] = q.y(), qz_[k] = q.z();
}

void Corde::set_spin(int element, const Eigen::Vector3d& omega) {
  const int k = element + 1;
  o1_[k] = omega[0], o2_[k] = omega[1], o3_[k] = omega[2];
}

// --- experiments ----------------------------------------------------------------------------------------------------
/// Squared frequency of the fastest modes, neighbours in opposite phase. Frames alone: 4 K_k / (l J_k). With the
/// penalty, frames against tangents: at most (4 K_1 / l + l K_p) / J_1 + 4 K_p / (l m), the trace of the 2 x 2 problem.
double free_alignment_spring(const CordeSettings& s) {
  const double l = element_length(s), m = element_mass(s), J1 = transverse_inertia(s), J3 = axial_inertia(s);
  const double bend = 4.0 * bending_stiffness(s) / (l * J1), twist = 4.0 * torsional_stiffness(s) / (l * J3);
  return (1.1 * std::max(bend, twist) - bend) / (l / J1 + 4.0 / (l * m));
}

bool is_stable(CordeSettings s, double step_s, double trial_s) {
  s.step_s = step_s;
  Corde rod(s);
  // Excites all modes: from rest in a plane, twist would stay exactly zero.
  std::uint32_t seed = 1;
  const auto noise = [&seed] {
    seed = 1664525u * seed + 1013904223u;  // Numerical Recipes' linear congruential generator
    return 1e-3 * (seed / 2147483648.0 - 1.0);
  };
  for (int i = 0; i < s.elements; ++i) {
    const double a = noise(), b = noise(), c = noise();
    rod.set_spin(i, {a, b, c});
  }
  const int steps = std::max(2000, static_cast<int>(std::ceil(trial_s / step_s)));
  // Bounded modes stay far below one per cent of the rod's weight times length; growing ones exceed it quickly.
  const double limit = rod.energy_J() * 10.0 + 0.01 * element_mass(s) * s.elements * s.length_m * s.gravity_m_s2.norm();
  for (int i = 1; i <= steps; ++i) {
    rod.step();
    if (i % 100 == 0 && !(rod.energy_J() < limit)) return false;  // not-a-number fails as well
  }
  return true;
}

double largest_stable_step(const CordeSettings& s, double trial_s) {
  const double l = element_length(s);
  double stable = 0.5 * l / std::sqrt(s.E_Pa / s.density_kg_m3);  // half the time a sound wave takes for an element
  while (!is_stable(s, stable, trial_s)) stable *= 0.5;
  double unstable = 2.0 * stable;
  while (is_stable(s, unstable, trial_s)) stable = unstable, unstable *= 2.0;
  while (unstable > 1.005 * stable) {
    const double middle = std::sqrt(stable * unstable);
    (is_stable(s, middle, trial_s) ? stable : unstable) = middle;
  }
  return stable;
}

double cpu_ms_per_simulated_ms(const CordeSettings& s, double simulated_s) {
  Corde rod(s);
  const int steps = static_cast<int>(std::ceil(simulated_s / s.step_s));
  for (int i = 0; i < steps / 4; ++i) rod.step();
  const double start = thread_cpu_s();
  for (int i = 0; i < steps; ++i) rod.step();
  return (thread_cpu_s() - start) / (steps * s.step_s);
}

double stretch_percent(const CordeSettings& s, double duration_s) {
  Corde rod(s);
  const int steps = static_cast<int>(std::ceil(duration_s / s.step_s));
  double most = 0.0;
  for (int i = 0; i < steps; ++i) {
    rod.step();
    const double now = std::fabs(rod.stretch_percent());
    if (!(now < 1e4)) return std::numeric_limits<double>::infinity();
    most = std::max(most, now);
  }
  return most;
}

CordeSettings soft_rod(int elements, double step_s, Stretch stretch, int local_sweeps) {
  CordeSettings s;
  s.elements = elements;
  s.length_m = 1.0 * elements;
  s.radius_m = 0.25;
  s.E_Pa = 60e6;
  s.density_kg_m3 = 1000.0;
  s.rotation_friction_N_m2_s = 100.0;
  s.step_s = step_s;
  s.stretch = stretch;
  s.local_sweeps = local_sweeps;
  // A chain of springs is stable up to h sqrt(4 E_s A / (l m)) = 2, that is E_s = rho l^2 / h^2; at
  // 1,024 elements and 5 ms, where the springs stretch by half, nine tenths of it already fail.
  const double l = element_length(s);
  s.stretch_Pa = 0.8 * s.density_kg_m3 * l * l / (step_s * step_s);
  return s;
}

double swing_s(const CordeSettings& s) { return 3.0 * std::sqrt(s.length_m / s.gravity_m_s2.norm()); }

}  // namespace ostium::bench
