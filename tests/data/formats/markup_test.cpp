#include "data/formats/markup.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

namespace ostium::data {
namespace {

std::string letters_of(const std::string& bytes) {
  const std::vector<std::uint8_t> png(bytes.begin(), bytes.end());
  return data_uri(png);
}

// The vectors of RFC 4648, section 10.
TEST(Markup, PicturesAreBase64) {
  const std::string head = "data:image/png;base64,";
  EXPECT_EQ(letters_of(""), head);
  EXPECT_EQ(letters_of("f"), head + "Zg==");
  EXPECT_EQ(letters_of("fo"), head + "Zm8=");
  EXPECT_EQ(letters_of("foo"), head + "Zm9v");
  EXPECT_EQ(letters_of("foobar"), head + "Zm9vYmFy");
  EXPECT_EQ(letters_of("\xff\xfe\xfd"), head + "//79");
}

}  // namespace
}  // namespace ostium::data
