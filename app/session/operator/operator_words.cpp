#include <fmt/format.h>

#include <cmath>

#include "app/session/operator/condition_evaluator.h"
#include "app/session/operator/operator.h"
#include "app/session/operator/operator_actions.h"

namespace ostium::app {

namespace {

using Kind = data::ConditionKind;

bool needs_balloon(Kind kind) {
  return kind == Kind::balloon_at || kind == Kind::balloon_within || kind == Kind::balloon_spans ||
         kind == Kind::balloon_clear || kind == Kind::balloon_open || kind == Kind::distal_marker_at;
}

bool needs_tool_in_body(Kind kind) {
  const data::ConditionValue value = data::row_of(kind).value;
  return data::row_of(kind).of == data::ConditionOf::tool &&
         (value == data::ConditionValue::place || value == data::ConditionValue::branch ||
          value == data::ConditionValue::direction);
}

/// " (now 12.3)", " (no balloon is in the body)": what was seen of a condition that does not hold; "" if that is all.
std::string seen(const ConditionEvaluator& e, const data::ScriptCondition& c, int place) {
  if (needs_balloon(c.kind) && !e.balloon()) return " (no balloon is in the body)";
  if (needs_tool_in_body(c.kind) && !e.tool(c.tool).in_body)
    return fmt::format(" ({} is out of the body)", e.plan.script.tools[static_cast<std::size_t>(c.tool)].name);
  if ((c.kind == Kind::engaged || c.kind == Kind::trace) && e.session.coupling.guide < 0)
    return " (no catheter is in the body)";
  if (c.kind == Kind::trace) return fmt::format(" (now {})", trace_name(e.session.blood.line.trace));
  if (c.kind == Kind::contrast_in)
    return e.beam_is_on() ? fmt::format(" (now {:.3g} mg/mL, seen from {:g})", e.contrast_kg_m3(place), visible_kg_m3)
                          : " (the beam is off)";
  const double found = e.measured(c);
  return std::isfinite(found) ? fmt::format(" (now {:.4g})", found / data::row_of(c.kind).unit) : "";
}

/// ", waiting for fed_mm 30 (now 12.3) or tip_passes arch": what would have ended the step.
std::string waiting(const ConditionEvaluator& e) {
  const auto s = static_cast<std::size_t>(e.state.step);
  const data::ScriptStep& step = e.plan.script.steps[s];
  std::string words;
  for (std::size_t i = 0; i < step.until.size(); ++i)
    words += (i == 0 ? "" : " or ") + step.until[i].words + seen(e, step.until[i], e.plan.until_places[s][i]);
  if (words.empty()) words = end_of_action(step, e);
  if (needs_catheter(step.action) && e.session.coupling.guide < 0) words += "; no catheter is in the body";
  return ", waiting for " + words;
}

}  // namespace

std::string words_for(Outcome outcome) {
  switch (outcome) {
    case Outcome::running:
      return "running";
    case Outcome::success:
      return "success";
    case Outcome::failure:
    case Outcome::timed_out:
      return "failure";
    case Outcome::aborted:
      return "aborted";
    case Outcome::ended:
      return "ended";
  }
  return "";
}

std::string reason(const ScriptPlan& plan, const SessionModel& model, const SessionState& session,
                   const SessionReport& report, const OperatorState& state) {
  const auto outcome = state.outcome;
  const auto s = static_cast<std::size_t>(state.step);
  if (outcome == Outcome::ended) return "by the operator";
  if (outcome == Outcome::success || s >= plan.script.steps.size()) return "";
  const data::ScriptStep& step = plan.script.steps[s];
  const std::string where = fmt::format("step {} of {}, {}", s + 1, plan.script.steps.size(), step.words());
  if (outcome == Outcome::timed_out)
    return fmt::format("{}: timed out after {:g} s", where, step.timeout_s) +
           waiting({plan, model, session, report, state});
  if (const Obstacle other = report.refused < 0 ? Obstacle{} : in_the_way(model, session.rods, report.refused);
      other.lacks_m > 0)
    return fmt::format("{}: the lumen lacks {:.2f} mm for {} to lie beside {}; withdraw that, or take a wider guide",
                       where, 1e3 * other.lacks_m, model.tools[static_cast<std::size_t>(report.refused)].name,
                       model.tools[static_cast<std::size_t>(other.tool)].name);
  if (state.in_the_way >= 0)
    return fmt::format("{}: {} is still in the body, and nothing can enter beside it; withdraw it first", where,
                       plan.script.tools[static_cast<std::size_t>(state.in_the_way)].name);
  if (outcome == Outcome::failure)
    return fmt::format("{}: {}", where, step.unless[static_cast<std::size_t>(state.by_condition)].words);
  return outcome == Outcome::aborted ? "ended by the operator, in " + where : where;
}

std::string where_tips_lie(const SessionModel& model, const SessionState& session, const SessionReport& report) {
  std::string words;
  if (!model.has_patient()) return words;
  const VesselIndex& way = *model.vessel->way;
  for (std::size_t t = 0; t < report.tools.size(); ++t) {
    if (!report.tools[t].in_body) continue;
    const int at =
        way.locate(tip(model, session, static_cast<int>(t)), session.blood.heart.phase, breath(model, session));
    const std::string& branch = way.branches()[static_cast<std::size_t>(way.branch(at))].name;
    const double into_m = way.from_access_m(at) - way.from_access_m(way.entry(branch));
    words +=
        fmt::format("{}{} {:.0f} mm into {}", words.empty() ? "" : ", ", model.tools[t].name, 1e3 * into_m, branch);
  }
  return words;
}

}  // namespace ostium::app
