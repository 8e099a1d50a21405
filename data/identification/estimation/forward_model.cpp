#include "data/identification/estimation/forward_model.h"

#include <algorithm>
#include <stdexcept>

#include "data/identification/effects/effect.h"
#include "data/identification/forward/insertion.h"

namespace ostium::data {

namespace {

std::vector<double> packed(const PredictedShape& shape) {
  std::vector<double> out = {shape.converged ? 1.0 : 0.0, shape.base_push_N};
  for (int i = 0; i < 4; ++i) out.push_back(shape.tip_q[i]);
  const auto add = [&](const std::vector<Eigen::Vector3d>& points) {
    out.push_back(static_cast<double>(points.size()));
    for (const Eigen::Vector3d& p : points) out.insert(out.end(), {p.x(), p.y(), p.z()});
  };
  add(shape.points_m);
  for (const auto& points : shape.later_views_m) add(points);
  return out;
}

PredictedShape unpacked(const std::vector<double>& in) {
  PredictedShape shape;
  shape.converged = in[0] != 0;
  shape.base_push_N = in[1];
  for (int i = 0; i < 4; ++i) shape.tip_q[i] = in[2 + i];
  std::size_t at = 6;
  const auto next = [&] {
    std::vector<Eigen::Vector3d> points(static_cast<std::size_t>(in[at++]));
    for (Eigen::Vector3d& p : points) p = {in[at], in[at + 1], in[at + 2]}, at += 3;
    return points;
  };
  shape.points_m = next();
  while (at < in.size()) shape.later_views_m.push_back(next());
  return shape;
}

/// Appends the shape to `out`: its count of numbers, then the numbers.
void append(const PredictedShape& shape, std::vector<double>& out) {
  const std::vector<double> one = packed(shape);
  out.push_back(static_cast<double>(one.size()));
  out.insert(out.end(), one.begin(), one.end());
}

/// shapes[v][k]: the v-th of the `count` shapes appended to found[k].
std::vector<std::vector<PredictedShape>> unpacked(const std::vector<std::vector<double>>& found, std::size_t count) {
  std::vector<std::vector<PredictedShape>> shapes(count);
  for (const std::vector<double>& list : found)
    for (std::size_t v = 0, at = 0; v < count; ++v) {
      const auto length = static_cast<std::ptrdiff_t>(list[at++]);
      const auto begin = list.begin() + static_cast<std::ptrdiff_t>(at);
      shapes[v].push_back(unpacked({begin, begin + length}));
      at += static_cast<std::size_t>(length);
    }
  return shapes;
}

/// All numbers that distinguish one set of changes from another of the same model.
std::vector<double> key_of(const Changes& changes) {
  std::vector<double> key;
  for (const auto& scales : changes.stiffness_scale) key.insert(key.end(), scales.begin(), scales.end());
  for (const ActiveEffect& effect : changes.effects)
    if (effect.effect->apply) key.insert(key.end(), effect.values.begin(), effect.values.end());
  return key;
}

}  // namespace

std::vector<std::vector<PredictedShape>> ForwardModel::shapes(const std::vector<Changes>& changes,
                                                              const std::vector<int>& chosen) const {
  const std::size_t n = chosen.size();
  if (set_.vessel) return histories(changes, chosen);
  // The first starts from its anchor; the others, being close to it, start from its result.
  const auto found = workers_.map(n, [&](std::size_t job) {
    const int e = chosen[job];
    std::vector<double> out;
    StaticEquilibrium first;
    for (const Changes& changed : changes) {
      PredictedShape shape;
      try {
        const ExperimentSetup setup = setup_of(set_, set_.experiments[e], changed, longest_element_m_);
        if (&changed == &changes.front())
          shape = shape_from(setup, anchors_[e], first);
        else
          shape = shape_from(setup, first.converged ? first : anchors_[e]);
        add_later_views(set_, set_.experiments[e], changed, longest_element_m_, first.converged ? first : anchors_[e],
                        shape);
      } catch (const std::invalid_argument&) {  // these numbers do not describe a rod
        shape = PredictedShape{};
      }
      append(shape, out);
    }
    return out;
  });
  return unpacked(found, changes.size());
}

std::vector<std::vector<PredictedShape>> ForwardModel::histories(const std::vector<Changes>& changes,
                                                                 const std::vector<int>& chosen) const {
  std::vector<std::vector<double>> keys;
  std::vector<std::size_t> unknown;  // index of the first of each key not run before
  for (std::size_t v = 0; v < changes.size(); ++v) {
    keys.push_back(key_of(changes[v]));
    if (!known_.contains(keys[v]) && std::find(keys.begin(), keys.end() - 1, keys[v]) == keys.end() - 1)
      unknown.push_back(v);
  }
  // Runs all experiments, chosen or not: one history contains them all.
  const auto found = workers_.map(unknown.size(), [&](std::size_t job) {
    std::vector<PredictedShape> shapes(set_.experiments.size());
    try {
      shapes = insert(set_, changes[unknown[job]]);
    } catch (const std::invalid_argument&) {  // these numbers do not describe a rod
    }
    std::vector<double> out;
    for (const PredictedShape& shape : shapes) append(shape, out);
    return out;
  });
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    std::vector<PredictedShape> run;
    for (const auto& one : unpacked({found[k]}, set_.experiments.size())) run.push_back(one[0]);
    known_.emplace(keys[unknown[k]], std::move(run));
  }
  std::vector<std::vector<PredictedShape>> shapes(changes.size());
  for (std::size_t v = 0; v < changes.size(); ++v)
    for (int e : chosen) shapes[v].push_back(known_.at(keys[v])[e]);
  return shapes;
}

}  // namespace ostium::data
