#pragma once
#include <stdexcept>

namespace ostium::data {

/// A file that cannot be read as what it should be. The message is for the person who wrote the file: file, line, key,
/// value found, what was expected.
struct LoadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ostium::data
