#pragma once
/// Frames from the files of others: PNG, and DICOM where the build has it.
#include <string>
#include <vector>

#include "data/picture/image.h"

namespace ostium::data {

struct FramesFile {
  std::vector<Image> frames;
  std::vector<std::string> remarks;  ///< what is unusual about them, and what was done about it
};

/// Throws LoadError for a file that cannot be read, or holds no X-ray frames.
FramesFile read_frames(const std::string& file);

/// The same by format. DICOM: X-ray angiography or radiofluoroscopy (XA, RF), not compressed.
FramesFile read_png_frame(const std::string& file);
FramesFile read_dicom_frames(const std::string& file);

/// Whether thin white strokes, as of letters, lie on the picture.
bool seems_to_have_text(const Image& image);

/// Files of those formats in a folder, by name, and the file itself where it is one. Throws LoadError if there is none.
std::vector<std::string> frame_files(const std::string& file_or_folder);

}  // namespace ostium::data
