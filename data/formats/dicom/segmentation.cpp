#include "data/formats/dicom/segmentation.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmfg/fgderimg.h>
#include <dcmtk/dcmfg/fgfracon.h>
#include <dcmtk/dcmfg/fgpixmsr.h>
#include <dcmtk/dcmfg/fgplanor.h>
#include <dcmtk/dcmfg/fgplanpo.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "core/base/units.h"
#include "fluoro/console/fluoroscope.h"

// Where DCMTK is built without the standard library's, OFString is a string of its own.
// NOLINTBEGIN(readability-redundant-string-cstr)

namespace ostium::data {

namespace {

void require(const OFCondition& done, const char* what) {
  if (done.bad()) throw std::logic_error(fmt::format("DICOM segmentation: {}: {}", what, done.text()));
}

std::string unique() {
  char uid[100];
  return dcmGenerateUniqueIdentifier(uid, SITE_INSTANCE_UID_ROOT);
}

struct Film {
  std::string sop_class, instance, study, series;
  Uint16 rows = 0, columns = 0;
  Sint32 frames = 1;
  double lao_deg = 0, cran_deg = 0, pixel_mm = 0;  ///< pixel: in the plane of the isocentre
};

Film read_film(DcmDataset& film) {
  const auto text = [&](const DcmTagKey& tag) {
    OFString value;
    require(film.findAndGetOFString(tag, value), "the film");
    return std::string(value.c_str());
  };
  Film out{text(DCM_SOPClassUID), text(DCM_SOPInstanceUID), text(DCM_StudyInstanceUID), text(DCM_SeriesInstanceUID)};
  require(film.findAndGetUint16(DCM_Rows, out.rows), "the film");
  require(film.findAndGetUint16(DCM_Columns, out.columns), "the film");
  // A single frame has no number.
  if (film.findAndGetSint32(DCM_NumberOfFrames, out.frames).bad()) out.frames = 1;
  const auto number = [&](const DcmTagKey& tag) {
    Float64 value = 0;
    require(film.findAndGetFloat64(tag, value), "the film");
    return value;
  };
  out.lao_deg = number(DCM_PositionerPrimaryAngle), out.cran_deg = number(DCM_PositionerSecondaryAngle);
  out.pixel_mm = number(DCM_ImagerPixelSpacing) / number(DCM_EstimatedRadiographicMagnificationFactor);
  return out;
}

/// As much of a text in UTF-8 as a value of type LO or UT may hold.
OFString short_text(const std::string& text) {
  std::size_t end = std::min<std::size_t>(text.size(), 64);
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return {text.c_str(), end};
}

CodeSequenceMacro macro(const DicomCode& code) {
  return {code.value.c_str(), code.scheme.c_str(), code.meaning.c_str()};
}

/// A byte a pixel, row by row.
std::vector<Uint8> pixels_of(const SegmentedFrame& frame, const Film& film) {
  const std::size_t rows = film.rows, all = rows * film.columns;
  std::vector<Uint8> out(all);
  std::size_t at = 0;
  bool inside = false;
  for (const long length : frame.run_lengths) {
    if (length < 0 || static_cast<std::size_t>(length) > all - at) break;
    for (const std::size_t end = at + static_cast<std::size_t>(length); at < end; ++at)
      if (inside) out[at % rows * film.columns + at / rows] = 1;
    inside = !inside;
  }
  if (at != all) throw std::invalid_argument("DICOM segmentation: run lengths do not add up to the frame");
  return out;
}

/// Deletes what DCMTK made.
template <class Made, class Make>
std::unique_ptr<Made> made(const char* what, const Make& make) {
  Made* out = nullptr;
  require(make(out), what);
  if (!out) throw std::logic_error(std::string("DICOM segmentation: ") + what);
  return std::unique_ptr<Made>(out);
}

class SegmentationWriter {
 public:
  SegmentationWriter(const std::string& file, const std::string& film_file, const std::string& software) : out_(file) {
    OFLog::configure(OFLogger::OFF_LOG_LEVEL);  // what matters is thrown
    DcmFileFormat format;
    if (const OFCondition read = format.loadFile(film_file.c_str()); read.bad())
      throw write_error(file, film_file + ": " + read.text());
    film_ = read_film(*format.getDataset());
    const IODGeneralEquipmentModule::EquipmentInfo equipment("Ostium", "Ostium simulator: training and research", "0",
                                                             software.c_str());
    const ContentIdentificationMacro content("1", "TRUTH", "What is where in a simulated film", "Ostium^Simulator");
    segmentation_ = made<DcmSegmentation>("made", [&](DcmSegmentation*& out) {
      return DcmSegmentation::createBinarySegmentation(out, film_.rows, film_.columns, equipment, content);
    });
    require(segmentation_->importFromSourceImage(*format.getDataset()), "patient and study");
    // A film has no frame of reference. This one has its origin at the isocentre.
    require(segmentation_->getFrameOfReference().setFrameOfReferenceUID(unique().c_str()), "frame of reference");
    require(segmentation_->getSOPCommon().setSpecificCharacterSet("ISO_IR 192"), "characters");
    IODGeneralSeriesModule& series = segmentation_->getSeries();
    require(series.setSeriesNumber("1001"), "series");
    require(series.setSeriesDescription("Segmentation"), "series");
    require(series.setBodyPartExamined("HEART"), "series");
    require(series.setPatientPosition("HFS"), "series");
    IODReferences references;
    references.add(new IODImageReference("OSTIUM", film_.study.c_str(), film_.series.c_str(), film_.instance.c_str(),
                                         film_.sop_class.c_str()));
    segmentation_->getCommonInstanceReference().addReferences(references, film_.study.c_str());
    const OFString organisation = unique().c_str();
    IODMultiframeDimensionModule& dimensions = segmentation_->getDimensions();
    require(dimensions.addDimensionIndex(DCM_ReferencedSegmentNumber, organisation, DCM_SegmentIdentificationSequence,
                                         "segment"),
            "dimensions");
    require(dimensions.addDimensionIndex(DCM_FrameLabel, organisation, DCM_FrameContentSequence, "frame of the film"),
            "dimensions");
    add_plane();
  }

  void add(const DicomSegment& segment) {
    auto one = made<DcmSegment>("segment", [&](DcmSegment*& out) {
      return DcmSegment::create(out, "label", macro(segment.category), macro(segment.type), DcmSegTypes::SAT_AUTOMATIC,
                                "Ostium simulator");
    });
    require(one->setTrackingID("label"), "tracking");
    require(one->setTrackingUID(unique().c_str()), "tracking");
    Uint16 number = 0;
    require(segmentation_->addSegment(one.release(), number), "segment");
    segments_.push_back(segment);
  }

  void add(const SegmentedFrame& frame) {
    if (frame.frame < 1 || frame.frame > film_.frames || frame.segment < 1 ||
        static_cast<std::size_t>(frame.segment) > segmentation_->getNumberOfSegments())
      throw std::invalid_argument("DICOM segmentation: a frame or a segment that is not there");
    const auto image = made<ImageSOPInstanceReferenceMacro>("reference", [&](ImageSOPInstanceReferenceMacro*& out) {
      return ImageSOPInstanceReferenceMacro::create(film_.sop_class.c_str(), film_.instance.c_str(), out);
    });
    if (film_.frames > 1) require(image->addReferencedFrameNumber(static_cast<Uint16>(frame.frame)), "reference");
    const std::unique_ptr<FGDerivationImage> derived(
        DcmSegmentation::createDerivationImageFG(OFVector<ImageSOPInstanceReferenceMacro>(1, *image), "simulated"));
    if (!derived) throw std::logic_error("DICOM segmentation: reference");
    FGFrameContent content;
    require(content.setFrameLabel(fmt::format("frame {}", frame.frame).c_str()), "frame");
    require(content.setDimensionIndexValues(static_cast<Uint32>(frame.segment), 0), "frame");
    require(content.setDimensionIndexValues(static_cast<Uint32>(frame.frame), 1), "frame");
    OFVector<FGBase*> groups;
    groups.push_back(&content);
    groups.push_back(derived.get());
    std::vector<Uint8> pixels = pixels_of(frame, film_);
    require(segmentation_->addFrame(pixels.data(), static_cast<Uint16>(frame.segment), groups), "frame");
  }

  void save() {
    DcmFileFormat format;
    DcmDataset& dataset = *format.getDataset();
    require(segmentation_->writeDataset(dataset), "written");
    // Named only now, as DCMTK's segments refuse every letter beyond ASCII.
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      DcmItem* item = nullptr;
      require(dataset.findAndGetSequenceItem(DCM_SegmentSequence, item, static_cast<long>(i)), "label");
      require(item->putAndInsertOFStringArray(DCM_SegmentLabel, short_text(segments_[i].label)), "label");
      require(item->putAndInsertOFStringArray(DCM_TrackingID, short_text(segments_[i].tracking)), "label");
    }
    const OFCondition saved = format.saveFile(out_.beside().c_str(), EXS_LittleEndianExplicit);
    if (saved.bad()) throw write_error(out_.path(), saved.text());
    // DCMTK does not report a file cut short by a full disk; what was cut cannot be read.
    DcmFileFormat again;
    if (const OFCondition read = again.loadFile(out_.beside().c_str()); read.bad())
      throw write_error(out_.path(), "it was cut short");
    out_.finish();
  }

 private:
  /// Of a projection there is no plane; what stands for one goes through the isocentre, parallel to the detector.
  void add_plane() {
    fluoro::CArm arm;
    arm.lao_rad = film_.lao_deg * units::degree, arm.cran_rad = film_.cran_deg * units::degree;
    const fluoro::ImageAxes axes(arm);
    const auto in_LPS = [](const Eigen::Vector3d& p_P) { return Eigen::Vector3d(p_P.x(), -p_P.z(), p_P.y()); };
    const Eigen::Vector3d right = in_LPS(axes.right), down = in_LPS(-axes.up);
    const Eigen::Vector3d first_mm =
        -0.5 * film_.pixel_mm * ((film_.columns - 1) * right + (film_.rows - 1) * down);  // centre of the first pixel
    const auto text = [](double number) { return OFString(fmt::format("{:.6g}", number).c_str()); };
    const std::string spacing = fmt::format("{0:.6g}\\{0:.6g}", film_.pixel_mm);
    auto measures = std::make_unique<FGPixelMeasures>();
    require(measures->setPixelSpacing(spacing.c_str()), "plane");
    require(measures->setSliceThickness("1"), "plane");
    const std::unique_ptr<FGBase> groups[] = {
        std::move(measures),
        std::unique_ptr<FGBase>(FGPlaneOrientationPatient::createMinimal(
            text(right.x()), text(right.y()), text(right.z()), text(down.x()), text(down.y()), text(down.z()))),
        std::unique_ptr<FGBase>(
            FGPlanePosPatient::createMinimal(text(first_mm.x()), text(first_mm.y()), text(first_mm.z())))};
    for (const auto& group : groups) {
      if (!group) throw std::logic_error("DICOM segmentation: plane");
      require(segmentation_->addForAllFrames(*group), "plane");
    }
  }

  NewFile out_;
  Film film_;
  std::unique_ptr<DcmSegmentation> segmentation_;
  std::vector<DicomSegment> segments_;
};

}  // namespace

void write_segmentation(const std::string& file, const std::string& film, const std::string& software,
                        const std::vector<DicomSegment>& segments, const std::vector<SegmentedFrame>& frames) {
  SegmentationWriter out(file, film, software);
  for (const DicomSegment& segment : segments) out.add(segment);
  for (const SegmentedFrame& frame : frames) out.add(frame);
  out.save();
}

}  // namespace ostium::data

// NOLINTEND(readability-redundant-string-cstr)
