#pragma once
/// What a learner has done in a course: DIR/progress.json, and a folder DIR/LESSON-N for each attempt.
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "app/session/recorder/recorder.h"

namespace ostium::app {

/// Attempts, by lesson: {"feed-and-turn": [{"attempt": 1, "done": false, ...}, ...]}.
class Progress {
 public:
  using Json = nlohmann::ordered_json;

  /// Throws LoadError if the file is not what this wrote.
  explicit Progress(const std::string& folder);

  /// Number of the next attempt, from 1: also after one that was cut off before it could be noted.
  std::size_t next(const std::string& lesson) const;
  std::filesystem::path folder_of(const std::string& lesson, std::size_t number) const;
  const Json& attempts(const std::string& lesson) const;  ///< a list
  bool done(const std::string& lesson) const;
  bool is_open(const std::string& lesson) const;  ///< it was when the program ended

  /// The last attempt, and where it can go on; none where it is done, or nothing was recorded.
  struct Unfinished {
    std::size_t number = 0;
    Continued from;
    std::vector<std::string> set;  ///< instruments that were chosen for it
  };
  std::optional<Unfinished> unfinished(const std::string& lesson) const;

  /// An attempt is open from `begin` to `leave`.
  void begin(const std::string& lesson, std::size_t number, const std::vector<std::string>& set);
  void leave(const std::string& lesson, std::size_t number);
  struct Verdict {
    bool done = false;
    double seconds = 0;
    int hints = 0;
    std::vector<std::string> missed;
  };
  /// What an attempt has come to; one that has been done stays so, whatever a later branch of it does.
  void note(const std::string& lesson, std::size_t number, const Verdict& verdict);

 private:
  Json& attempt(const std::string& lesson, std::size_t number);
  void write() const;

  std::string file_;
  Json all_ = Json::object();
};

}  // namespace ostium::app
