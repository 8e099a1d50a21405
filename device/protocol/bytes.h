#pragma once
/// Little-endian integers and IEEE floats in and out of a packet.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace ostium::device {

template <class T>
T get(std::span<const std::uint8_t> bytes, std::size_t at) {
  if constexpr (std::is_same_v<T, float>) {
    return std::bit_cast<float>(get<std::uint32_t>(bytes, at));
  } else {
    using Raw = std::make_unsigned_t<T>;
    Raw value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) value = static_cast<Raw>(value | Raw{bytes[at + i]} << (8 * i));
    return static_cast<T>(value);
  }
}

template <class T>
void put(std::span<std::uint8_t> bytes, std::size_t at, T value) {
  if constexpr (std::is_same_v<T, float>) {
    put(bytes, at, std::bit_cast<std::uint32_t>(value));
  } else {
    const auto raw = static_cast<std::make_unsigned_t<T>>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes[at + i] = static_cast<std::uint8_t>(raw >> (8 * i));
  }
}

}  // namespace ostium::device
