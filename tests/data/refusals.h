#pragma once
/// Shared by tests of strict readers.
#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "data/formats/json/json_object.h"
#include "data/formats/load_error.h"

namespace ostium::data {

/// What a reader says of what it refuses.
template <class Read>
std::string refusal_of(Read&& read) {
  try {
    read();
  } catch (const LoadError& error) {
    return error.what();
  }
  return "accepted";
}

inline void expect_words(const std::string& message, std::initializer_list<const char*> words) {
  for (const char* word : words) EXPECT_NE(message.find(word), std::string::npos) << message << "\n  lacks: " << word;
}

}  // namespace ostium::data
