#pragma once
/// What a trainer provokes and what answers it, as a console asks for them: give, infuse, drain, shock, compress,
/// pace, breath, provoke.
#include <array>
#include <deque>
#include <iterator>
#include <optional>
#include <string>

#include "app/session/model/session.h"
#include "data/console/console_commands.h"

namespace ostium::app {

/// What may be provoked, as a console asks for it: by its kind, its size counted as `size` says.
struct Provocable {
  vascular::Provoked kind;
  bool has_place;
  const char* size;  ///< null: it has none
  double least, most, usual;
  double si;  ///< vascular::Provocation::size of a size of 1
};
inline constexpr Provocable provocables[] = {
    {vascular::Provoked::perforation, true, "hole, mm", 0.1, 3, 0.8, 1e-3},
    {vascular::Provoked::dissection, true, "grade", 0, 5, 2, 1},
    {vascular::Provoked::spasm, true, "share of the diameter", 0, 0.98, 0.9, 1},
    {vascular::Provoked::no_reflow, true, "share of the flow", 0, 0.98, 0.9, 1},
    {vascular::Provoked::fibrillation, false, nullptr, 0, 6, 0, 1},
    {vascular::Provoked::block, false, nullptr, 0, 6, 0, 1},
    {vascular::Provoked::thrombus, true, "mm3", 1, 200, 25, 1e-9},
    {vascular::Provoked::air, false, "mL in the line", 0.05, 5, 0.5, 1e-6},
    {vascular::Provoked::vagal, false, "share of the strongest", 0.1, 1, 0.8, 1}};
static_assert(std::size(provocables) + 1 == vascular::provocations, "all but `nothing`");

/// Empty if this patient can have it; else why not, with what could be. True of other commands, too.
std::string why_not(const SessionModel& model, const data::ConsoleOrder& order);

/// Orders as inputs: doses, shocks and provocations in one step, one after another; rates until they are changed.
class Emergency {
 public:
  /// False: another sort of command. What the patient cannot have is left out.
  bool take(const SessionModel& model, const data::ConsoleOrder& order);
  /// Onto what script or box ask for. Of the same model, with a patient.
  void fill(const SessionModel& model, DeliveryInputs& to);
  /// The run has gone back: rates as they were. What the script gives by itself then is not the console's.
  void restart(const DeliveryInputs& inputs);

 private:
  std::deque<data::ConsoleOrder> once_;
  double infusion_m3_s_ = 0, drain_m3_s_ = 0, compressions_1_min_ = 0;
  std::optional<std::array<double, 2>> pacing_;  ///< rate, 1/min, and current, mA, once asked for
  std::optional<int> breath_asked_;              ///< once it was
  std::optional<DeliveryInputs> gone_back_to_;   ///< until the script has said what of it is its own
};

}  // namespace ostium::app
