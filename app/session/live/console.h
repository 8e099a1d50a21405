#pragma once
/// The operator's console: what several seats, a tracking box and a script ask for, as the inputs of a step and the
/// settings of the picture. Of pose and table the last who asked has the say; pedals are down while anybody presses
/// one.
#include <array>

#include "app/session/live/controls.h"
#include "app/session/live/emergency.h"
#include "app/session/live/picture_settings.h"
#include "app/session/model/session.h"

namespace ostium::app {

/// Speeds of hands at a keyboard.
inline constexpr double hand_feed_m_s = 0.03, hand_turn_rad_s = 3.14, fine_share = 1.0 / 6;
inline constexpr double hand_contrast_m3_s = 4e-6, hand_flush_m3_s = 4e-6, hand_aspiration_m3_s = 4e-6;

/// A place from which the console is used at the same time as from others.
enum class Seat { window, browser };
inline constexpr int seats = 2;

/// Who moves the instruments: the script, hands at a tracking box, or the seats' keys.
enum class Hands { script, box, seats };

class Console {
 public:
  explicit Console(const SessionModel& model);

  /// Once a step, before the others: what has been pressed since.
  void take(const SessionModel& model, const ConsoleOrder& order, Hands hands);
  /// `inputs`: what script or box ask for; becomes what is done.
  void fill(const SessionModel& model, Hands hands, SessionInputs& inputs);
  /// The run has gone back: pose and pressure of that moment, the pose that the script asks for, and in the right hand
  /// the tool that was moved last (`moved_at`: when each was).
  void restart(const SessionInputs& inputs, const CArmInputs& asked, const std::vector<std::uint64_t>& moved_at);

  std::array<Controls, seats> controls;
  const CArmInputs& arm() const { return arm_; }
  /// Before the first step: the pose that everything begins with.
  void begin(const CArmInputs& arm) {
    if (!arm_is_set_) arm_ = asked_ = arm, arm_is_set_ = true;
  }
  const PictureSettings& picture() const { return picture_; }
  int left_hand() const { return left_; }
  int right_hand() const { return right_; }

 private:
  double level(ConsoleCommand held) const;  ///< the largest of the seats'
  void move_arm(const SessionModel& model, const ConsoleOrder& order);
  void move_tools(SessionInputs& inputs) const;
  void give(const SessionModel& model, Hands hands, DeliveryInputs& to);

  int left_ = 0, right_ = -1, first_right_ = -1;
  CArmInputs arm_, asked_;  ///< pose as it is, and as script or box asked for it last
  bool arm_is_set_ = false;
  Emergency emergency_;
  double gauge_Pa_ = 0,
         second_gauge_Pa_ = 0,  ///< as they are left; while the plungers are drawn back there is a vacuum
      heparin_U_ = 0, nitrate_ug_ = 0, adenosine_ug_ = 0;
  PictureSettings picture_;
};

}  // namespace ostium::app
