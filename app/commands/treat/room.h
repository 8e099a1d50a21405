#pragma once
#include <nlohmann/json_fwd.hpp>

#include "app/angiography/device_scene.h"
#include "data/catalogue/case/case.h"
#include "fluoro/display/display.h"

namespace ostium::app {

struct TreatArguments {
  std::string of = "rca-mid-focal";   ///< case
  std::vector<std::string> set;       ///< which person
  double hold_s = 20;                 ///< of each inflation
  double pressure = 1, oversize = 1;  ///< factors on the usual pressure and diameter
  double shift_mm = 0;                ///< offset from the lesion, positive distally
  bool no_stent = false, no_predilatation = false, no_postdilatation = false, no_pictures = false, json = false;
  std::string view;
  int pixels = 512;
  std::uint64_t seed = 0;
  std::string renderer = "scanline";
  std::string out = "treat.png";
};

/// LAD, LCx or RCA.
std::string artery_of(const Plan& plan, const vascular::FlowTree& tree);

/// One patient being treated.
class TreatmentRoom {
 public:
  /// Keeps a reference to the arguments.
  TreatmentRoom(const data::Case& c, const TreatArguments& a);

  /// `words`: label of the moment. With contrast; or without, showing the wire.
  fluoro::Picture picture(const Plan& p, const std::string& words, bool with_contrast);
  /// The lesion's current numbers.
  nlohmann::ordered_json lesion(const Plan& p);

  const TreatArguments& arguments;
  std::vector<data::CaseView> views;  ///< of the case
  vascular::Patient patient;
  vascular::PhysiologyModel physiology;
  PatientScene scene;
  Treatable plan;
  Bedside bed;

 private:
  fluoro::View view_on(const Plan& p) const;
  /// A copy of the state with the coronary tree full of contrast.
  Bedside opacified(Angiogram& angiogram, bool left) const;
};

}  // namespace ostium::app
