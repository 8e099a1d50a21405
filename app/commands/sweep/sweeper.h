#pragma once
/// Runs what remains of a sweep, or of its part, on several threads.
#include <exception>
#include <memory>
#include <mutex>

#include "app/commands/sweep/journal.h"
#include "app/session/run/play.h"

namespace ostium::app {

class Sweeper {
 public:
  /// All must outlive this.
  Sweeper(const SweepArguments& arguments, const Sweep& sweep, const JournalHead& head, SweepJournal& journal);

  /// One vessel at a time, so that only one is in memory. A run that throws, or whose vessel cannot be built, gets a
  /// line with the reason. Throws WriteError, and std::bad_alloc.
  void run();

  const Sweep& sweep() const { return sweep_; }
  std::size_t runs() const { return runs_; }      ///< of this part, done or not
  std::size_t unkept() const { return unkept_; }  ///< runs whose recording ends early

 private:
  bool lacks_recording(std::size_t run) const;
  /// Null if it cannot be built; its runs are then reported as aborted.
  std::shared_ptr<const Vessel> vessel_for(const RunSetup& setup, const std::vector<std::size_t>& open);
  void run_in(std::size_t vessel, const std::vector<std::size_t>& open);
  std::string line_for(std::size_t run, const RunSetup& vessel_setup, const std::shared_ptr<const Vessel>& vessel,
                       const std::shared_ptr<const Dosimeter>& dosimeter);
  void keep(const std::string& folder, const RunSetup& setup, const PlayReport& report);
  void add(std::size_t run, const std::string& line);

  const SweepArguments& arguments_;
  const Sweep& sweep_;
  SweepJournal& journal_;
  std::vector<std::size_t> mine_;  ///< runs of this part that are still to be done
  std::size_t runs_ = 0, unkept_ = 0;
  std::mutex mutex_;
  std::exception_ptr problem_;  ///< why the sweep ends early
};

}  // namespace ostium::app
