#pragma once
/// Which key does what at the console, in the window and in the browser.
#include "data/console/console_commands.h"

namespace ostium::data {

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
                                              {"X", false, {ConsoleCommand::aspirate, {1}}},
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
