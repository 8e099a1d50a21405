/// JSON has limits, and each refusal names file, place and limit; nothing of a file ends up in a terminal as it is.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "data/assessment/score_list.h"
#include "data/formats/json/json_value.h"
#include "tests/data/refusals.h"

namespace ostium::data {
namespace {

std::string refusal(const std::string& text) {
  return refusal_of([&] { parse_json("folder/thing.json", text); });
}

std::string row(std::size_t count, const std::string& one) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += (i ? "," : "") + one;
  return text;
}

std::string key(std::size_t i) { return "\"k" + std::to_string(i) + "\": 1"; }

TEST(Json, EveryLimitIsNamedWithFilePlaceAndNumber) {
  const std::size_t keys = json_limits::keys, bytes = json_limits::key_bytes, text = json_limits::text_bytes;
  expect_words(refusal("{\"a\":\n{\"" + std::string(bytes + 1, 'k') + "\": 1}}"),
               {"folder/thing.json:2: a has a key of 201 bytes", "at most 200 bytes"});
  expect_words(refusal("{\"a\": [1,\n\"" + std::string(text + 1, 't') + "\"]}"),
               {"folder/thing.json:2: a has a text of 65537 bytes", "at most 65536 bytes"});
  std::string many = "{";
  for (std::size_t i = 0; i <= keys; ++i) many += key(i) + (i < keys ? "," : "}");
  expect_words(refusal(many), {"folder/thing.json:1: the file has an object of more keys", "at most 4096"});
  expect_words(refusal("{\"list\": [" + row(json_limits::values, "0") + "]}"),
               {"folder/thing.json:1: list has too many values", "at most 1000000 in a file"});
  expect_words(refusal(std::string(json_limits::depth + 1, '[')), {"folder/thing.json:1:", "nests deeper than 32"});
  expect_words(refusal(std::string(json_limits::bytes + 1, ' ')), {"folder/thing.json: has more than 16 MiB"});
  EXPECT_EQ(refusal("{\"" + std::string(bytes, 'k') + "\": [" + row(json_limits::values - 2, "0") + "]}"), "accepted");
}

TEST(Json, Utf16IsSaidToBeSuchWithOrWithoutItsMark) {
  using namespace std::string_literals;
  for (const std::string& text : {"\xFF\xFE{\0}\0"s, "\xFE\xFF\0{\0}"s, "{\0}\0"s, "\0{\0}"s})
    expect_words(refusal(text), {"folder/thing.json: is UTF-16; save it as UTF-8"});
  EXPECT_EQ(refusal("\xEF\xBB\xBF{}"), "accepted") << "UTF-8 with a mark";
}

TEST(Json, AFileWithoutEndIsRefused) {
  expect_words(refusal_of([] { load_json("/dev/zero"); }), {"/dev/zero: cannot be read, it is a device, not a file"});
}

TEST(Json, APipeThatNobodyFillsIsRefused) {
  const std::string pipe = testing::TempDir() + "pipe.json";
  std::remove(pipe.c_str());
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  expect_words(refusal_of([&] { load_json(pipe); }), {"pipe.json: cannot be read, it is a pipe, not a file"});
  expect_words(refusal_of([&] { find_score_list(pipe); }), {"pipe", "expected a scoring list"});
  std::remove(pipe.c_str());
}

TEST(Json, APathIsWrittenWhereItIsWanted) {
  const JsonValue file = parse_json("a.json", R"({"a": {"b c": [0, [{"d": 1}]]}, "": {"e": 2}})");
  EXPECT_EQ(file.path(), "");
  EXPECT_EQ(file.find("a")->find("b c")->items[1].items[0].find("d")->path(), "a.b c[1][0].d");
  EXPECT_EQ(file.find("")->find("e")->path(), ".e");
  EXPECT_EQ(parse_json("a.json", "[[7]]").items[0].items[0].path(), "[0][0]");
}

TEST(Json, AKeyGivenTwiceIsFoundAmongMany) {
  std::string many = "{";
  for (std::size_t i = 0; i + 1 < json_limits::keys; ++i) many += key(i) + ",";
  expect_words(refusal(many + "\n" + key(17) + "}"), {"folder/thing.json:2: \"k17\" is given twice"});
  EXPECT_EQ(refusal("[" + row(3, "{\"a\": {\"a\": 1}}") + "]"), "accepted");
}

TEST(Json, OnlyUtf8IsReadAndOnlyUtf8IsShown) {
  for (const char* bad : {"\xff", "\xc3(", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xc0\x80"}) {
    const std::string message = refusal("{\n\"a\": \"" + std::string(bad) + "\"}");
    expect_words(message, {"folder/thing.json:2: is not JSON", "UTF-8"});
    for (char c : message) EXPECT_TRUE(c >= ' ' && c < 0x7f) << message;
  }
  expect_words(refusal("1e999"), {"folder/thing.json:1: is not JSON: number overflow"});
  // A text is cut between its letters (here of three bytes), and what steers a terminal is taken out.
  std::string text;
  for (int i = 0; i < 30; ++i) text += "\xe2\x82\xac";
  const JsonValue value = parse_json("a.json", "{\"x\": \"" + text + "\"}");
  EXPECT_EQ(refusal_of([&] { value.members[0].value.refuse("less"); }),
            "a.json:1: x is \"" + text.substr(0, 39) + "...\"; expected less");
  for (const char* steers : {"\\u001b[2J", "\\u0007", "\\u007f", "\\u009b2J"}) {
    expect_words(refusal("{\"" + std::string(steers) + "x\": 1}"), {"thing.json:1: the key \"?", "control character"});
    expect_words(refusal("[\"" + std::string(steers) + "x\"]"), {"thing.json:1: [0] \"?", "control character"});
  }
  EXPECT_EQ(parse_json("a.json", R"("a\tb\nc\u00e9")").text, "a\tb\nc\u00e9");
}

}  // namespace
}  // namespace ostium::data
