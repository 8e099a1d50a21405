#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <random>

namespace ostium::fuzz {

namespace {

/// Numbers on which readers have stumbled.
constexpr std::array numbers = {"0",
                                "-1",
                                "1",
                                "3",
                                "255",
                                "65536",
                                "2147483647",
                                "2147483648",
                                "4294967295",
                                "-2147483649",
                                "9223372036854775807",
                                "18446744073709551616",
                                "1e9",
                                "1e308",
                                "1e-320",
                                "1e999",
                                "nan",
                                "inf",
                                "0x10",
                                "-0",
                                "1.5",
                                "",
                                "\"x\"",
                                "[]",
                                "null"};
constexpr std::array<std::uint64_t, 12> words = {
    0, 1, 0x7f, 0x80, 0xff, 0x7fff, 0xffff, 0x7fffffff, 0x80000000, 0xffffffff, 0x7fffffffffffffff, ~std::uint64_t{0}};

class Mutation {
 public:
  Mutation(const std::vector<Seed>& seeds, std::uint64_t seed, std::uint64_t index)
      : seeds_(seeds), random_(seed * 0x9e3779b97f4a7c15u + index) {}

  Seed make() {
    Seed out = seeds_[below(seeds_.size())];
    text_ = &out.bytes;
    // Most have few changes, so that many get past the reader's first checks.
    for (std::size_t left = 1 + below(below(4) + 1); left > 0; --left) change();
    return out;
  }

 private:
  std::size_t below(std::size_t n) { return n ? random_() % n : 0; }
  std::size_t place() { return below(text_->size()); }
  std::size_t stretch() { return 1 + below(std::size_t{1} << below(8)); }

  void change() {
    std::string& t = *text_;
    if (t.empty()) return void(t.append(1, static_cast<char>(random_())));
    switch (below(18)) {
      case 0:
        return write_word();
      case 1:
      case 2:
        return write_number();
      case 3:
        t.erase(place(), stretch());
        break;
      case 4: {
        const std::string part = t.substr(place(), stretch());
        t.insert(place(), part);
        break;
      }
      case 5: {
        const std::string& other = seeds_[below(seeds_.size())].bytes;
        const std::string part = other.substr(below(other.size()), stretch());
        t.replace(place(), part.size(), part);
        break;
      }
      case 6:
        if (below(2)) t.resize(place());
        break;
      default:
        nudge();
    }
  }

  /// In a text mostly a digit, which stays one: the text stays what it is but for a number.
  void nudge() {
    std::string& t = *text_;
    std::size_t at = place();
    if (t.find('\0') == std::string::npos && below(4)) at = std::min(t.find_first_of("0123456789", at), t.size() - 1);
    char& c = t[at];
    if (c >= '0' && c <= '9' && below(4))
      c = static_cast<char>('0' + below(10));
    else if (below(2))
      c ^= static_cast<char>(1 << below(8));
    else
      c = static_cast<char>(random_());
  }

  void write_word() {
    std::uint64_t word = words[below(words.size())];
    const bool big_endian = below(2);
    const std::size_t size = std::size_t{1} << below(4), at = place();
    for (std::size_t k = 0; k < size && at + k < text_->size(); ++k)
      (*text_)[at + k] = static_cast<char>(word >> 8 * (big_endian ? size - 1 - k : k));
  }

  /// Over the next number of a text, or where there is none.
  void write_number() {
    std::string& t = *text_;
    const std::string_view digits = "0123456789.+-eE";
    const std::size_t begin = std::min(t.find_first_of("0123456789", place()), t.size());
    const std::size_t end = std::min(t.find_first_not_of(digits, begin), t.size());
    if (end - begin > 40) return write_word();  // no number, but what base64 or a program made
    t.replace(begin, end - begin, numbers[below(numbers.size())]);
  }

  const std::vector<Seed>& seeds_;
  std::mt19937_64 random_;
  std::string* text_ = nullptr;
};

}  // namespace

Seed mutant(const std::vector<Seed>& seeds, std::uint64_t seed, std::uint64_t index) {
  return Mutation(seeds, seed, index).make();
}

}  // namespace ostium::fuzz
