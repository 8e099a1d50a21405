/// The trainer's station beside a run in the small vessel: what is asked by a client is done, recorded, and replays.
#include "app/serve/station/station.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/serve/messages/hints.h"
#include "app/session/device/box_driver.h"
#include "app/session/run/branch.h"
#include "app/session/run/replay.h"
#include "tests/app/serve/client.h"
#include "tests/app/session/tube_vessel.h"

namespace ostium::app {
namespace {

namespace fs = std::filesystem;

const char* const slow_push = R"({
  "schema": "ostium-script/1", "name": "slow", "title": "A test",
  "tools": [ { "name": "wire", "instrument": "cook-j" } ],
  "steps": [
    { "do": "fluoroscopy", "on": true },
    { "do": "advance", "tool": "wire", "speed_mm_s": 20, "until": [{ "inserted_mm": 150 }], "timeout_s": 60 } ]
})";

RunSetup setup_for(Hands hands) {
  RunSetup setup = tube_setup(slow_push);
  if (hands == Hands::seats) setup.script = free_hands(setup.script);
  return setup;
}

/// A run with a station, played in a thread of its own.
struct Sitting {
  explicit Sitting(Hands hands)
      : folder(fs::temp_directory_path() / ("ostium-station-" + std::to_string(getpid()))),
        setup(setup_for(hands)),
        run(setup, tube_vessel()),
        hand(run.model, hands, 15),
        station(run, hand, list(), settings(folder.string())) {
    fs::create_directories(folder);
    run.take_over(&hand);
  }
  ~Sitting() {
    if (steps.joinable()) steps.join();
    fs::remove_all(folder);
  }
  static data::ScoreList list() { return data::find_score_list("pci-elective"); }
  static StationSettings settings(const std::string& folder) {
    StationSettings s;
    s.folder = folder;
    s.goes_back = true, s.pixels = 64;
    s.lesson = {"One", "it is out", {{"push", true, {"first", "second"}}, {"draw", true, {"third"}}}, {0}, ""};
    return s;
  }
  std::string file(const char* name) const { return (folder / name).string(); }
  static std::string token(const std::string& link) { return link.substr(link.find('=') + 1); }

  void play(const char* name, std::optional<Continued> from = {}) {
    PlayOptions options;
    if (from) {
      options.recorder.watch = go_back(run, *from), options.recorder.continues = from;
      hand.restart(run);
      station.gone_back(from->steps / 1000, name);
    }
    options.recorder.file = file(name);
    options.recorder.penetration = false;
    options.recorder.heard = station.ear();
    options.real = true;
    steps = std::thread([this, options] { report = app::play(run, setup, options); });
  }

  fs::path folder;
  RunSetup setup;
  ScriptedRun run;
  LiveDriver hand;
  Station station;
  std::thread steps;
  PlayReport report;
};

double number_of(const std::string& text, const char* key) { return nlohmann::json::parse(text).at(key).get<double>(); }
auto is_now(double from_s) {
  return [from_s](const std::string& text) {
    return text.find("\"type\":\"now\"") != std::string::npos && number_of(text, "s") >= from_s;
  };
}

TEST(Station, PausesTakesOverAndTellsWhatHappens) {
  Sitting s(Hands::script);
  Client trainer(s.station.port()), viewer(s.station.port());
  ASSERT_TRUE(trainer.come_in(Sitting::token(s.station.trainer_link())));
  ASSERT_TRUE(viewer.come_in(Sitting::token(s.station.viewer_link())));
  EXPECT_NE(s.station.trainer_link(), s.station.viewer_link());
  s.play("run.h5");
  EXPECT_TRUE(trainer.message_with("tool in")) << "an event as it comes, in words";
  ASSERT_TRUE(trainer.message(is_now(0.5), 20000));
  EXPECT_TRUE(trainer.message([](const std::string& m) { return m[0] == 3; })) << "hidden truth";
  EXPECT_TRUE(viewer.message([](const std::string& m) { return m[0] == 1 && m.substr(16, 2) == "\xff\xd8"; }))
      << "a JPEG of the picture";

  viewer.say(R"({"do":"pause"})");
  EXPECT_TRUE(viewer.message_with("viewers look on"));
  trainer.say(R"({"do":"guide_feed","values":[1]})");
  EXPECT_TRUE(trainer.message_with("take over first"));
  trainer.say(R"({"do":"frame_rate","values":[12]})");
  EXPECT_TRUE(trainer.message_with("one of 3.75 7.5 15 30"));
  for (const char* nonsense : {"{", "[]", "{\"do\":7}", "{\"do\":\"jump\"}", "{\"do\":\"gamma\",\"values\":[\"x\"]}"}) {
    trainer.say(nonsense);
    EXPECT_TRUE(trainer.message_with("\"refused\"")) << nonsense;
  }

  trainer.say(R"({"do":"pause"})");
  const auto paused = trainer.message_with("\"paused\":true");
  ASSERT_TRUE(paused);
  const double at = number_of(*paused, "s");
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  trainer.say(R"({"do":"take_over"})");
  const auto taken = trainer.message_with("\"hands\":\"seats\"");
  ASSERT_TRUE(taken);
  EXPECT_EQ(number_of(*taken, "s"), at) << "time stands";
  trainer.say(R"({"do":"mark","text":"so weit"})");
  trainer.say(R"({"do":"jump"})");  // the answer to which says that the note has come
  ASSERT_TRUE(trainer.message_with("\"refused\""));
  s.station.keep_notes();
  EXPECT_EQ(nlohmann::json::parse(std::ifstream(s.folder / "notes.json")).at(0).at("note"), "so weit")
      << "kept, though no step has taken its mark";
  trainer.say(R"({"do":"pause"})");
  EXPECT_TRUE(trainer.message_with("mark: so weit"));
  trainer.say(R"({"do":"guide_feed","values":[-1]})");
  ASSERT_TRUE(trainer.message_with("\"push_N\"") && trainer.message(is_now(at + 0.5)));
  // Silent hands are let go within a second or so.
  std::this_thread::sleep_for(std::chrono::milliseconds(1800));
  trainer.say(R"({"do":"end"})");
  s.steps.join();
  EXPECT_EQ(s.station.wish().kind, Wish::Kind::none);
  const HandState& wire = s.run.state.hands[0];
  EXPECT_LT(wire.path_m, 0.02 * at + hand_feed_m_s * 2.6) << "it did not go on";
  EXPECT_LT(wire.fed_m, 0.02 * at - hand_feed_m_s * 0.3) << "drawn back by the browser";
  ASSERT_EQ(s.station.notes().size(), 1u);
  EXPECT_NEAR(s.station.notes()[0].second, at, 0.2);
}

int count(const data::RecordingReader& recording, data::EventCode code) {
  int found = 0;
  const std::vector<double> events = recording.events();
  for (std::size_t at = 0; at < events.size(); at += 4)
    found += events[at + 1] == static_cast<double>(static_cast<int>(code));
  return found;
}

TEST(Station, GoesBackAndTheBranchReplaysAlone) {
  Sitting s(Hands::seats);
  Client trainer(s.station.port());
  ASSERT_TRUE(trainer.come_in(Sitting::token(s.station.trainer_link())));
  s.hand.controls(Seat::window).order(ConsoleCommand::guide_feed, 1);
  s.play("run.h5");
  ASSERT_TRUE(trainer.message(is_now(2.2), 30000));
  trainer.say(R"({"do":"mark","text":"of what is left"})");
  ASSERT_TRUE(trainer.message_with("mark: of what is left"));
  trainer.say(R"({"do":"rewind","values":[50]})");
  EXPECT_TRUE(trainer.message_with("expected a second from 0 to 2"));
  trainer.say(R"({"do":"rewind","values":[1]})");
  s.steps.join();
  const Wish wish = s.station.wish();
  ASSERT_EQ(wish.kind, Wish::Kind::go_back);
  ASSERT_EQ(wish.second, 1u);
  const double before_m = s.run.state.hands[0].fed_m;

  s.hand.controls(Seat::window).order(ConsoleCommand::guide_feed, -0.5);
  const auto asked = std::chrono::steady_clock::now();
  s.play("branch-2.h5", Continued{s.file("run.h5"), 1000});
  EXPECT_LT(std::chrono::steady_clock::now() - asked, std::chrono::seconds(2));
  EXPECT_TRUE(trainer.message_with("\"branch\""));
  EXPECT_TRUE(trainer.message_with("\"paused\":true")) << "until the trainer goes on";
  trainer.say(R"({"do":"pause"})");
  ASSERT_TRUE(trainer.message(is_now(1.8), 20000));
  s.hand.controls(Seat::window).order(ConsoleCommand::end);
  s.steps.join();
  EXPECT_LT(s.run.state.hands[0].fed_m, before_m - 0.5 * hand_feed_m_s);
  s.station.keep_notes();
  const std::vector<Note> notes = read_notes(s.folder.string());
  ASSERT_EQ(notes.size(), 1u) << "of the recording that was left, too";
  EXPECT_EQ(notes[0].recording + ": " + notes[0].text, "run.h5: of what is left");

  for (const char* name : {"run.h5", "branch-2.h5"}) {
    Replay replay(s.file(name), tube_vessel());
    EXPECT_GE(replay.recording.steps(), 1500u) << name;
    EXPECT_TRUE(replay.recording.end()) << name;
    const VerifyReport report = verify(replay);
    EXPECT_EQ(report.steps, replay.recording.steps()) << name;
    EXPECT_FALSE(report.first_step) << name << ": " << report.field;
  }
  // Up to there both are the same; the branch has what came before, and each event once.
  const data::RecordingReader a(s.file("run.h5")), b(s.file("branch-2.h5"));
  EXPECT_EQ(a.hashes(0, 1000), b.hashes(0, 1000));
  EXPECT_NE(a.hashes(1200, 1), b.hashes(1200, 1));
  EXPECT_EQ(b.states(), b.steps() / 1000 + 1);
  EXPECT_EQ(b.signals().size(), b.steps() / 10 * b.signal_columns().size());
  EXPECT_EQ(count(b, data::EventCode::tool_in), 1);
}

TEST(Hints, SayWhatTheExpertDoesWhereAStepFails) {
  const data::Script script = data::find_script("aorta-arch-guide");
  const auto at = [&](const std::string& label) {
    const auto it = std::find_if(script.steps.begin(), script.steps.end(),
                                 [&](const data::ScriptStep& step) { return step.label == label; });
    return static_cast<int>(it - script.steps.begin());
  };
  const std::vector<std::string> hints = hints_of(script, at("wire over the arch"), at("guide over the wire"));
  ASSERT_EQ(hints.size(), 2u) << "the same words again and again help nobody";
  EXPECT_EQ(hints[0].find("The expert pushes the wire in, 50 mm a second, until the tip of the wire has come to"), 0u);
  EXPECT_EQ(hints[1],
            "Where that fails, the expert draws the guide back; draws the wire back; turns the guide, 60° a second "
            "clockwise; and tries again.");
}

TEST(Station, NotesAreKeptAsTheyComeAndAreThereWhenARunGoesOn) {
  Sitting s(Hands::seats);
  write_notes(s.folder.string(), {{"run.h5", 1.5, "before"}, {"run.h5", 1.7, "of a moment that was left"}});
  s.station.recall({{1500, static_cast<int>(data::EventCode::mark), -1, 0}}, "branch-2.h5");
  Client trainer(s.station.port());
  ASSERT_TRUE(trainer.come_in(Sitting::token(s.station.trainer_link())));
  EXPECT_TRUE(trainer.message_with("mark: before"));
  trainer.say(R"({"do":"mark","text":5})");
  EXPECT_TRUE(trainer.message_with("500 bytes"));
  trainer.say(R"({"do":"mark","note":"x"})");
  EXPECT_TRUE(trainer.message_with("500 bytes"));
  trainer.say(R"({"do":"mark","text":"now"})");
  std::vector<Note> notes;
  for (int i = 0; i < 500 && notes.size() < 3; ++i) {  // a program that is killed then has it
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    notes = read_notes(s.folder.string());
  }
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_EQ(notes[0].recording + ": " + notes[0].text, "run.h5: before");
  EXPECT_EQ(notes[2].recording + ": " + notes[2].text, "branch-2.h5: now");
  std::ofstream(s.folder / "notes.json") << "[{";
  EXPECT_THROW(read_notes(s.folder.string()), data::LoadError);
}

TEST(Station, HintsAreOnWhatIsNotDoneAndAreRecorded) {
  Sitting s(Hands::seats);
  Client learner(s.station.port());
  ASSERT_TRUE(learner.come_in(Sitting::token(s.station.trainer_link())));
  EXPECT_TRUE(learner.message_with(R"("type":"ticks","at":[null,null])"));
  learner.say(R"({"do":"guide_feed","values":[1]})");
  learner.say(R"({"do":"jump"})");
  const auto refused = learner.message_with("\"refused\"");
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->find("take over"), std::string::npos) << "keys are taken before the first snapshot, too";
  for (const char* words :
       {R"("instruction":0,"words":"first","more":true)", R"("words":"second","more":false)", R"("words":"second")"}) {
    learner.say(R"({"do":"hint"})");
    EXPECT_TRUE(learner.message_with(words)) << words;
  }
  s.station.ear()({500, static_cast<int>(data::EventCode::instruction_done), -1, 0});
  EXPECT_TRUE(learner.message_with(R"("at":[0.5,null])"));
  learner.say(R"({"do":"hint"})");
  EXPECT_TRUE(learner.message_with(R"("instruction":1,"words":"third")"));
  s.play("run.h5");
  EXPECT_TRUE(learner.message_with("hint asked"));
  s.hand.controls(Seat::window).order(ConsoleCommand::end);
  s.steps.join();
  EXPECT_EQ(count(data::RecordingReader(s.file("run.h5")), data::EventCode::hint_asked), 1)
      << "time stood for all of them";
}

}  // namespace
}  // namespace ostium::app
