#include "data/identification/forward/setup.h"

#include <fmt/format.h>

#include "core/base/units.h"

namespace ostium::data {

namespace {

/// At 0.08 rad the sagitta of a chord is a hundredth of its length.
constexpr double longest_element_rad = 0.08;

core::ConcentricPart part_of(const MeasurementSet& set, const Experiment& e, std::size_t i, const Changes& changes) {
  core::ConcentricPart part{set.instruments[i].sections, e.set[i].inserted_m, e.set[i].roll_rad, 0};
  for (std::size_t s = 0; s < part.sections.size(); ++s) {
    core::Section& section = part.sections[s];
    if (e.specimen[i] && !section.rest_curvature_per_m.isZero())
      section.rest_curvature_per_m.head<2>() = *e.specimen[i];
    if (changes.stiffness_scale.empty()) continue;
    for (double* stiffness : {&section.EI1_N_m2, &section.EI2_N_m2, &section.GJ_N_m2})
      *stiffness *= changes.stiffness_scale[i][s];
  }
  return part;
}

/// Full turns that the most curled instrument makes at rest.
double turns_at_rest(const ExperimentSetup& setup) {
  double most_rad = 0;
  for (const core::ConcentricPart& part : setup.nest.parts) {
    double rad = 0;
    for (const core::Section& s : part.sections)
      rad += s.rest_curvature_per_m.norm() *
             (std::min(s.to_tip_m, part.inserted_m) - std::min(s.from_tip_m, part.inserted_m));
    most_rad = std::max(most_rad, rad);
  }
  return most_rad / (2 * units::pi);
}

}  // namespace

ExperimentSetup setup_of(const MeasurementSet& set, const Experiment& experiment, const Changes& changes,
                         double longest_element_m, int view) {
  ExperimentSetup setup;
  setup.view = view;
  setup.nest.name = experiment.id;
  for (std::size_t i = 0; i < set.instruments.size(); ++i)
    setup.nest.parts.push_back(part_of(set, experiment, i, changes));
  setup.base = experiment.base;
  setup.gravity_m_s2 = set.gravity_m_s2;
  setup.tip_force_N = experiment.tip_force_N;
  // Elements end where the declared sections do, so that a boundary moved by an effect slides through elements without
  // a jump.
  std::vector<core::ConcentricPart> declared = setup.nest.parts;
  for (const ActiveEffect& active : changes.effects)
    if (active.effect->apply) active.effect->apply(active, set, experiment, setup);
  for (std::size_t i = 0; i < declared.size(); ++i) declared[i].inserted_m = setup.nest.parts[i].inserted_m;
  setup.nest.element_lengths_m = concentric_elements(declared, longest_element_m, longest_element_rad);
  if (setup.nest.element_lengths_m.size() > core::most_elements)
    throw LoadError(fmt::format(
        "{}: {} (\"{}\"): what is inserted would need {} elements, more than the {} of a rod; expected less length "
        "(inserted_mm), or less rest curvature: {:.0f} turns are none of a wire",
        set.file, experiment.place, experiment.id, setup.nest.element_lengths_m.size(), core::most_elements,
        turns_at_rest(setup)));
  return setup;
}

std::string no_static_shape(const MeasurementSet& set, const Experiment& experiment, const ExperimentSetup& setup) {
  const double force_N = setup.tip_force_N.norm(), turns = turns_at_rest(setup);
  std::string asked;
  if (set.vessel)
    asked = "on its way through the vessel it was lost; is it too long or too stiff for that?";
  else if (force_N > 0)
    asked = fmt::format("is {:.3g} N at the tip more than it can bear?", force_N);
  else if (turns >= 1)
    asked = fmt::format("nothing pulls at its tip, and of itself it makes {:.3g} turns; is its rest curvature right?",
                        turns);
  else
    asked = "nothing pulls at its tip; are stiffness, weight and rolls right?";
  return fmt::format("{}: {} (\"{}\"): no static shape was found with {:.4g} mm inserted: {}", set.file,
                     experiment.place, experiment.id, 1e3 * setup.nest.parts.back().inserted_m, asked);
}

void require_known(const MeasurementSet& set) {
  if (!set.vessel) return;
  const auto refuse = [&](const Experiment& e, const std::string& what) {
    throw LoadError(set.file + ": " + e.place + " (\"" + e.id + "\"): in a vessel " + what);
  };
  if (!set.vessel->wall)
    throw LoadError(set.file + ": environment.vessel.mesh is \"" + set.vessel->mesh + "\", which was not read");
  const Experiment& first = set.experiments.front();
  for (const Experiment& e : set.experiments) {
    if ((e.base.p_W - first.base.p_W).norm() > 1e-9 || (e.base.q_W - first.base.q_W).norm() > 1e-9)
      refuse(e, "all experiments have one base; expected that of " + first.place);
    for (std::size_t i = 0; i < e.set.size(); ++i) {
      if (e.set[i].inserted_m > e.set.back().inserted_m) refuse(e, "the innermost instrument must reach furthest");
      if (!e.specimen.empty() && e.specimen[i] != first.specimen[i]) refuse(e, "all experiments have one specimen");
    }
  }
}

}  // namespace ostium::data
