/// The window's help beside what its keys do: each that is listed does something, each that is not does nothing.
#include <SDL2/SDL.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <thread>

#include "app/session/device/box_driver.h"
#include "app/window/panel.h"
#include "data/console/console_keys.h"
#include "tests/app/session/tube_vessel.h"

namespace ostium::app {
namespace {

std::string script_with(int tools) {
  std::string list;
  for (int t = 0; t < tools; ++t)
    list +=
        std::string(t ? ", " : "") + R"({ "name": "wire )" + std::to_string(t + 1) + R"(", "instrument": "cook-j" })";
  return R"({ "schema": "ostium-script/1", "name": "waits", "title": "A test", "tools": [ )" + list +
         R"( ], "steps": [ { "do": "wait", "timeout_s": 100, "until": [{ "seconds": 90 }] } ] })";
}

/// Stands for a tracking box whose hand does nothing.
struct IdleBox : Driver {
  Driven drive(const ScriptedRun&, SessionInputs& inputs) override {
    inputs.c_arm = {};
    for (ToolInputs& tool : inputs.tools) tool = {};
    return Driven::on;
  }
};

struct Case {
  std::string name;
  Hands began;
  bool taken_over;
  int tools;
};

/// A run in the small tube, played, at a box or by a script.
struct PlayedRun {
  explicit PlayedRun(const Case& of) : setup(tube_setup(script_with(of.tools))) {
    if (of.began == Hands::seats) setup.script = free_hands(setup.script);
    run = std::make_unique<ScriptedRun>(setup, tube_vessel());
    hand = std::make_unique<LiveDriver>(run->model, of.began, 15, of.began == Hands::box ? &box : nullptr);
    run->take_over(hand.get());
    if (of.taken_over) keys().order(ConsoleCommand::take_over);
    steps(80);
  }
  Controls& keys() { return hand->controls(Seat::window); }
  void steps(int n) {
    for (int i = 0; i < n && run->tick(); ++i)
      for (const OperatorEvent& e : run->events) said += std::to_string(static_cast<int>(e.kind)) + " ";
  }
  const Snapshot& now() {
    hand->snapshots(Seat::window).update();
    return hand->snapshots(Seat::window).front();
  }
  /// All that an operator can ask for.
  std::string asked() {
    const Snapshot& s = now();
    const CArmInputs& arm = run->inputs.c_arm;
    const PictureSettings& p = s.picture;
    std::ostringstream out;
    out << said << arm.lao_rad << ' ' << arm.cran_rad << ' ' << arm.p_PI.transpose() << ' ' << arm.field_m << ' '
        << arm.fluoroscopy << arm.cine << ' ' << (s.hands == Hands::seats ? s.right_hand : 0)
        << static_cast<int>(s.hands) << s.paused << ' ' << p.references << ' ' << p.roadmap << ' ' << p.review << ' '
        << p.review_frame << ' ' << words_for(run->outcome);
    for (const ToolInputs& tool : run->inputs.tools) out << ' ' << tool.feed_m_s << ' ' << tool.turn_rad_s;
    return out.str();
  }

  RunSetup setup;
  IdleBox box;
  std::unique_ptr<ScriptedRun> run;
  std::unique_ptr<LiveDriver> hand;
  std::string said;
};

/// What the key changes.
bool changes(const Case& of, const data::ConsoleKey& key) {
  const ConsoleCommand command = key.order.command;
  PlayedRun with(of), without(of);
  // Fine hands show in how they move, a view where the arm is elsewhere.
  for (PlayedRun* one : {&with, &without}) {
    if (command == ConsoleCommand::fine) one->keys().set(ConsoleCommand::guide_feed, 1);
    if (command == ConsoleCommand::view) one->keys().order(ConsoleCommand::place_arm, 17, 3);
    if (command == ConsoleCommand::review && key.order.values[0] == 0) one->keys().order(ConsoleCommand::review, 1);
    if (command == ConsoleCommand::roadmap && key.order.values[0] == 0) one->keys().order(ConsoleCommand::roadmap, 1);
    one->steps(2);
  }
  if (data::row_of(command).held)
    with.keys().set(command, key.order.values[0]);
  else
    with.keys().order(key.order);
  std::thread goes_on;
  bool stood = false;
  if (command == ConsoleCommand::pause)
    goes_on = std::thread([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(60));
      stood = with.now().paused;
      with.keys().order(ConsoleCommand::pause);
    });
  with.steps(80), without.steps(80);
  if (goes_on.joinable()) goes_on.join();
  return stood || with.asked() != without.asked();
}

TEST(Keys, TheHelpListsThoseThatDoSomething) {
  const Case cases[] = {{"one tool, played", Hands::seats, false, 1},    {"two tools, played", Hands::seats, false, 2},
                        {"three tools, played", Hands::seats, false, 3}, {"watched", Hands::script, false, 2},
                        {"taken over", Hands::script, true, 3},          {"at the box", Hands::box, false, 3}};
  for (const Case& of : cases) {
    PlayedRun run(of);
    std::set<std::string> listed;
    for (const KeyHelp& help : key_help(panel_texts(run.run->model, run.run->plan, *run.hand), run.now()))
      listed.insert(help.what);
    EXPECT_TRUE(listed.count(data::row_of(ConsoleCommand::mark).what)) << of.name;
    for (const data::ConsoleKey& key : data::console_keys) {
      const data::ConsoleRow& row = data::row_of(key.order.command);
      EXPECT_EQ(listed.count(row.what) > 0, changes(of, key))
          << of.name << ": " << (key.ctrl ? "Ctrl+" : "") << key.key << ", " << row.name;
    }
  }
}

/// A key that SDL does not know never comes.
TEST(Keys, AreSDLs) {
  for (const data::ConsoleKey& key : data::console_keys)
    EXPECT_NE(SDL_GetKeyFromName(key.key), SDLK_UNKNOWN) << key.key;
}

}  // namespace
}  // namespace ostium::app
