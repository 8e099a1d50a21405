#include "data/formats/decimal.h"

#include <charconv>
#include <cmath>

namespace ostium::data {

namespace {

/// std::from_chars over the whole text.
template <class Number>
std::optional<Number> all_of(std::string_view text) {
  Number value{};
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value);
  if (error != std::errc() || end != last) return {};
  return value;
}

}  // namespace

std::optional<double> decimal(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const std::optional<double> value = all_of<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::uint64_t> whole(std::string_view text) { return all_of<std::uint64_t>(text); }

}  // namespace ostium::data
