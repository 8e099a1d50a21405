#pragma once
/// Numbers that a person wrote, on a command line or as a value of --set.
#include <cstdint>
#include <optional>
#include <string_view>

namespace ostium::data {

/// A finite decimal number and nothing else: "-2.5", "1e-3". No spaces, no hexadecimal, no "nan", no "inf", nothing
/// that a double cannot hold.
std::optional<double> decimal(std::string_view text);
/// A whole number from 0 on, digits only, below 2^64.
std::optional<std::uint64_t> whole(std::string_view text);

}  // namespace ostium::data
