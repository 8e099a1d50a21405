#pragma once
/// The words and numbers of VTK's legacy files, one after another.
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "vascular/geometry/mesh_files/vtk/vtk_numbers.h"

namespace ostium::vascular {

class VtkLegacyText {
 public:
  /// Reads the header. `text` must outlive this. Here and below throws MeshError for what is not as it should be.
  VtkLegacyText(std::string path, std::string_view text);

  /// The next word in lower case, since VTK ignores case; empty at the end.
  std::string word();
  void expect(const std::string& word);
  /// One that the rest of the file could hold; `what` is for messages.
  std::uint64_t count(const std::string& what);
  VtkType type();
  /// Those that follow the line: as words, or big-endian as bytes. N is double or std::int64_t.
  template <class N>
  std::vector<N> numbers(std::uint64_t count, VtkType type);

  /// Arrays that have nothing to do with the surface: the words behind FIELD, and what they announce.
  void skip_field();
  /// Names and units of components, up to an empty line.
  void skip_metadata();

  int version() const { return version_; }
  const std::string& path() const { return path_; }
  [[noreturn]] void refuse(const std::string& why) const;

 private:
  std::string_view line();
  std::string_view bytes(std::uint64_t count);
  void skip_array(std::uint64_t values);
  void skip_string();

  std::string path_;
  std::string_view rest_;
  bool binary_ = false;
  int version_ = 0;
};

}  // namespace ostium::vascular
