#include "vascular/geometry/mesh_files/vtk/vtk_legacy_text.h"

#include <fmt/format.h>

#include <utility>

#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::vascular {

VtkLegacyText::VtkLegacyText(std::string path, std::string_view text) : path_(std::move(path)), rest_(text) {
  constexpr std::string_view magic = "# vtk DataFile Version ";
  const std::string_view first = line();
  const char major = first.size() > magic.size() ? first[magic.size()] : '0';
  if (!first.starts_with(magic) || major < '1' || major > '5')
    refuse(fmt::format("begins with \"{:.40}\"; expected \"{}\" with 1 to 5.1, or VTK's XML", first, magic));
  version_ = major - '0';
  line();  // a title
  const std::string coding = word();
  binary_ = coding == "binary";
  if (!binary_ && coding != "ascii") refuse(fmt::format("is \"{:.40}\"; expected ASCII or BINARY", coding));
}

void VtkLegacyText::refuse(const std::string& why) const { throw MeshError(path_ + ": " + why); }

std::string_view VtkLegacyText::line() {
  const std::size_t end = rest_.find('\n');
  std::string_view found = rest_.substr(0, end);
  rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
  if (found.ends_with('\r')) found.remove_suffix(1);
  return found;
}

std::string VtkLegacyText::word() { return in_lower_case(std::string(take_word(rest_))); }

void VtkLegacyText::expect(const std::string& wanted) {
  const std::string found = word();
  if (found != wanted)
    refuse(fmt::format("has \"{:.40}\" where \"{}\" should stand; expected a whole file, copy or export it again",
                       found, wanted));
}

std::uint64_t VtkLegacyText::count(const std::string& what) {
  const std::string_view found = take_word(rest_);
  const auto number = vtk_number<std::int64_t>(found);
  if (!number || *number < 0)
    refuse(fmt::format("{} is followed by \"{:.40}\"; expected a whole number from 0 on", what, found));
  if (static_cast<std::uint64_t>(*number) > rest_.size())
    refuse(
        fmt::format("is cut short: {} promises {}, and {} bytes are left for them; expected the whole file, copy it "
                    "again",
                    what, *number, rest_.size()));
  return static_cast<std::uint64_t>(*number);
}

VtkType VtkLegacyText::type() {
  const std::string name = word();
  const auto known = vtk_type(name);
  if (!known) refuse(fmt::format("has numbers of type \"{:.40}\"; expected float, double, int or the like", name));
  return *known;
}

std::string_view VtkLegacyText::bytes(std::uint64_t count) {
  if (count > rest_.size())
    refuse(fmt::format("is cut short: {} of {} bytes of an array are there; expected the whole file, copy it again",
                       rest_.size(), count));
  const std::string_view found = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return found;
}

template <class N>
std::vector<N> VtkLegacyText::numbers(std::uint64_t count, VtkType type) {
  if (binary_) {
    line();  // what is left of the one that announced them
    return vtk_numbers<N>(bytes(count * size_of(type)), type, true);
  }
  std::vector<N> all;
  while (all.size() < count) {
    const std::string_view found = take_word(rest_);
    const auto number = vtk_number<N>(found);
    if (!number)
      refuse(
          found.empty()
              ? fmt::format("is cut short: {} of {} numbers are there; expected the whole file, copy it again",
                            all.size(), count)
              : fmt::format("has \"{:.40}\" where a number should be; expected a whole file, copy or export it again",
                            found));
    all.push_back(*number);
  }
  return all;
}

template std::vector<double> VtkLegacyText::numbers(std::uint64_t, VtkType);
template std::vector<std::int64_t> VtkLegacyText::numbers(std::uint64_t, VtkType);

void VtkLegacyText::skip_metadata() {
  line();
  while (!line().empty()) {
  }
}

/// In binary files a string begins with its length: the two upper bits say how many bytes that has.
void VtkLegacyText::skip_string() {
  const auto first = static_cast<unsigned char>(bytes(1).front());
  std::uint64_t length = first & 0x3f;
  const int more = first >> 6 == 3 ? 0 : first >> 6 == 2 ? 1 : first >> 6 == 1 ? 3 : 7;
  for (char c : bytes(static_cast<std::uint64_t>(more))) length = length << 8 | static_cast<unsigned char>(c);
  bytes(length);
}

void VtkLegacyText::skip_array(std::uint64_t values) {
  const std::string name = word();
  const auto known = vtk_type(name);
  if (!known && name != "string" && name != "bit")
    refuse(fmt::format("has a field of type \"{:.40}\"; expected numbers or strings: save it without fields", name));
  line();
  if (binary_ && known)
    bytes(values * size_of(*known));
  else if (binary_ && name == "bit")
    bytes((values + 7) / 8);
  else
    for (std::uint64_t k = 0; k < values; ++k) {
      if (rest_.empty()) refuse("is cut short within a field; expected the whole file, copy it again");
      if (name != "string")
        take_word(rest_);
      else if (binary_)
        skip_string();
      else
        line();
    }
}

void VtkLegacyText::skip_field() {
  word();  // its name
  const std::uint64_t arrays = count("FIELD");
  for (std::uint64_t k = 0; k < arrays; ++k) {
    std::string name = word();
    while (name == "metadata") {
      skip_metadata();
      name = word();
    }
    const std::uint64_t components = count(name), tuples = count(name);
    if (components && tuples > (rest_.size() + 1) * 8 / components)
      refuse(
          fmt::format("is cut short: the field {:.40} promises {} times {} values, and {} bytes are left; expected "
                      "the whole file, copy it again",
                      name, tuples, components, rest_.size()));
    skip_array(components * tuples);
  }
}

}  // namespace ostium::vascular
