#include "app/session/live/console.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "fluoro/display/display.h"
#include "fluoro/projection/views.h"

namespace ostium::app {

namespace {

using units::atm, units::degree;

int first_guide(const SessionModel& model) {
  for (std::size_t t = 0; t < model.tools.size(); ++t)
    if (model.tools[t].instrument.kind == data::InstrumentKind::guide_catheter) return static_cast<int>(t);
  return 0;
}

/// What script or box ask for anew, part by part: a view leaves the table where it is.
void follow_pose(const CArmInputs& wanted, CArmInputs& asked, CArmInputs& arm) {
  if (wanted.lao_rad != asked.lao_rad || wanted.cran_rad != asked.cran_rad)
    arm.lao_rad = wanted.lao_rad, arm.cran_rad = wanted.cran_rad;
  if (wanted.field_m != asked.field_m) arm.field_m = wanted.field_m;
  if (wanted.p_PI != asked.p_PI) arm.p_PI = wanted.p_PI;
  asked = wanted;
}

int next_tool(const SessionModel& model, int left, int right) {
  const int count = static_cast<int>(model.tools.size());
  for (int k = 1; k <= count && right >= 0; ++k)
    if (const int next = (right + k) % count; next != left) return next;
  return right;
}

}  // namespace

Console::Console(const SessionModel& model) : left_(first_guide(model)) {
  if (model.tools.size() > 1) right_ = first_right_ = left_ == 0 ? 1 : 0;
}

double Console::level(ConsoleCommand held) const {
  double most = 0;
  for (const Controls& seat : controls)
    if (const double own = seat.get(held); std::fabs(own) > std::fabs(most)) most = own;
  return most;
}

void Console::restart(const SessionInputs& inputs, const CArmInputs& asked,
                      const std::vector<std::uint64_t>& moved_at) {
  arm_ = inputs.c_arm, asked_ = asked, arm_is_set_ = true;
  gauge_Pa_ = inputs.delivery.gauge_Pa, second_gauge_Pa_ = inputs.delivery.second_gauge_Pa;
  picture_.review = picture_.review_frame = 0;
  right_ = first_right_;
  std::uint64_t last = 0;
  for (std::size_t t = 0; t < moved_at.size(); ++t)
    if (static_cast<int>(t) != left_ && moved_at[t] > last) right_ = static_cast<int>(t), last = moved_at[t];
  emergency_.restart(inputs.delivery);
}

void Console::move_arm(const SessionModel& model, const ConsoleOrder& order) {
  using enum ConsoleCommand;
  const auto& [a, b, c, d] = order.values;
  switch (order.command) {
    case turn_arm:
      arm_.lao_rad += a * degree, arm_.cran_rad += b * degree;
      break;
    case place_arm:
      arm_.lao_rad = a * degree, arm_.cran_rad = b * degree;
      break;
    case view:
      if (const auto& views = fluoro::standard_views(); a <= static_cast<double>(views.size())) {
        const fluoro::StandardView& one = views[static_cast<std::size_t>(a) - 1];
        arm_.lao_rad = one.lao_deg * degree, arm_.cran_rad = one.cran_deg * degree;
      }
      break;
    case move_table: {
      // As far as a table goes: no further than the body.
      constexpr double reach_m = 0.8;
      const Eigen::Vector3d from = arm_.p_PI + 1e-3 * Eigen::Vector3d(a, b, c) - model.vessel->p_middle;
      arm_.p_PI = model.vessel->p_middle + from.cwiseMax(-reach_m).cwiseMin(reach_m);
      break;
    }
    case field:
      arm_.field_m = 1e-3 * a;
      break;
    default: {  // next_field
      std::size_t now = 0;
      for (std::size_t i = 0; i < std::size(fluoro::fields_m); ++i)
        if (std::fabs(arm_.field_m - fluoro::fields_m[i]) < 1e-6) now = i;
      arm_.field_m = fluoro::fields_m[(now + 1) % std::size(fluoro::fields_m)];
    }
  }
  const fluoro::CArmLimits limits;
  arm_.lao_rad = std::clamp(arm_.lao_rad, -limits.lao_rad, limits.lao_rad);
  arm_.cran_rad = std::clamp(arm_.cran_rad, -limits.cran_rad, limits.cran_rad);
}

void Console::take(const SessionModel& model, const ConsoleOrder& order, Hands hands) {
  using enum ConsoleCommand;
  const auto& [a, b, c, d] = order.values;
  if (data::row_of(order.command).needs == data::ConsoleNeeds::hands && hands == Hands::script) return;
  if (emergency_.take(model, order)) return;
  switch (order.command) {
    case next_device:
      right_ = next_tool(model, left_, right_);
      return;
    case change_gauge:
      gauge_Pa_ = std::clamp(std::max(gauge_Pa_, 0.0) + a * atm, 0.0, 30 * atm);
      return;
    case gauge:
      gauge_Pa_ = a * atm;
      return;
    case change_second_gauge:
      second_gauge_Pa_ = std::clamp(std::max(second_gauge_Pa_, 0.0) + a * atm, 0.0, 30 * atm);
      return;
    case second_gauge:
      second_gauge_Pa_ = a * atm;
      return;
    case heparin:
      heparin_U_ += a;
      return;
    case nitrate:
      nitrate_ug_ += a;
      return;
    case adenosine:
      adenosine_ug_ += a;
      return;
    case shutters:
      picture_.shutters = {a, b, c, d};
      return;
    case frame_rate:
      picture_.frames_per_s = a;
      return;
    case reference:
      ++picture_.references;
      return;
    case roadmap:
      picture_.roadmap = a > 0.5;
      return;
    case review:
      picture_.review = static_cast<int>(a), picture_.review_frame = 0;
      return;
    case review_step:
      picture_.review_frame += static_cast<int>(a);
      return;
    case gamma:
      picture_.gamma = a;
      return;
    case window:
      picture_.level = a, picture_.width = std::max(b, 0.02);
      return;
    case turn_arm:
    case place_arm:
    case view:
    case move_table:
    case field:
    case next_field:
      move_arm(model, order);
      return;
    default:
      return;  // held ones are levels; mark, pause, take_over, hand_back and end are the run's
  }
}

void Console::move_tools(SessionInputs& inputs) const {
  using enum ConsoleCommand;
  const double share = level(fine) > 0.5 ? fine_share : 1;
  for (ToolInputs& tool : inputs.tools) tool = {};
  const auto move = [&](int tool, ConsoleCommand feed, ConsoleCommand turn) {
    if (tool < 0) return;
    inputs.tools[static_cast<std::size_t>(tool)] = {share * hand_feed_m_s * level(feed),
                                                    share * hand_turn_rad_s * level(turn)};
  };
  move(left_, guide_feed, guide_turn);
  move(right_, device_feed, device_turn);
}

/// Syringe and indeflator of the seats; at a box its own come first, while they are used.
void Console::give(const SessionModel& model, Hands hands, DeliveryInputs& to) {
  if (hands == Hands::seats) to = {};
  to.heparin_U += heparin_U_, to.nitrate_ug += nitrate_ug_, to.adenosine_ug += adenosine_ug_;
  heparin_U_ = nitrate_ug_ = adenosine_ug_ = 0;
  emergency_.fill(model, to);
  if (hands == Hands::script) return;
  const double dye = level(ConsoleCommand::contrast), flush = level(ConsoleCommand::saline);
  if (to.injection_m3_s == 0) {
    to.injection_m3_s = dye > 0.02 ? dye * hand_contrast_m3_s : flush > 0.02 ? flush * hand_flush_m3_s : 0;
    to.iodine_kg_m3 = dye > 0.02 || flush <= 0.02 ? undiluted_kg_m3 : 0;
  }
  if (to.injection_m3_s == 0 && to.aspiration_m3_s == 0)
    to.aspiration_m3_s = level(ConsoleCommand::aspirate) * hand_aspiration_m3_s;
  // A plunger that was drawn back stays where there is no pressure; it does not fill the balloon again.
  const bool drawn_back = level(ConsoleCommand::vacuum) > 0.5;
  if (drawn_back) gauge_Pa_ = second_gauge_Pa_ = 0;
  if (to.gauge_Pa == 0) to.gauge_Pa = drawn_back ? -0.9 * atm : gauge_Pa_;
  if (to.second_gauge_Pa == 0) to.second_gauge_Pa = drawn_back ? -0.9 * atm : second_gauge_Pa_;
}

void Console::fill(const SessionModel& model, Hands hands, SessionInputs& inputs) {
  begin(inputs.c_arm);
  // A view of the script, or a button of the box.
  if (hands != Hands::seats) follow_pose(inputs.c_arm, asked_, arm_);
  const bool pedal = hands != Hands::seats && inputs.c_arm.fluoroscopy,
             film = hands != Hands::seats && inputs.c_arm.cine;
  inputs.c_arm = arm_;
  inputs.c_arm.fluoroscopy = pedal || level(ConsoleCommand::fluoroscopy) > 0.3;
  inputs.c_arm.cine = film || level(ConsoleCommand::cine) > 0.3;
  if (hands == Hands::seats) move_tools(inputs);
  // Whoever takes over finds the indeflator as the script had it.
  if (hands == Hands::script) gauge_Pa_ = inputs.delivery.gauge_Pa, second_gauge_Pa_ = inputs.delivery.second_gauge_Pa;
  if (model.has_patient()) give(model, hands, inputs.delivery);
}

void window_greys(const PictureSettings& settings, fluoro::Picture& picture) {
  if (settings.gamma == 1 && settings.level == 0.5 && settings.width == 1) return;
  std::array<std::uint8_t, 256> shown;
  for (int grey = 0; grey < 256; ++grey) {
    const double part = std::clamp((grey / 255.0 - settings.level) / settings.width + 0.5, 0.0, 1.0);
    shown[static_cast<std::size_t>(grey)] =
        static_cast<std::uint8_t>(std::lround(255 * std::pow(part, settings.gamma)));
  }
  for (std::uint8_t& grey : picture.grey) grey = shown[grey];
}

}  // namespace ostium::app
