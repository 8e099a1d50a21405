#pragma once
/// A learner in a course: one page, on which lessons are chosen, played, judged and tried again.
#include "app/commands/learn/progress.h"
#include "app/commands/serve/serve.h"
#include "data/catalogue/course/course.h"

namespace ostium::app {

/// What a lesson is judged by.
struct CheckedLesson {
  data::ScoreList list;
  std::vector<std::size_t> needed;  ///< places in the list of what must hold to go on
};

class Schooling {
 public:
  /// The course for another person, or as its cases have it, with the same lessons in the same order.
  using ForPerson = std::function<data::Course(std::optional<std::uint64_t> person)>;

  /// `lessons` and `progress` must outlive it. `for_person`: the learner may choose a person, and the instruments of a
  /// lesson; empty: the course says both.
  Schooling(data::Course course, const std::vector<CheckedLesson>& lessons, Progress& progress, ForPerson for_person)
      : course_(std::move(course)), lessons_(lessons), progress_(progress), for_person_(std::move(for_person)) {
    if (for_person_) find_tools();
  }

  /// Until the learner closes the course, or the program is asked to end. `first`: what is opened at once.
  /// `required`: throws why it cannot be opened; else that is told on the page, as it is of later ones.
  int attend(std::uint16_t port, const Ask& first, bool required);

 private:
  void find_tools();
  void choose(std::optional<std::uint64_t> person);
  CourseBoard board(std::optional<std::size_t> at) const;
  void open(Classroom& room, const Ask& ask);
  void tell_problem(const std::string& what);
  void kept(const std::function<void()>& change);
  void attempt(ServeArguments& serving, std::size_t place, const Ask& ask);
  ServeArguments serving_of(std::size_t place) const;
  Progress::Verdict verdict(std::size_t place, const Served& served) const;

  data::Course course_;
  const std::vector<CheckedLesson>& lessons_;
  Progress& progress_;
  ForPerson for_person_;
  std::optional<std::uint64_t> person_;
  std::vector<std::vector<CourseBoard::Lesson::Tool>> tools_;  ///< of each lesson that may be chosen
  std::string problem_;                                        ///< of what was done last
};

}  // namespace ostium::app
