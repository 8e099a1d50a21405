#include "vascular/geometry/mesh_files/vtk/vtk_bytes.h"

#include <fmt/format.h>
#include <zlib.h>

#include <utility>
#include <vector>

#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh_files/vtk/vtk_numbers.h"

namespace ostium::vascular {

namespace {

/// Of a letter in base64; -1 for others.
int six_bits(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::string cut_short(const std::string& where, std::uint64_t wanted, std::uint64_t left) {
  return fmt::format(
      "{} is cut short: {} of the {} bytes that it promises can be there; expected the whole file, copy "
      "it again",
      where, left, wanted);
}

}  // namespace

VtkBytes::VtkBytes(std::string where, std::string_view text, bool base64)
    : where_(std::move(where)), text_(text), base64_(base64) {}

std::uint64_t VtkBytes::left() const { return base64_ ? decoded_.size() + (text_.size() + 3) / 4 * 3 : text_.size(); }

/// Four letters. Padding may also stand between, as a header has its own where the data are compressed.
bool VtkBytes::decode_quad() {
  std::uint32_t bits = 0;
  int letters = 0, padding = 0;
  std::size_t at = 0;
  for (; at < text_.size() && letters + padding < 4; ++at) {
    const char c = text_[at];
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    const int six = c == '=' ? 0 : six_bits(c);
    if (six < 0 || (padding && c != '='))
      throw MeshError(
          fmt::format("{} holds a sign that is not of base64; expected a whole file, copy or export it "
                      "again",
                      where_));
    ++(c == '=' ? padding : letters);
    bits = bits << 6 | static_cast<std::uint32_t>(six);
  }
  text_.remove_prefix(at);
  if (letters + padding < 4 || letters < 2) return false;
  for (int k = 0; k < letters - 1; ++k) decoded_ += static_cast<char>(bits >> (16 - 8 * k) & 0xff);
  return true;
}

std::string VtkBytes::take(std::uint64_t count) {
  if (count > left()) throw MeshError(cut_short(where_, count, left()));
  std::string taken;
  if (!base64_) {
    taken = text_.substr(0, count);
    text_.remove_prefix(count);
    return taken;
  }
  taken.reserve(count + 3);
  taken.swap(decoded_);
  while (taken.size() < count) {
    if (!decode_quad()) throw MeshError(cut_short(where_, count, taken.size()));
    taken += std::exchange(decoded_, {});
  }
  decoded_ = taken.substr(count);
  taken.resize(count);
  return taken;
}

namespace {

std::vector<std::uint64_t> header(VtkBytes& bytes, const VtkEncoding& encoding, std::uint64_t numbers) {
  if (numbers > bytes.left() / encoding.header_bytes)
    throw MeshError(
        fmt::format("{} is cut short: it promises {} blocks, and {} bytes are left for them; expected the "
                    "whole file, copy it again",
                    bytes.where(), numbers, bytes.left()));
  const VtkType type = encoding.header_bytes == 8 ? VtkType::uint64 : VtkType::uint32;
  std::vector<std::uint64_t> all;
  for (std::int64_t number :
       vtk_numbers<std::int64_t>(bytes.take(numbers * encoding.header_bytes), type, encoding.big_endian))
    all.push_back(static_cast<std::uint64_t>(number));
  return all;
}

/// Deflate makes of one byte at most 1032, so a block that promises more is damaged.
void append_block(const VtkBytes& bytes, const std::string& packed, std::uint64_t size, std::string& array) {
  constexpr std::uint64_t most_of_one = 1032;
  const std::size_t before = array.size();
  uLongf unpacked = 0;
  if (size <= most_of_one * packed.size()) {
    array.resize(before + size);
    unpacked = size;
    const int result = uncompress(reinterpret_cast<Bytef*>(array.data() + before), &unpacked,
                                  reinterpret_cast<const Bytef*>(packed.data()), packed.size());
    if (result == Z_OK && unpacked == size) return;
  }
  throw MeshError(
      fmt::format("{} has a block of {} bytes that does not unpack to the {} promised; expected a whole "
                  "file, copy or export it again",
                  bytes.where(), packed.size(), size));
}

}  // namespace

std::string vtk_array(VtkBytes& bytes, const VtkEncoding& encoding) {
  const std::uint64_t first = header(bytes, encoding, 1).front();
  if (!encoding.zlib) return bytes.take(first);
  std::string array;
  if (first == 0) return array;
  const std::vector<std::uint64_t> sizes = header(bytes, encoding, 2), packed = header(bytes, encoding, first);
  for (std::size_t block = 0; block < packed.size(); ++block) {
    const bool partial = block + 1 == packed.size() && sizes[1] > 0;
    append_block(bytes, bytes.take(packed[block]), partial ? sizes[1] : sizes[0], array);
  }
  return array;
}

}  // namespace ostium::vascular
