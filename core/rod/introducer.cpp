#include "core/rod/introducer.h"

#include <algorithm>
#include <cmath>

#include "core/math/alignment.h"
#include "core/math/rotation.h"
#include "core/model/report.h"

namespace ostium::core {

namespace {

using Eigen::Vector3d;

// Share of an element at which it enters, and at which it leaves; different, so that a trembling hand does not switch
// elements back and forth.
constexpr double enters_at = 0.6, leaves_at = 0.4;
constexpr int least_inserted_elements = 3;
constexpr double slack_kept = 0.8;  // per step

/// q turned by theta in its own material frame.
Q4<double> turned_by(const Q4<double>& q, const V3<double>& theta) {
  const Vector3d t = to_eigen(theta);
  const double angle = t.norm();
  if (angle == 0) return q;
  return from_eigen((to_eigen(q) * Eigen::AngleAxisd(angle, t / angle)).normalized());
}

/// Length of the base element.
double base_length(const Rod& rod, const RodState& s) {
  return s.inserted_m + s.slack_m - rod.node_from_tip_m[s.first + 1];
}

/// Splits the base element: the length beyond its own becomes a new base element. Curvature at the base and distal to
/// the element is kept; in between it is interpolated.
void enter_element(const Rod& rod, const RodInputs& inputs, double step_s, RodState& s) {
  const int old = s.first, base = old - 1;
  const double before = base_length(rod, s), own = rod.length.at(0)[old], after = before - own;
  const double next = rod.length.at(0)[old + 1];

  const Q4<double> clamp = s.base.frame(), q_old = load4<double>(s.orientation, old),
                   q_next = load4<double>(s.orientation, old + 1);
  const V3<double> base_curvature = (2 / before) * rotation_vector(conjugate(clamp) * q_old);
  const V3<double> next_curvature = (2 / (before + next)) * rotation_vector(conjugate(q_old) * q_next);
  const Q4<double> q_base = turned_by(clamp, (after / 2) * base_curvature);
  store4(s.orientation, base, q_base);
  const Q4<double> q_split = turned_by(q_next, (-(own + next) / 2) * next_curvature);
  store4(s.orientation, old, q_split);

  // The new node between them moves with the material there.
  const double part = after / before;
  const Vector3d feed_velocity = inputs.base.velocity_W_m_s + inputs.feed_m_s * axis(s.base);
  const auto blend = [&](const Vector3d& distal) -> Vector3d {
    return feed_velocity + part * (distal - feed_velocity);
  };
  const Vector3d base_axis = to_eigen(director3(q_base)), split_axis = to_eigen(director3(q_split));
  const double slack = split_axis.dot(s.position[old + 1] - s.base.p_W - after * base_axis) - own;
  const Vector3d r = s.base.p_W + (after + slack) * base_axis;
  s.slack_m += slack;
  s.velocity.set(old, blend(s.velocity[old + 1]));
  s.velocity_before.set(old, blend(s.velocity_before[old + 1]));
  const Vector3d last_move = s.position[old + 1] - s.position_before[old + 1];
  const Vector3d fed = step_s * feed_velocity;
  s.position.set(old, r);
  s.position_before.set(old, r - (fed + part * (last_move - fed)));
  s.position.set(base, s.base.p_W);
  s.position_before.set(base, s.base.p_W);
  for (Field<3>* f : {&s.velocity, &s.velocity_before}) f->set(base, Vector3d::Zero());
  for (Field<3>* f : {&s.turn, &s.turn_before, &s.force}) f->set(base, (*f)[old]);
  if (s.strain.size() > 0)
    for (Field<3>* f : {&s.strain, &s.strain_before}) {
      f->set(base, (*f)[old]);
      f->set(old, 0.5 * ((*f)[old] + (*f)[old + 1]));
    }
  for (Field<3>* f : {&s.contact_force, &s.offset, &s.wall_force, &s.rod_force})
    if (f->size() > 0) f->set(base, Vector3d::Zero());
  for (Field<2>* f : {&s.slip, &s.wall_slip})
    if (f->size() > 0) f->set(base, Eigen::Vector2d::Zero());
  s.first = base;
}

/// Merges the base element and the next one, along the chord from the introducer to the next one's distal node.
void leave_element(const Rod& rod, RodState& s) {
  const int next = s.first + 1;
  const Q4<double> q = load4<double>(s.orientation, next);
  const Vector3d chord = s.position[next + 1] - s.base.p_W;
  s.slack_m = chord.norm() - (s.inserted_m - rod.node_from_tip_m[next + 1]);
  const Eigen::Quaterniond onto_chord = rotation_between(to_eigen(director3(q)), chord);
  store4(s.orientation, next, from_eigen((onto_chord * to_eigen(q)).normalized()));
  s.position.set(next, s.base.p_W);
  s.position_before.set(next, s.base.p_W);
  for (Field<3>* f : {&s.velocity, &s.velocity_before}) f->set(next, Vector3d::Zero());
  if (s.strain.size() > 0)
    for (Field<3>* f : {&s.strain, &s.strain_before}) f->set(next, (*f)[next - 1]);
  for (Field<3>* f : {&s.contact_force, &s.offset, &s.wall_force, &s.rod_force})
    if (f->size() > 0) f->set(next, Vector3d::Zero());
  s.first = next;
}

/// Lets the tip appear at the introducer, unloaded and moving with the hand.
void appear(const Rod& rod, const RodInputs& inputs, double step_s, RodState& s) {
  const int first = rod.elements - least_inserted_elements, N = rod.elements;
  s.first = first, s.slack_m = 0;
  const Vector3d velocity = inputs.base.velocity_W_m_s + inputs.feed_m_s * axis(s.base);
  Q4<double> q = s.base.frame();
  Vector3d p = s.base.p_W;
  for (int i = first; i <= N; ++i) {
    const Vector3d moves = i == first ? Vector3d::Zero() : velocity;
    s.position.set(i, p);
    s.position_before.set(i, p - step_s * moves);
    for (Field<3>* f : {&s.velocity, &s.velocity_before}) f->set(i, moves);
    if (s.strain.size() > 0)
      for (Field<3>* f : {&s.strain, &s.strain_before}) f->set(i, i < N ? rod.rest_curvature[i] : Vector3d(0, 0, 0));
    if (i == N) break;
    const double length = i == first ? base_length(rod, s) : rod.length.at(0)[i];
    q = turned_by(q, (i == first ? length / 2 : rod.joint_length.at(0)[i]) * load3<double>(rod.rest_curvature, i));
    store4(s.orientation, i, q);
    for (Field<3>* f : {&s.turn, &s.turn_before, &s.force}) f->set(i, Vector3d::Zero());
    p += length * to_eigen(director3(q));
  }
  for (Field<3>* f : {&s.contact_force, &s.offset, &s.wall_force, &s.rod_force})
    std::fill(f->raw().begin(), f->raw().end(), 0.0);
  for (Field<2>* f : {&s.slip, &s.wall_slip}) std::fill(f->raw().begin(), f->raw().end(), 0.0);
}

}  // namespace

bool in_body(const Rod& rod, const RodState& state) { return state.first < rod.elements; }

Vector3d axis(const EndState& end) { return to_eigen(director3(end.frame())); }

double least_inserted_m(const Rod& rod) { return rod.node_from_tip_m[rod.elements - least_inserted_elements]; }

int first_element_for(const Rod& rod, double inserted_m) {
  if (inserted_m < least_inserted_m(rod)) return rod.elements;
  int first = 0;
  while (first < rod.elements - least_inserted_elements &&
         inserted_m - rod.node_from_tip_m[first + 1] < leaves_at * rod.length.at(0)[first])
    ++first;
  return first;
}

void cut_at_introducer(const Rod& rod, const RodState& state, Rod& inside) {
  cut(rod, state.inserted_m + state.slack_m, state.first, inside);
}

void renew_elements(const Rod& rod, const RodInputs& inputs, double step_s, RodState& s) {
  if (inputs.base.hold != Hold::clamped || (inputs.feed_m_s == 0 && s.slack_m == 0) || !in_body(rod, s)) return;
  const auto first = [&] { return s.first; };
  while (first() > 0 && base_length(rod, s) > rod.length.at(0)[first()] + enters_at * rod.length.at(0)[first() - 1])
    enter_element(rod, inputs, step_s, s);
  while (first() < rod.elements - least_inserted_elements &&
         base_length(rod, s) < leaves_at * rod.length.at(0)[first()])
    leave_element(rod, s);
}

void feed(const Rod& rod, const RodInputs& inputs, double step_s, RodState& s, std::uint32_t& trouble) {
  if (inputs.base.hold != Hold::clamped || (inputs.feed_m_s == 0 && s.slack_m == 0)) return;
  s.slack_m = std::fabs(s.slack_m) > 1e-15 ? slack_kept * s.slack_m : 0;
  const double asked = s.inserted_m + step_s * inputs.feed_m_s;
  s.inserted_m = std::clamp(asked, 0.0, rod.total_length_m);
  if (s.inserted_m != asked) trouble |= feed_stopped;
  // Different limits, so that a trembling hand does not take it out and in again.
  if (s.inserted_m < least_inserted_m(rod))
    s.first = rod.elements, s.slack_m = 0;
  else if (!in_body(rod, s) &&
           s.inserted_m > least_inserted_m(rod) + rod.length.at(0)[rod.elements - least_inserted_elements] / 10)
    appear(rod, inputs, step_s, s);
}

}  // namespace ostium::core
