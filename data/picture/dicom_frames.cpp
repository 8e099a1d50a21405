#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <fmt/format.h>

#include <cmath>

#include "data/formats/load_error.h"
#include "data/picture/frames_file.h"

namespace ostium::data {

namespace {

int word(DcmDataset& dataset, const DcmTagKey& tag, int otherwise) {
  Uint16 value = 0;
  return dataset.findAndGetUint16(tag, value).good() ? value : otherwise;
}

std::string text(DcmDataset& dataset, const DcmTagKey& tag) {
  OFString value;
  dataset.findAndGetOFString(tag, value);
  return value.c_str();  // NOLINT(readability-redundant-string-cstr): OFString may be a string of its own
}

}  // namespace

FramesFile read_dicom_frames(const std::string& file) {
  DcmFileFormat format;
  if (format.loadFile(file.c_str()).bad()) throw LoadError(file + ": neither PNG nor DICOM that can be read");
  DcmDataset& dataset = *format.getDataset();
  const std::string modality = text(dataset, DCM_Modality);
  if (modality != "XA" && modality != "RF")
    throw LoadError(fmt::format("{}: its modality is \"{}\"; expected XA or RF", file, modality));
  if (dataset.chooseRepresentation(EXS_LittleEndianExplicit, nullptr).bad())
    throw LoadError(file + ": its pixels are compressed; expected them plain (dcmdjpeg writes them so)");
  const int rows = word(dataset, DCM_Rows, 0), columns = word(dataset, DCM_Columns, 0),
            allocated = word(dataset, DCM_BitsAllocated, 8), stored = word(dataset, DCM_BitsStored, allocated);
  if (word(dataset, DCM_SamplesPerPixel, 1) != 1)
    throw LoadError(file + ": its pixels are in colour; expected one sample a pixel");
  Sint32 count = 1;
  dataset.findAndGetSint32(DCM_NumberOfFrames, count);
  const auto each = static_cast<unsigned long>(rows) * static_cast<unsigned long>(columns);
  const Uint8* bytes = nullptr;
  const Uint16* words = nullptr;
  unsigned long have = 0;
  const bool read = allocated == 8 ? dataset.findAndGetUint8Array(DCM_PixelData, bytes, &have).good()
                                   : dataset.findAndGetUint16Array(DCM_PixelData, words, &have).good();
  if (!read || each == 0 || have < each * static_cast<unsigned long>(count))
    throw LoadError(file + ": its pixels are missing or cut short");
  FramesFile out;
  const double white = std::pow(2.0, stored) - 1;
  const bool inverted = text(dataset, DCM_PhotometricInterpretation) == "MONOCHROME1";
  for (Sint32 n = 0; n < count; ++n) {
    Image& image = out.frames.emplace_back(rows, columns);
    for (unsigned long i = 0; i < each; ++i) {
      const unsigned long at = static_cast<unsigned long>(n) * each + i;
      const double grey = 255 / white * (allocated == 8 ? bytes[at] : words[at]);
      image.data()[i] = inverted ? 255 - grey : grey;
    }
  }
  if (stored > 8)
    out.remarks.push_back(fmt::format("{} bits: {:.0f} is taken as white, without a window", stored, white));
  return out;
}

}  // namespace ostium::data
