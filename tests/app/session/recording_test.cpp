/// Recordings replay bit-identically from any second; they stay intact whatever happens to the program or the disk;
/// files that are no recordings are refused by name.
#include "data/recording/recording.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "app/session/run/replay.h"
#include "app/session/scene/film.h"
#include "tests/app/session/recorded.h"

namespace ostium::app {
namespace {

std::string refusal(const std::string& file) {
  try {
    data::RecordingReader reader(file);
  } catch (const data::LoadError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Recording, ReplaysToTheBitFromAnySecond) {
  const Folder folder;
  const PlayReport report = recorded(folder("run.h5"), RecordMode::full);
  EXPECT_EQ(report.problem, "");
  EXPECT_LT(report.penetration.deepest_m, 0.05e-3);
  EXPECT_EQ(report.penetration.outside, 0);
  EXPECT_FALSE(fs::exists(folder("run.h5.next")));
  for (double from : {0.0, 1.0, 1.7}) {
    Replay replay(folder("run.h5"));
    replay.go_to(from);
    EXPECT_EQ(replay.state.rods.step, static_cast<std::uint64_t>(1000 * std::floor(from)));
    const VerifyReport verified = verify(replay);
    EXPECT_FALSE(verified.first_step);
    EXPECT_EQ(verified.steps, replay.recording.steps() - static_cast<std::size_t>(1000 * std::floor(from)));
    EXPECT_EQ(hash(replay.state), report.hash);
  }
  Replay replay(folder("run.h5"), tube_vessel());
  EXPECT_THROW(replay.go_to(1e3), data::LoadError);
  // Metrics are a function of the record alone.
  const std::string end = *replay.recording.end();
  const std::vector<data::Metric> again = metrics_of(record_of(replay.recording, replay.model));
  EXPECT_EQ(nlohmann::json::parse(metrics_json("tube", 0, "success", "", again)), nlohmann::json::parse(end));
}

TEST(Recording, HoldsWhatWasDoneInTheEnd) {
  const Folder folder;
  recorded(folder("run.h5"), RecordMode::full);
  const data::RecordingReader reader(folder("run.h5"));
  const std::vector<double> events = reader.events();
  ASSERT_GE(events.size(), 4u);
  EXPECT_EQ(events[events.size() - 3], static_cast<int>(data::EventCode::script_step_done));
  EXPECT_EQ(events[events.size() - 4], static_cast<double>(reader.steps()));
}

/// Whoever looks at a moment of a recording sees the state that was hashed then, or is told.
TEST(Recording, AStateThatWasChangedIsRefused) {
  const Folder folder;
  recorded(folder("run.h5"), RecordMode::full);
  copy_with(folder("run.h5"), folder("copy.h5"), "", {});
  Replay copy(folder("copy.h5"), tube_vessel());
  EXPECT_NO_THROW(copy.go_to(1.2));
  const std::size_t width = copy.recording.tables().numbers("state", 0, 1).size();
  copy_with(folder("run.h5"), folder("changed.h5"), "state", [&](std::vector<double>& states) {
    // The last number that is no count: what lies outside of the body, which is not hashed, comes first.
    std::size_t i = 2 * width - 1;
    while (states.at(i) == std::floor(states.at(i))) --i;
    states[i] *= 1 + 1e-12;
  });
  Replay changed(folder("changed.h5"), tube_vessel());
  EXPECT_NO_THROW(changed.go_to(0.5));
  try {
    changed.go_to(1.2);
    ADD_FAILURE() << "it was accepted";
  } catch (const data::LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("its state at 1 s is not the one"), std::string::npos) << error.what();
  }
}

/// No hash was made of the state at 0, whose indices may lead anywhere: it is not taken from the file.
TEST(Recording, BeginsAsTheModelDoesWhateverItsFirstStateSays) {
  const Folder folder;
  const PlayReport report = recorded(folder("run.h5"), RecordMode::full);
  const int width = data::RecordingReader(folder("run.h5")).state_width();
  copy_with(folder("run.h5"), folder("changed.h5"), "state",
            [&](std::vector<double>& states) { std::fill_n(states.begin(), width, 1e6); });
  Replay changed(folder("changed.h5"), tube_vessel());
  changed.go_to(0.5);
  EXPECT_FALSE(verify(changed).first_step);
  EXPECT_EQ(hash(changed.state), report.hash);
}

TEST(Recording, AnInputThatIsNoNumberIsRefused) {
  const Folder folder;
  recorded(folder("run.h5"), RecordMode::full);
  const std::size_t width = data::RecordingReader(folder("run.h5")).input_columns().size();
  for (const double no_number : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    copy_with(folder("run.h5"), folder("changed.h5"), "inputs",
              [&](std::vector<double>& inputs) { inputs[700 * width + 1] = no_number; });
    Replay changed(folder("changed.h5"), tube_vessel());
    try {
      verify(changed);
      ADD_FAILURE() << no_number << " was accepted";
    } catch (const data::LoadError& error) {
      EXPECT_NE(std::string(error.what()).find("wire.turn_rad_s is "), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(" in step 701; it is damaged"), std::string::npos) << error.what();
    }
  }
}

/// The overlay's clocks and dose are those of the whole run, however little of it is drawn.
TEST(Recording, AFilmOfItsEndSaysWhatTheWholeRunHasUsed) {
  const Folder folder;
  const PlayReport report = recorded(folder("run.h5"), RecordMode::full);
  const auto metric = [&](const std::string& name) {
    for (const data::Metric& m : report.metrics)
      if (m.name == name) return m.value;
    return -2.0;
  };
  Replay replay(folder("run.h5"), tube_vessel());
  FilmOptions options;
  options.pixels = 64;
  Film film(replay.model, options);
  replay.go_to(report.simulated_s);
  while (replay.tick()) {
  }
  film.frame(replay.model, replay.state, replay.inputs, replay.xrays());
  EXPECT_GT(metric("dap_Gy_cm2"), 0);
  EXPECT_NEAR(1e4 * film.dose().dose_area_Gy_m2, metric("dap_Gy_cm2"), 1e-9);
  EXPECT_NEAR(1e3 * film.dose().kerma_Gy, metric("air_kerma_mGy"), 1e-9);
  EXPECT_NEAR(film.dose().fluoroscopy_s, metric("fluoroscopy_time_s"), 2e-3);
  replay.go_to(1);  // backwards
  film.frame(replay.model, replay.state, replay.inputs, replay.xrays());
  EXPECT_NEAR(1e4 * film.dose().dose_area_Gy_m2 / metric("dap_Gy_cm2"), 1 / report.simulated_s, 0.05);
}

TEST(Recording, OfEventsAloneReplaysFromTheBeginning) {
  const Folder folder;
  const PlayReport report = recorded(folder("run.h5"), RecordMode::events);
  Replay replay(folder("run.h5"), tube_vessel());
  EXPECT_THROW(replay.go_to(1.5), data::LoadError);
  replay.go_to(0);
  EXPECT_FALSE(verify(replay).first_step);
  EXPECT_EQ(hash(replay.state), report.hash);
}

TEST(Recording, OfAnotherPhysicsIsToldByStepAndField) {
  const Folder folder;
  recorded(folder("run.h5"), RecordMode::full);
  const std::size_t first_touch = [&] {
    const data::RecordingReader reader(folder("run.h5"));
    const std::vector<std::string> columns = reader.signal_columns();
    const std::size_t at =
        static_cast<std::size_t>(std::find(columns.begin(), columns.end(), "wire.touches") - columns.begin());
    const std::vector<double> signals = reader.signals();
    for (std::size_t row = 0;; ++row)
      if (signals.at(row * columns.size() + at) > 0) return 10 * row;
  }();
  auto slippery = std::make_shared<Vessel>();
  std::string warnings;
  const RunSetup setup = tube_setup();
  const auto made = make_vessel(setup, warnings);
  slippery->name = made->name, slippery->wall = made->wall, slippery->entry = made->entry;
  slippery->way = std::make_unique<const VesselIndex>(*made->way);
  const auto wall = std::make_shared<core::Surface>(*made->surface);
  wall->friction = 0.2;  // instead of 0.1
  slippery->surface = wall;
  Replay replay(folder("run.h5"), slippery);
  const VerifyReport verified = verify(replay);
  ASSERT_TRUE(verified.first_step);
  EXPECT_GE(*verified.first_step + 10, first_touch) << "friction cannot differ before anything is touched";
  EXPECT_LE(*verified.first_step, first_touch + 20);
  EXPECT_EQ(verified.field_step % 1000, 0u);
  EXPECT_EQ(verified.field.rfind("rod 0 (wire), ", 0), 0u) << verified.field;
}

/// The thread sanitizer knows no threads in the child of a program that has some.
#ifdef __SANITIZE_THREAD__
constexpr bool children_have_threads = false;
#else
constexpr bool children_have_threads = true;
#endif

/// Recorded by a child process until it is killed; it reports its progress through shared memory.
TEST(Recording, IsWholeWheneverTheProgramIsKilled) {
  if (!children_have_threads) GTEST_SKIP() << "the thread sanitizer knows no threads in a child";
  tube_vessel();  // built before forking the children
  std::mt19937 random(1);
  auto* now = static_cast<volatile std::uint64_t*>(
      mmap(nullptr, sizeof(std::uint64_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  ASSERT_NE(now, MAP_FAILED);
  const Folder folder;
  for (int kill_at = 0; kill_at < 20; ++kill_at) {
    *now = 0;
    const pid_t child = fork();
    if (child == 0) {
      const RunSetup setup = tube_setup(there_and_back, static_cast<std::uint64_t>(kill_at + 1));
      ScriptedRun run(setup, tube_vessel());
      Recorder recorder({RecordMode::full, folder("run.h5"), false}, run.model, setup, save(run.hands).size());
      recorder.begin(run.state, run.hands);
      while (run.tick() || true) {  // goes on at rest when the script has ended
        recorder.add(run.inputs, run.state, run.report, run.hands, run.events);
        *now = *now + 1;
        if (*now > 3 * 1000) usleep(200);
      }
    }
    const std::uint64_t until = 600 + random() % 2500;
    while (*now < until && waitpid(child, nullptr, WNOHANG) == 0) usleep(50);
    ASSERT_GE(*now, until) << "the child ended by itself";
    usleep(random() % 20000);  // at any moment of writing
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
    const std::uint64_t reached = *now;
    ASSERT_NO_THROW({
      const data::RecordingReader reader(folder("run.h5"));
      EXPECT_FALSE(reader.end());
      // The writer may be behind by blocks it had no time for; a simulation much faster than real time is ahead by more
      // than one.
      EXPECT_LE(reader.steps(), reached + 1);
      EXPECT_EQ(reader.steps() % data::steps_per_block, 0u);
      EXPECT_EQ(reader.states(), (reader.steps() + 999) / 1000);
      reader.inputs(0, reader.steps());
      if (reader.states()) reader.state(reader.states() - 1);
    }) << "killed at step "
       << reached;
  }
  munmap(const_cast<std::uint64_t*>(now), sizeof(std::uint64_t));
}

/// How many steps are lost by a kill in real time.
std::uint64_t lost_steps(const std::string& file, volatile std::uint64_t* now) {
  *now = 0;
  const pid_t child = fork();
  if (child == 0) {
    const RunSetup setup = tube_setup();
    ScriptedRun run(setup, tube_vessel());
    PlayOptions options;
    options.recorder = {RecordMode::full, file, false};
    options.real = true;
    options.progress = [&](const ScriptedRun& r) { *now = r.state.rods.step; };
    play(run, setup, options);
    _exit(0);
  }
  while (*now < 1600 && waitpid(child, nullptr, WNOHANG) == 0) usleep(1000);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  const std::uint64_t reached = *now, kept = data::RecordingReader(file).steps();
  return reached > kept ? reached - kept : 0;
}

TEST(Recording, LosesAtMostHalfASecondInRealTime) {
  if (!children_have_threads) GTEST_SKIP() << "the thread sanitizer knows no threads in a child";
  tube_vessel();
  auto* now = static_cast<volatile std::uint64_t*>(
      mmap(nullptr, sizeof(std::uint64_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  ASSERT_NE(now, MAP_FAILED);
  const Folder folder;
  // On a busy machine the thread that writes waits for its turn, and that is no fault of its: the best of five.
  std::uint64_t least = 1600;
  for (int n = 0; n < 5 && least > 500; ++n) least = std::min(least, lost_steps(folder("run.h5"), now));
  munmap(const_cast<std::uint64_t*>(now), sizeof(std::uint64_t));
  double load = 0;
  getloadavg(&load, 1);
  if (least > 500 && load > 2 * std::thread::hardware_concurrency())
    GTEST_SKIP() << load << " programs want this machine's cores, and the thread that writes comes last";
  EXPECT_LE(least, 500u);
}

/// No file of this program grows beyond it while it lives, which is as good as a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }

 private:
  void (*signal_)(int);
  rlimit before_{};
};

TEST(Recording, OutlivesAFullDisk) {
  const Folder folder;
  recorded(folder("whole.h5"), RecordMode::full);
  const rlim_t most = fs::file_size(folder("whole.h5")) * 7 / 10;
  PlayReport report;
  {
    const FileSizeLimit limit(most);
    report = recorded(folder("run.h5"), RecordMode::full, tube_setup());
  }
  EXPECT_EQ(report.outcome, "success");
  EXPECT_NE(report.problem.find("is the disk full?"), std::string::npos) << report.problem;
  EXPECT_FALSE(fs::exists(folder("run.h5.next")));
  Replay replay(folder("run.h5"), tube_vessel());
  EXPECT_FALSE(replay.recording.end());
  EXPECT_GE(replay.recording.steps(), 500u);
  EXPECT_FALSE(verify(replay).first_step);
}

TEST(Recording, WhatIsNoneIsRefusedByName) {
  const Folder folder;
  EXPECT_NE(refusal(folder("none.h5")).find("there is no such file"), std::string::npos);
  std::ofstream(folder("text.h5")) << "not HDF5";
  EXPECT_NE(refusal(folder("text.h5")).find("is no HDF5 file"), std::string::npos);
  {
    data::TableFile foreign = data::TableFile::create(folder("foreign.h5"));
    foreign.add_table({"data", data::NumberType::float64, {}, 3, 10});
    foreign.close();
    data::TableFile older = data::TableFile::create(folder("older.h5"));
    older.set_text("schema", "ostium-recording/1");
    older.set_text("software", "ostium 9.9.9");
    older.close();
    data::TableFile other = data::TableFile::create(folder("other.h5"));
    other.set_text("schema", "someone's");
    other.close();
  }
  EXPECT_NE(refusal(folder("foreign.h5")).find("of another program"), std::string::npos);
  EXPECT_NE(refusal(folder("older.h5"))
                .find("version 1, written by ostium 9.9.9; this ostium reads versions 2 to 3, whose state and inputs "
                      "are laid out otherwise"),
            std::string::npos);
  EXPECT_NE(refusal(folder("other.h5")).find("schema \"someone's\""), std::string::npos);
  recorded(folder("run.h5"), RecordMode::events);
  const auto size = fs::file_size(folder("run.h5"));
  for (std::uintmax_t part : {size - 100, size / 2, size / 10, std::uintmax_t{100}}) {
    fs::copy_file(folder("run.h5"), folder("cut.h5"), fs::copy_options::overwrite_existing);
    fs::resize_file(folder("cut.h5"), part);
    EXPECT_NE(refusal(folder("cut.h5")).find("cut short, or damaged"), std::string::npos)
        << part << refusal(folder("cut.h5"));
  }
}

/// Like h5dump, h5py and others, which lock the file they read.
TEST(Recording, GoesOnWhileSomebodyLooksIntoIt) {
  const Folder folder;
  { data::TableFile::create(folder("run.h5")).close(); }
  const int reader = open(folder("run.h5").c_str(), O_RDONLY);
  ASSERT_GE(reader, 0);
  ASSERT_EQ(flock(reader, LOCK_SH), 0);
  EXPECT_NO_THROW(data::TableFile::open(folder("run.h5"), true).close());
  ::close(reader);
}

}  // namespace
}  // namespace ostium::app
