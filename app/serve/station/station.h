#pragma once
/// A trainer's station beside a run: a server, a thread that draws and tells, and what the trainer asks for. The thread
/// that steps only publishes snapshots and events; it waits for nobody here.
#include <atomic>
#include <condition_variable>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <thread>

#include "app/serve/messages/messages.h"
#include "app/serve/station/notes.h"
#include "app/session/run/play.h"
#include "core/base/ring.h"

namespace ostium::app {

struct StationSettings {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;
  bool goes_back = false;  ///< whether the owner answers `wait` by going back
  bool has_pedals = true;
  int pixels = 512;
  fluoro::Renderer renderer = fluoro::Renderer::scanline;
  LessonWords lesson;
  std::string folder;        ///< where notes are kept; "": nowhere
  Server* server = nullptr;  ///< of a classroom, which tells this what it hears; null: one of its own
  std::string viewer_token;  ///< of that server
};

/// "http://127.0.0.1:8100/#token=...".
std::string page_link(const std::string& address, std::uint16_t port, const std::string& token);

/// What the trainer wants of a run that has ended, or has been ended for it.
struct Wish {
  enum class Kind { none, go_back, leave } kind = Kind::none;
  std::size_t second = 0;
};

class Station : public Listener {
 public:
  /// Both must outlive this. Throws std::runtime_error if the address cannot be listened at.
  Station(const ScriptedRun& run, LiveDriver& hand, data::ScoreList scoring, const StationSettings& settings);
  ~Station() override;

  std::string trainer_link() const;  ///< of a server of its own
  std::string viewer_link() const;
  std::uint16_t port() const { return server_->port(); }
  /// Until the picture is ready, which takes some seconds.
  void wait_for_picture() const { drawn_.wait(); }

  /// For RecorderOptions::heard, on the thread that steps.
  std::function<void(const SessionEvent&)> ear();

  /// From any thread: the run ends where it is, and its owner gets the wish to leave.
  void leave();

  // --- of the owner, between two plays
  /// Before the first: what had come before in the recording that this run continues as another one, with the notes of
  /// the folder. Throws LoadError.
  void recall(const std::vector<SessionEvent>& events, const std::string& recording);
  /// What has been asked for since; none: the run came to its own end.
  Wish wish();
  /// Until the trainer asks for something, or `stop`.
  Wish wait(const std::atomic<bool>& stop);
  /// The run goes on from that second, as another recording.
  void gone_back(std::size_t second, const std::string& recording);
  void ended(const PlayReport& report, const std::vector<data::Score>& scores);
  void reported(const std::string& html);  ///< the report's page
  void tell_problem(const std::string& what);
  std::vector<Note> notes();  ///< those whose mark has not come yet at the end
  /// In the folder, if there is one; while a run is on, the station's thread does so as they come. Throws WriteError.
  void keep_notes();

  // --- Listener, on the server's thread
  std::vector<std::string> greet(Role role) override;
  std::string hear(Role role, const std::string& text) override;
  void lost_trainer() override;

 private:
  void follow();
  void take_events();
  void keep_notes_or_tell();
  void tell_scores();
  void tell_ticks();
  std::optional<TimelineEntry> take_event(const SessionEvent& event);
  std::vector<std::optional<double>> ticks() const;
  std::string hint();
  std::string obey(const std::string& what, const data::JsonValue& message);
  std::string ask_to_go_back(const data::JsonValue& message);

  const ScriptedRun& run_;
  LiveDriver& hand_;
  StationSettings settings_;
  Setting setting_;
  std::string trainer_token_, viewer_token_;
  core::Ring<SessionEvent, 4096> heard_;
  std::atomic<bool> over_{false};
  std::atomic<int> hands_{0};
  std::atomic<double> now_s_{0}, furthest_s_{0};  ///< the second that is, and the last one of this recording
  mutable std::mutex mutex_;                      ///< of what follows; never taken by the thread that steps
  std::condition_variable asked_;
  std::vector<TimelineEntry> moments_;
  std::vector<SessionEvent> events_;
  std::vector<Note> notes_;                  ///< of branches that were left, too
  std::vector<std::string> unplaced_notes_;  ///< whose mark has not come yet
  std::string recording_ = "run.h5";
  std::atomic<bool> notes_are_new_{false};
  std::mutex keeping_;               ///< of the file of notes; taken before the other
  std::vector<std::string> sticky_;  ///< what those who come later must know: branches, the end
  std::string end_, final_scores_, report_;
  Wish wish_;
  bool has_ended_ = false;
  std::size_t hints_told_ = 0;  ///< on this instruction
  int hint_on_ = -1;
  std::unique_ptr<Server> own_server_;
  Server* server_;
  std::promise<void> drawing_;
  std::future<void> drawn_ = drawing_.get_future();
  std::thread thread_;
};

}  // namespace ostium::app
