#pragma once
/// The bytes of an array in VTK's XML files: in base64 or as they are, compressed or not.
#include <cstdint>
#include <string>
#include <string_view>

namespace ostium::vascular {

/// Hands out bytes one after another. Never more memory is taken than the file has bytes for.
class VtkBytes {
 public:
  /// `where` begins the messages: the file and the array. `text` must outlive this.
  VtkBytes(std::string where, std::string_view text, bool base64);

  /// The next ones; throws MeshError if so many are not there.
  std::string take(std::uint64_t count);
  /// At most so many are left.
  std::uint64_t left() const;
  const std::string& where() const { return where_; }

 private:
  bool decode_quad();

  std::string where_;
  std::string_view text_;
  bool base64_;
  std::string decoded_;  ///< what the last four letters gave and nobody took yet
};

struct VtkEncoding {
  bool big_endian = false;
  std::size_t header_bytes = 4;  ///< of each number before an array
  bool zlib = false;
};

/// One array, which begins with its length or, if it is compressed, with the number of its blocks, their length, the
/// last one's length (0: as the others) and what each is compressed to. Throws MeshError.
std::string vtk_array(VtkBytes& bytes, const VtkEncoding& encoding);

}  // namespace ostium::vascular
