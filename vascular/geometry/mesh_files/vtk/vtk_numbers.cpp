#include "vascular/geometry/mesh_files/vtk/vtk_numbers.h"

#include <bit>
#include <charconv>
#include <map>
#include <type_traits>

namespace ostium::vascular {

std::optional<VtkType> vtk_type(const std::string& name) {
  // A legacy file's vtkIdType has four bytes whatever wrote it; its long is that of Unix.
  static const std::map<std::string, VtkType> types = {
      {"Int8", VtkType::int8},
      {"UInt8", VtkType::uint8},
      {"Int16", VtkType::int16},
      {"UInt16", VtkType::uint16},
      {"Int32", VtkType::int32},
      {"UInt32", VtkType::uint32},
      {"Int64", VtkType::int64},
      {"UInt64", VtkType::uint64},
      {"Float32", VtkType::float32},
      {"Float64", VtkType::float64},
      {"char", VtkType::int8},
      {"signed_char", VtkType::int8},
      {"unsigned_char", VtkType::uint8},
      {"short", VtkType::int16},
      {"unsigned_short", VtkType::uint16},
      {"int", VtkType::int32},
      {"vtkidtype", VtkType::int32},
      {"unsigned_int", VtkType::uint32},
      {"long", VtkType::int64},
      {"vtktypeint8", VtkType::int8},
      {"vtktypeuint8", VtkType::uint8},
      {"vtktypeint16", VtkType::int16},
      {"vtktypeuint16", VtkType::uint16},
      {"vtktypeint32", VtkType::int32},
      {"vtktypeuint32", VtkType::uint32},
      {"vtktypeint64", VtkType::int64},
      {"unsigned_long", VtkType::uint64},
      {"vtktypeuint64", VtkType::uint64},
      {"vtktypefloat32", VtkType::float32},
      {"vtktypefloat64", VtkType::float64},
      {"float", VtkType::float32},
      {"double", VtkType::float64},
  };
  const auto found = types.find(name);
  return found == types.end() ? std::nullopt : std::optional(found->second);
}

std::size_t size_of(VtkType type) {
  switch (type) {
    case VtkType::int8:
    case VtkType::uint8:
      return 1;
    case VtkType::int16:
    case VtkType::uint16:
      return 2;
    case VtkType::int32:
    case VtkType::uint32:
    case VtkType::float32:
      return 4;
    case VtkType::int64:
    case VtkType::uint64:
    case VtkType::float64:
      break;
  }
  return 8;
}

namespace {

template <class N>
N number_of(std::uint64_t bits, VtkType type) {
  if (std::is_integral_v<N> && (type == VtkType::float32 || type == VtkType::float64)) return N(-1);
  switch (type) {
    case VtkType::int8:
      return static_cast<N>(static_cast<std::int8_t>(bits));
    case VtkType::int16:
      return static_cast<N>(static_cast<std::int16_t>(bits));
    case VtkType::int32:
      return static_cast<N>(static_cast<std::int32_t>(bits));
    case VtkType::int64:
      return static_cast<N>(static_cast<std::int64_t>(bits));
    case VtkType::float32:
      return static_cast<N>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    case VtkType::float64:
      return static_cast<N>(std::bit_cast<double>(bits));
    case VtkType::uint8:
    case VtkType::uint16:
    case VtkType::uint32:
    case VtkType::uint64:
      break;
  }
  return static_cast<N>(bits);
}

bool blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

}  // namespace

template <class N>
std::vector<N> vtk_numbers(std::string_view bytes, VtkType type, bool big_endian) {
  const std::size_t size = size_of(type);
  std::vector<N> numbers;
  numbers.reserve(bytes.size() / size);
  for (std::size_t at = 0; at + size <= bytes.size(); at += size) {
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < size; ++k)
      bits = bits << 8 | static_cast<unsigned char>(bytes[at + (big_endian ? k : size - 1 - k)]);
    numbers.push_back(number_of<N>(bits, type));
  }
  return numbers;
}

std::string_view take_word(std::string_view& text) {
  std::size_t begin = 0;
  while (begin < text.size() && blank(text[begin])) ++begin;
  std::size_t end = begin;
  while (end < text.size() && !blank(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

template <class N>
std::optional<N> vtk_number(std::string_view word) {
  N number = 0;
  const char* last = word.data() + word.size();
  const auto [end, error] = std::from_chars(word.data(), last, number);
  if (word.empty() || end != last || error != std::errc()) return std::nullopt;
  return number;
}

template std::vector<double> vtk_numbers(std::string_view, VtkType, bool);
template std::vector<std::int64_t> vtk_numbers(std::string_view, VtkType, bool);
template std::optional<double> vtk_number(std::string_view);
template std::optional<std::int64_t> vtk_number(std::string_view);

}  // namespace ostium::vascular
