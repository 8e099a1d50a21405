/// One page for a course: lessons are named by their place alone, and the room stays as stations come and go.
#include "app/serve/classroom/classroom.h"

#include <gtest/gtest.h>

#include "tests/app/serve/client.h"

namespace ostium::app {
namespace {

CourseBoard board_of(std::size_t lessons, std::size_t done) {
  CourseBoard board;
  board.title = "Mine";
  for (std::size_t i = 0; i < lessons; ++i) {
    CourseBoard::Lesson lesson;
    lesson.title = "Lesson " + std::to_string(i), lesson.done = i<done, lesson.locked = i> done;
    board.lessons.push_back(lesson);
  }
  board.next = done;
  return board;
}

std::string token(const std::string& link) { return link.substr(link.find('=') + 1); }

TEST(Classroom, AsksAreLessonsByTheirPlaceAndNothingElse) {
  Classroom room("127.0.0.1", 0);
  room.show(board_of(3, 1));
  Client learner(room.server().port()), viewer(room.server().port());
  ASSERT_TRUE(learner.come_in(token(room.trainer_link()), R"("role":"trainer")"));
  ASSERT_TRUE(viewer.come_in(token(room.viewer_link()), R"("role":"viewer")"));
  EXPECT_TRUE(viewer.message_with("Lesson 2"));
  EXPECT_TRUE(learner.message_with("Lesson 2"));

  for (const char* nonsense :
       {R"({"do":"lesson"})", R"({"do":"lesson","values":[-1,0]})", R"({"do":"lesson","values":[3,0]})",
        R"({"do":"lesson","values":[0.5,0]})", R"({"do":"lesson","values":[0]})", R"({"do":"lesson","values":[0,3]})",
        R"({"do":"lesson","values":["../one",0]})", R"({"do":"lesson","values":[0,0,0]})"}) {
    learner.say(nonsense);
    EXPECT_TRUE(learner.message_with("expected a lesson of the list")) << nonsense;
  }
  learner.say(R"({"do":"lesson","values":[2,0]})");
  EXPECT_TRUE(learner.message_with("it is locked"));
  learner.say(R"({"do":"guide_feed","values":[1]})");
  EXPECT_TRUE(learner.message_with("no lesson is open"));
  for (const char* own : {R"({"do":"lesson","values":[0,0]})", R"({"do":"course"})", R"({"do":"close"})"}) {
    viewer.say(own);
    EXPECT_TRUE(viewer.message_with("viewers look on")) << own;
  }
  EXPECT_EQ(room.take().kind, Ask::Kind::none);

  learner.say(R"({"do":"lesson","values":[1,1]})");
  const std::atomic<bool> never{false};
  const Ask ask = room.wait(never);
  EXPECT_EQ(ask.kind, Ask::Kind::lesson);
  EXPECT_EQ(ask.lesson, 1u);
  EXPECT_EQ(ask.how, Ask::How::afresh);
  learner.say(R"({"do":"close"})");
  EXPECT_EQ(room.wait(never).kind, Ask::Kind::close);
}

}  // namespace
}  // namespace ostium::app
