#pragma once
/// One page for a whole course: the list of its lessons, and the station of the one that is open. The server and its
/// links stay, stations come and go. A client names a lesson by its place in the list, and nothing else.
#include "app/serve/station/station.h"

namespace ostium::app {

/// What the page lists.
struct CourseBoard {
  struct Attempt {
    std::size_t number = 0;
    bool done = false, ended = false;  ///< ended: it has come to a verdict
    double seconds = 0;
    int hints = 0;
    std::vector<std::string> missed;  ///< what had to hold and did not
  };
  struct Lesson {
    std::string title, goal;
    std::vector<std::string> must_hold;
    std::vector<Attempt> attempts;
    bool done = false, locked = false;
    bool goes_on = false;  ///< its last attempt can go on
    bool exam = false;     ///< nobody shows it
    struct Tool {
      std::string name, instrument;
      std::vector<std::string> others;  ///< of its kind
    };
    std::vector<Tool> tools = {};  ///< whose instruments the learner may choose; empty: as the lesson has them
  };
  std::string title, note;
  std::string problem;  ///< of what was done last; empty: none
  std::vector<Lesson> lessons;
  bool chooses_person = false;          ///< the learner may
  std::optional<std::uint64_t> person;  ///< that is chosen; none: as each case has it
  std::size_t next = 0;                 ///< the first that has not been done
  std::optional<std::size_t> at;        ///< the lesson that is open
  bool opening = false;                 ///< it is not yet, but will be
};

/// What the learner wants.
struct Ask {
  enum class Kind {
    none,
    lesson,  ///< that lesson
    person,  ///< another one in all lessons
    list,    ///< away from the lesson that is open
    close    ///< the program ends
  } kind = Kind::none;
  std::size_t lesson = 0;
  enum class How { go_on, afresh, shown } how = How::go_on;
  std::vector<std::string> set = {};  ///< instruments of that lesson, "tool=instrument"
  std::optional<std::uint64_t> person = {};
};

class Classroom : public Listener {
 public:
  /// Throws std::runtime_error if the address cannot be listened at.
  Classroom(const std::string& address, std::uint16_t port);

  std::string trainer_link() const { return page_link(address_, server_->port(), trainer_token_); }
  std::string viewer_link() const { return page_link(address_, server_->port(), viewer_token_); }
  Server& server() { return *server_; }
  const std::string& viewer_token() const { return viewer_token_; }

  void show(const CourseBoard& board);
  /// The station of the open lesson, which has this room's server; everybody is greeted by it.
  void enter(Station& station);
  void leave();  ///< before it is gone

  /// What has been asked for since.
  Ask take();
  /// Until something is asked for, or `stop`.
  Ask wait(const std::atomic<bool>& stop);

  // --- Listener, on the server's thread
  std::vector<std::string> greet(Role role) override;
  std::string hear(Role role, const std::string& text) override;
  void lost_trainer() override;

 private:
  std::string obey(const std::string& what, const data::JsonValue& message);
  std::string open_lesson(const data::JsonValue& message);
  std::string take_person(const data::JsonValue& message);

  std::string address_, trainer_token_, viewer_token_;
  std::mutex mutex_;  ///< of what follows; taken before a station's own
  std::condition_variable asked_;
  CourseBoard board_;
  Station* station_ = nullptr;
  Ask ask_;
  std::unique_ptr<Server> server_;
};

}  // namespace ostium::app
