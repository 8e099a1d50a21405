#include "data/formats/csv.h"

#include <gtest/gtest.h>

namespace ostium::data {
namespace {

TEST(Csv, FieldsAreQuotedWhereTheyHaveToBeAndNeverFormulas) {
  EXPECT_EQ(csv_field("P07-1"), "P07-1");
  EXPECT_EQ(csv_field("a, \"b\"\n"), "\"a, \"\"b\"\"\n\"");
  EXPECT_EQ(csv_field("=1+1"), "'=1+1");
  EXPECT_EQ(csv_field("@SUM(A1,A2)"), "\"'@SUM(A1,A2)\"");
  EXPECT_EQ(csv_field("-cmd"), "'-cmd");
  EXPECT_EQ(csv_field("\t=1"), "'\t=1");
  EXPECT_EQ(csv_field("\uff1d1+1"), "'\uff1d1+1") << "wide";
  EXPECT_EQ(csv_field("\u00c4sthetik"), "\u00c4sthetik") << "a letter beyond ASCII is none";
  EXPECT_EQ(csv_field(""), "");
}

}  // namespace
}  // namespace ostium::data
