#include "app/session/live/emergency.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/units.h"

namespace ostium::app {

namespace {

using data::ConsoleCommand, data::ConsoleOrder;

constexpr std::size_t most_waiting = 100;  // a thousand steps a second: nobody asks faster

const Provocable& provocable(double what) { return provocables[static_cast<std::size_t>(what) - 1]; }

std::string why_no_provocation(const vascular::FlowTree& tree, const ConsoleOrder& order) {
  const auto& [kind, artery, place_mm, size] = order.values;
  const Provocable& what = provocable(kind);
  if (size < what.least || size > what.most)
    return fmt::format("{} has no size {:g}; expected {:g} to {:g} ({})",
                       vascular::provocation_names[static_cast<int>(what.kind)], size, what.least, what.most,
                       what.size ? what.size : "none");
  if (!what.has_place) return "";
  if (artery >= static_cast<double>(tree.branches.size()))
    return fmt::format("there is no artery {:g}; expected 0 to {}", artery, tree.branches.size() - 1);
  const vascular::FlowBranch& branch = tree.branches[static_cast<std::size_t>(artery)];
  const double from_mm = 1e3 * tree.s_of(branch.first), to_mm = 1e3 * tree.s_of(branch.last - 1);
  if (place_mm < from_mm - 1 || place_mm > to_mm + 1)
    return fmt::format("{} has no place {:g} mm; expected {:.0f} to {:.0f} mm from its beginning", branch.name,
                       place_mm, from_mm, to_mm);
  return "";
}

}  // namespace

std::string why_not(const SessionModel& model, const ConsoleOrder& order) {
  if (data::row_of(order.command).patient && !model.has_patient()) return "no blood flows in this vessel";
  if (order.command == ConsoleCommand::provoke) return why_no_provocation(model.vessel->coronaries->tree(), order);
  if (order.command == ConsoleCommand::breath && !(model.breaths_1_min > 0))
    return "this patient does not breathe; expected --set breathing=12 or so";
  if (order.command != ConsoleCommand::give) return "";
  const auto& drugs = model.treatment.drugs.others;
  if (order.values[0] >= static_cast<double>(drugs.size())) {
    std::string known;
    for (std::size_t d = 0; d < drugs.size(); ++d) known += fmt::format("{}{} {}", d > 0 ? ", " : "", d, drugs[d].name);
    return fmt::format("there is no drug {:g}; expected one of {}", order.values[0], known);
  }
  const vascular::Drug& drug = drugs[static_cast<std::size_t>(order.values[0])];
  if (order.values[1] < drug.least || order.values[1] > drug.most)
    return fmt::format("{:g} {} of {}; expected {:g} to {:g} {}", order.values[1], drug.unit, drug.name, drug.least,
                       drug.most, drug.unit);
  return "";
}

bool Emergency::take(const SessionModel& model, const ConsoleOrder& order) {
  // An order counts for more than how it was.
  if (gone_back_to_ && order.command == ConsoleCommand::infuse) gone_back_to_->infusion_m3_s = 0;
  if (gone_back_to_ && order.command == ConsoleCommand::drain) gone_back_to_->drain_m3_s = 0;
  if (gone_back_to_ && order.command == ConsoleCommand::compress) gone_back_to_->compressions_1_min = 0;
  switch (order.command) {
    case ConsoleCommand::infuse:
      infusion_m3_s_ = order.values[0] * units::mL_min;
      return true;
    case ConsoleCommand::drain:
      drain_m3_s_ = order.values[0] * units::mL_min;
      return true;
    case ConsoleCommand::compress:
      compressions_1_min_ = order.values[0];
      return true;
    case ConsoleCommand::pace:
      pacing_ = {order.values[0], order.values[1]};
      return true;
    case ConsoleCommand::breath:
      if (why_not(model, order).empty()) breath_asked_ = static_cast<int>(order.values[0]);
      return true;
    case ConsoleCommand::give:
    case ConsoleCommand::shock:
    case ConsoleCommand::provoke:
      if (why_not(model, order).empty() && once_.size() < most_waiting) once_.push_back(order);
      return true;
    default:
      return false;
  }
}

void Emergency::fill(const SessionModel& model, DeliveryInputs& to) {
  if (gone_back_to_) {
    const DeliveryInputs& was = *gone_back_to_;
    const auto take = [](double& own, double then, double of_script) {
      if (own == 0 && then > of_script) own = then;
    };
    take(infusion_m3_s_, was.infusion_m3_s, to.infusion_m3_s), take(drain_m3_s_, was.drain_m3_s, to.drain_m3_s);
    take(compressions_1_min_, was.compressions_1_min, to.compressions_1_min);
    if (!pacing_ && (was.pacing_mA != to.pacing_mA || was.pacing_1_min != to.pacing_1_min))
      pacing_ = {was.pacing_1_min, was.pacing_mA};
    if (!breath_asked_ && was.breath_asked != to.breath_asked) breath_asked_ = was.breath_asked;
    gone_back_to_.reset();
  }
  to.infusion_m3_s = std::max(to.infusion_m3_s, infusion_m3_s_);
  to.drain_m3_s = std::max(to.drain_m3_s, drain_m3_s_);
  to.compressions_1_min = std::max(to.compressions_1_min, compressions_1_min_);
  if (pacing_) to.pacing_1_min = (*pacing_)[0], to.pacing_mA = (*pacing_)[1];
  if (breath_asked_) to.breath_asked = *breath_asked_;
  if (once_.empty()) return;
  const auto& [a, b, c, d] = once_.front().values;
  switch (once_.front().command) {
    case ConsoleCommand::give:
      if (to.drug >= 0) return;  // the script's own first
      to.drug = static_cast<int>(a), to.drug_dose = b;
      break;
    case ConsoleCommand::shock:
      if (to.shock_J > 0) return;
      to.shock_J = a;
      break;
    default: {
      if (to.provoked > 0) return;
      const Provocable& what = provocable(a);
      to.provoked = static_cast<int>(what.kind);
      to.provoked_size = what.si * d;
      to.provoked_cell = what.has_place ? model.vessel->coronaries->tree().cell_at(static_cast<int>(b), 1e-3 * c) : -1;
    }
  }
  once_.pop_front();
}

void Emergency::restart(const DeliveryInputs& inputs) {
  once_.clear();
  infusion_m3_s_ = drain_m3_s_ = compressions_1_min_ = 0;
  pacing_.reset(), breath_asked_.reset();
  gone_back_to_ = inputs;
}

}  // namespace ostium::app
