#pragma once
/// Numbers in VTK's files, as text or as bytes of a named type.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostium::vascular {

enum class VtkType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

/// By its name in XML ("Float32") or in a legacy file ("float"); none if it is no number's.
std::optional<VtkType> vtk_type(const std::string& name);
std::size_t size_of(VtkType type);

/// All numbers in `bytes`; what is left at the end is dropped. N is double or std::int64_t. What cannot
/// be the latter, being too large or of a real type, becomes negative, which no index and no count may be.
template <class N>
std::vector<N> vtk_numbers(std::string_view bytes, VtkType type, bool big_endian);

/// The first word of `text`, which then begins behind it; empty at the end.
std::string_view take_word(std::string_view& text);

/// One number; none if `word` is anything else. N as above.
template <class N>
std::optional<N> vtk_number(std::string_view word);

}  // namespace ostium::vascular
