/// The console's table: what a message must be, and what the table itself must hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "data/console/console_keys.h"
#include "data/console/console_order.h"

namespace ostium::data {
namespace {

TEST(ConsoleOrder, IsReadWithItsNumbers) {
  const ConsoleOrder order = read_console_order("message", R"({"do":"turn_arm","values":[5,-2.5]})");
  EXPECT_EQ(order.command, ConsoleCommand::turn_arm);
  EXPECT_EQ(order.values[0], 5);
  EXPECT_EQ(order.values[1], -2.5);
  EXPECT_EQ(read_console_order("message", R"({"do":"mark"})").command, ConsoleCommand::mark);
  EXPECT_EQ(read_console_order("message", R"({"do":"mark","values":[]})").command, ConsoleCommand::mark);
}

TEST(ConsoleOrder, WhatIsWrongIsNamedWithItsCure) {
  const std::pair<const char*, const char*> wrong[] = {{R"({"do":"dance"})", "turn_arm"},
                                                       {R"({"do":"turn_arm","values":[5]})", "2 numbers"},
                                                       {R"({"do":"turn_arm","values":[5,1e9]})", "-180 to 180 deg"},
                                                       {R"({"do":"frame_rate","values":[12]})", "3.75 7.5 15 30"},
                                                       {R"({"do":"view","values":[1.5]})", "1 to 8"},
                                                       {R"({"do":"pause","values":[1]})", "no values"},
                                                       {R"({"do":"provoke","values":[10,0,20,1]})", "what: 1 to 9"},
                                                       {R"({"do":"drain","values":[-1]})", "0 to 300 mL/min"},
                                                       {R"({"do":"pause","at":1})", "at"},
                                                       {R"({"values":[1]})", "do"},
                                                       {R"({"do":"gamma","values":["1"]})", "0.3 to 3"},
                                                       {R"({"do":"gamma","values":[null]})", "0.3 to 3"},
                                                       {R"({"do":"gamma","values":7})", "values"}};
  for (const auto& [message, says] : wrong) {
    try {
      read_console_order("message", message);
      ADD_FAILURE() << message;
    } catch (const LoadError& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << message << ": " << error.what();
    }
  }
}

TEST(ConsoleTable, EveryKeyGivesAnOrderThatAMessageCouldGiveAndNoKeyTwo) {
  std::set<std::pair<std::string, bool>> keys;
  for (const ConsoleKey& key : console_keys) {
    EXPECT_TRUE(keys.emplace(key.key, key.ctrl).second) << key.key;
    const ConsoleRow& row = row_of(key.order.command);
    for (std::size_t i = 0; i < static_cast<std::size_t>(row.count()); ++i) {
      EXPECT_GE(key.order.values[i], row.values[i].least) << key.key;
      EXPECT_LE(key.order.values[i], row.values[i].most) << key.key;
    }
  }
  for (const ConsoleCommand needed :
       {ConsoleCommand::heparin, ConsoleCommand::nitrate, ConsoleCommand::adenosine, ConsoleCommand::move_table,
        ConsoleCommand::mark, ConsoleCommand::roadmap, ConsoleCommand::review, ConsoleCommand::take_over})
    EXPECT_TRUE(std::any_of(std::begin(console_keys), std::end(console_keys), [&](const ConsoleKey& key) {
      return key.order.command == needed;
    })) << row_of(needed).name;
}

}  // namespace
}  // namespace ostium::data
