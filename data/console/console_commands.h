#pragma once
/// What an operator's console does, one row each, whoever asks: keyboard, gamepad, tracking box or a browser. Units as
/// people say them; `app/session/live` carries them out, and turns them into SI.
#include <array>
#include <iterator>

namespace ostium::data {

enum class ConsoleCommand {
  // Held: a share of the full, again and again or until it is 0.
  guide_feed,
  guide_turn,
  device_feed,
  device_turn,
  fine,
  fluoroscopy,
  cine,
  contrast,
  saline,
  vacuum,
  // Done once.
  next_device,
  turn_arm,
  place_arm,
  view,
  move_table,
  field,
  next_field,
  shutters,
  frame_rate,
  gauge,
  change_gauge,
  heparin,
  nitrate,
  adenosine,
  reference,
  roadmap,
  review,
  review_step,
  gamma,
  window,
  mark,
  pause,
  take_over,
  hand_back,
  end
};

/// Who can use a command: whoever looks; who has the console; who has the instruments in hand.
enum class ConsoleNeeds { nothing, console, hands };

inline constexpr int most_console_values = 4;

struct ConsoleRow {
  ConsoleCommand command;
  const char* name;
  bool held;
  int values;          ///< how many
  double least, most;  ///< of each
  const char* unit;    ///< of each; "1": a share or a number
  ConsoleNeeds needs;
  bool patient;  ///< only where there is one: not in a mesh
  const char* what;
};

inline constexpr ConsoleRow console_rows[] = {
    {ConsoleCommand::guide_feed, "guide_feed", true, 1, -1, 1, "1", ConsoleNeeds::hands, false,
     "left hand: push in, pull out"},
    {ConsoleCommand::guide_turn, "guide_turn", true, 1, -1, 1, "1", ConsoleNeeds::hands, false,
     "left hand: turn clockwise, back"},
    {ConsoleCommand::device_feed, "device_feed", true, 1, -1, 1, "1", ConsoleNeeds::hands, false,
     "right hand: push in, pull out"},
    {ConsoleCommand::device_turn, "device_turn", true, 1, -1, 1, "1", ConsoleNeeds::hands, false,
     "right hand: turn clockwise, back"},
    {ConsoleCommand::fine, "fine", true, 1, 0, 1, "1", ConsoleNeeds::hands, false, "hands go at a sixth of the speed"},
    {ConsoleCommand::fluoroscopy, "fluoroscopy", true, 1, 0, 1, "1", ConsoleNeeds::console, false, "fluoroscopy pedal"},
    {ConsoleCommand::cine, "cine", true, 1, 0, 1, "1", ConsoleNeeds::console, false, "cine pedal"},
    {ConsoleCommand::contrast, "contrast", true, 1, 0, 1, "1", ConsoleNeeds::hands, true,
     "syringe: contrast, 4 mL/s at most"},
    {ConsoleCommand::saline, "saline", true, 1, 0, 1, "1", ConsoleNeeds::hands, true,
     "syringe: saline, 4 mL/s at most"},
    {ConsoleCommand::vacuum, "vacuum", true, 1, 0, 1, "1", ConsoleNeeds::hands, true, "indeflator: plunger drawn back"},
    {ConsoleCommand::next_device, "next_device", false, 0, 0, 0, "1", ConsoleNeeds::hands, false,
     "right hand: the next tool"},
    {ConsoleCommand::turn_arm, "turn_arm", false, 2, -180, 180, "deg", ConsoleNeeds::console, false,
     "C-arm, turned by: LAO, cranial"},
    {ConsoleCommand::place_arm, "place_arm", false, 2, -120, 120, "deg", ConsoleNeeds::console, false,
     "C-arm, turned to: LAO, cranial"},
    {ConsoleCommand::view, "view", false, 1, 1, 8, "1", ConsoleNeeds::console, false, "C-arm: a standard view"},
    {ConsoleCommand::move_table, "move_table", false, 3, -300, 300, "mm", ConsoleNeeds::console, false,
     "table: isocentre in the patient moved by: left, head, front"},
    {ConsoleCommand::field, "field", false, 1, 130, 200, "mm", ConsoleNeeds::console, false, "zoom: 200, 160 or 130"},
    {ConsoleCommand::next_field, "next_field", false, 0, 0, 0, "1", ConsoleNeeds::console, false,
     "zoom: the next field"},
    {ConsoleCommand::shutters, "shutters", false, 4, 0.05, 0.5, "1", ConsoleNeeds::console, false,
     "shutters, open from the middle: left, right, top, bottom, as shares of the field"},
    {ConsoleCommand::frame_rate, "frame_rate", false, 1, 3.75, 30, "1/s", ConsoleNeeds::console, false,
     "pictures a second: 3.75, 7.5, 15 or 30"},
    {ConsoleCommand::gauge, "gauge", false, 1, -1, 30, "atm", ConsoleNeeds::hands, true,
     "indeflator: pressure, 0 lets it go"},
    {ConsoleCommand::change_gauge, "change_gauge", false, 1, -30, 30, "atm", ConsoleNeeds::hands, true,
     "indeflator: pressure, by"},
    {ConsoleCommand::heparin, "heparin", false, 1, 100, 15000, "U", ConsoleNeeds::console, true, "give heparin"},
    {ConsoleCommand::nitrate, "nitrate", false, 1, 10, 500, "ug", ConsoleNeeds::console, true,
     "give nitrate into the coronary"},
    {ConsoleCommand::adenosine, "adenosine", false, 1, 10, 500, "ug", ConsoleNeeds::console, true,
     "give adenosine into the coronary"},
    {ConsoleCommand::reference, "reference", false, 0, 0, 0, "1", ConsoleNeeds::nothing, false,
     "this picture becomes the reference"},
    {ConsoleCommand::roadmap, "roadmap", false, 1, 0, 1, "1", ConsoleNeeds::nothing, false,
     "roadmap: contrast of the last cine run over fluoroscopy; 1: on"},
    {ConsoleCommand::review, "review", false, 1, 0, 99, "1", ConsoleNeeds::nothing, false,
     "review of a cine run: 1 the last, 2 the one before; 0: live"},
    {ConsoleCommand::review_step, "review_step", false, 1, -900, 900, "1", ConsoleNeeds::nothing, false,
     "review: on or back by so many pictures"},
    {ConsoleCommand::gamma, "gamma", false, 1, 0.3, 3, "1", ConsoleNeeds::nothing, false, "gamma of the picture shown"},
    {ConsoleCommand::window, "window", false, 2, 0, 1, "1", ConsoleNeeds::nothing, false,
     "greys that are shown: middle and width, as shares of all"},
    {ConsoleCommand::mark, "mark", false, 0, 0, 0, "1", ConsoleNeeds::nothing, false,
     "marks this moment: an event, and a picture in the report"},
    {ConsoleCommand::pause, "pause", false, 0, 0, 0, "1", ConsoleNeeds::nothing, false, "pause, go on"},
    {ConsoleCommand::take_over, "take_over", false, 0, 0, 0, "1", ConsoleNeeds::nothing, false,
     "take over from the script, which waits"},
    {ConsoleCommand::hand_back, "hand_back", false, 0, 0, 0, "1", ConsoleNeeds::nothing, false,
     "hand back to the script, which begins its step anew"},
    {ConsoleCommand::end, "end", false, 0, 0, 0, "1", ConsoleNeeds::nothing, false, "end the run"}};

inline constexpr int console_commands = static_cast<int>(std::size(console_rows));
inline constexpr int held_commands = static_cast<int>(ConsoleCommand::vacuum) + 1;

constexpr const ConsoleRow& row_of(ConsoleCommand command) { return console_rows[static_cast<std::size_t>(command)]; }

constexpr bool console_rows_are_in_order() {
  for (int i = 0; i < console_commands; ++i)
    if (console_rows[i].command != static_cast<ConsoleCommand>(i) || console_rows[i].held != (i < held_commands))
      return false;
  return true;
}
static_assert(console_rows_are_in_order(), "a row for each command, held ones first");

struct ConsoleOrder {
  ConsoleCommand command = ConsoleCommand::pause;
  std::array<double, most_console_values> values{};
};

/// A key, as SDL names it; browsers name most of them the same.
struct ConsoleKey {
  const char* key;
  bool ctrl;
  ConsoleOrder order;  ///< of a held command: the value while it is down
};

inline constexpr ConsoleKey console_keys[] = {{"W", false, {ConsoleCommand::guide_feed, {1}}},
                                              {"S", false, {ConsoleCommand::guide_feed, {-1}}},
                                              {"D", false, {ConsoleCommand::guide_turn, {1}}},
                                              {"A", false, {ConsoleCommand::guide_turn, {-1}}},
                                              {"I", false, {ConsoleCommand::device_feed, {1}}},
                                              {"K", false, {ConsoleCommand::device_feed, {-1}}},
                                              {"L", false, {ConsoleCommand::device_turn, {1}}},
                                              {"J", false, {ConsoleCommand::device_turn, {-1}}},
                                              {"Left Shift", false, {ConsoleCommand::fine, {1}}},
                                              {"Right Shift", false, {ConsoleCommand::fine, {1}}},
                                              {"Space", false, {ConsoleCommand::fluoroscopy, {1}}},
                                              {"V", false, {ConsoleCommand::cine, {1}}},
                                              {"F", false, {ConsoleCommand::contrast, {1}}},
                                              {"G", false, {ConsoleCommand::saline, {1}}},
                                              {"\\", false, {ConsoleCommand::vacuum, {1}}},
                                              {"Tab", false, {ConsoleCommand::next_device, {}}},
                                              {"Y", false, {ConsoleCommand::next_device, {}}},
                                              {"]", false, {ConsoleCommand::change_gauge, {1}}},
                                              {"[", false, {ConsoleCommand::change_gauge, {-1}}},
                                              {"Backspace", false, {ConsoleCommand::gauge, {0}}},
                                              {"Left", false, {ConsoleCommand::turn_arm, {5, 0}}},
                                              {"Right", false, {ConsoleCommand::turn_arm, {-5, 0}}},
                                              {"Up", false, {ConsoleCommand::turn_arm, {0, 5}}},
                                              {"Down", false, {ConsoleCommand::turn_arm, {0, -5}}},
                                              {"Left", true, {ConsoleCommand::move_table, {10, 0, 0}}},
                                              {"Right", true, {ConsoleCommand::move_table, {-10, 0, 0}}},
                                              {"Up", true, {ConsoleCommand::move_table, {0, 10, 0}}},
                                              {"Down", true, {ConsoleCommand::move_table, {0, -10, 0}}},
                                              {"1", false, {ConsoleCommand::view, {1}}},
                                              {"2", false, {ConsoleCommand::view, {2}}},
                                              {"3", false, {ConsoleCommand::view, {3}}},
                                              {"4", false, {ConsoleCommand::view, {4}}},
                                              {"5", false, {ConsoleCommand::view, {5}}},
                                              {"6", false, {ConsoleCommand::view, {6}}},
                                              {"7", false, {ConsoleCommand::view, {7}}},
                                              {"8", false, {ConsoleCommand::view, {8}}},
                                              {"Z", false, {ConsoleCommand::next_field, {}}},
                                              {"H", false, {ConsoleCommand::reference, {}}},
                                              {"M", false, {ConsoleCommand::roadmap, {1}}},
                                              {"M", true, {ConsoleCommand::roadmap, {0}}},
                                              {"R", false, {ConsoleCommand::review, {1}}},
                                              {"R", true, {ConsoleCommand::review, {0}}},
                                              {",", false, {ConsoleCommand::review_step, {-1}}},
                                              {".", false, {ConsoleCommand::review_step, {1}}},
                                              {"E", false, {ConsoleCommand::heparin, {5000}}},
                                              {"N", false, {ConsoleCommand::nitrate, {200}}},
                                              {"O", false, {ConsoleCommand::adenosine, {100}}},
                                              {"B", false, {ConsoleCommand::mark, {}}},
                                              {"P", false, {ConsoleCommand::pause, {}}},
                                              {"T", false, {ConsoleCommand::take_over, {}}},
                                              {"T", true, {ConsoleCommand::hand_back, {}}},
                                              {"Escape", false, {ConsoleCommand::end, {}}}};

}  // namespace ostium::data
