#include "core/base/fields.h"

#include <charconv>

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace ostium::core {

std::string FieldPath::words() const {
  std::string out = outer ? outer->words() : "";
  if (!out.empty()) out += ".";
  out += name;
  return index < 0 ? out : out + "[" + std::to_string(index) + "]";
}

std::uint64_t hash_bytes(const void* first, std::size_t bytes, std::uint64_t seed) {
  return XXH3_64bits_withSeed(first, bytes, seed);
}

std::string in_words(double number) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

std::string in_words(std::uint64_t number) { return std::to_string(number); }

std::string difference_in_words(const std::string& path, int index, const std::string& a, const std::string& b) {
  return path + (index < 0 ? "" : "[" + std::to_string(index) + "]") + ": " + a + " != " + b;
}

}  // namespace ostium::core
