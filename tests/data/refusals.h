#pragma once
/// Shared by tests of strict readers.
#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "data/formats/json_object.h"
namespace ostium::data {

inline void expect_words(const std::string& message, std::initializer_list<const char*> words) {
  for (const char* word : words) EXPECT_NE(message.find(word), std::string::npos) << message << "\n  lacks: " << word;
}

}  // namespace ostium::data
