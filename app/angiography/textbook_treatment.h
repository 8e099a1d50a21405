#pragma once
/// A lesion treated by the book, without instruments' mechanics: devices lie on the centreline where they should. For
/// looking at what flow, balloon and stent do, and for their gates.
#include <functional>

#include "app/angiography/angiogram.h"
#include "vascular/treatment/treatment.h"

namespace ostium::app {

/// Sizes and pressures as an operator chooses them for a lesion.
struct Plan {
  vascular::Lesion lesion;
  int branch = -1;              ///< along whose path the devices lie
  vascular::VesselPath path;    ///< that path
  double from_m = 0, to_m = 0;  ///< of the lesion, along the path
  double reference_m = 0;       ///< diameter: mean of 5 mm ahead of it and behind it, as far as the branch goes
  double distal_m = 0, proximal_m = 0;
  int predilate = -1, stent = -1, postdilate = -1;  ///< balloons of the model
  double predilate_Pa = 0, stent_Pa = 0, postdilate_Pa = 0;
  double middle_m = 0;  ///< of the devices
  /// Where the artery tapers, a short balloon for the stent's proximal end (proximal optimisation); -1: it need not.
  int proximal = -1;
  double proximal_Pa = 0, proximal_middle_m = 0;
};

struct PlanOptions {
  bool stent = true, predilate = true, postdilate = true;
  double oversize = 1;  ///< of every device, in diameter
  double pressure = 1;  ///< of every inflation
  double shift_m = 0;   ///< how far beside the lesion's middle the devices lie
};

struct Treatable {
  vascular::TreatmentModel model;
  std::vector<Plan> plans;
};
Treatable plan_treatment(const vascular::Patient& patient, const vascular::FlowModel& flow, std::uint64_t seed,
                         const PlanOptions& options = {});

struct LesionNumbers {
  double mld_mm = 0, reference_mm = 0, stenosis_percent = 0, ffr = 0;
};
LesionNumbers measure(const Plan& plan, const vascular::FlowModel& flow, const vascular::PlaqueState& wall);

struct StentNumbers {
  double minimal_diameter_mm = 0, minimal_area_mm2 = 0, expansion_percent = 0, apposed_percent = 0, worst_gap_mm = 0,
         recoil_percent = 0, foreshortening_percent = 0, length_mm = 0, margin_proximal_mm = 0, margin_distal_mm = 0,
         coverage_percent = 0;
};
/// Recoil: of each ring from the widest that a balloon made it, mean.
StentNumbers measure(const Plan& plan, const vascular::StentModel& model, const vascular::StentState& stent,
                     const vascular::PlaqueState& wall);

/// What is kept of an inflation.
struct InflationRecord {
  std::string device;
  double gauge_Pa = 0, pressure_Pa = 0;  ///< highest
  double diameter_m = 0;              ///< mean between the markers, inside the stent if there is one, at that pressure
  double largest_over_reference = 0;  ///< balloon-artery ratio
  double waist_at_4_atm = 1, waist_gave_Pa = 0;  ///< pressure at which it was gone
  double slip_m = 0, deflated_s = 0;             ///< time under vacuum until a tenth of the volume is left
  double ST_mV = 0;                              ///< largest shift
  bool burst = false;
};

/// The whole as it runs.
struct Bedside {
  const vascular::PhysiologyModel& physiology;
  const vascular::TreatmentModel& treatment;
  vascular::PhysiologyState blood;
  vascular::TreatmentState state;
  vascular::PhysiologyInputs inputs;
  vascular::TreatmentInputs device;
  vascular::PhysiologyScratch blood_scratch;
  vascular::TreatmentScratch scratch;
  std::vector<double> shaft_m;
  std::function<void(const Bedside&)> each_step;  ///< for strips; may be empty

  vascular::TreatmentReport step(double dt_s = 1e-3);
};

/// Pumps up at 2 atm/s, holds, draws vacuum, waits until it is empty; the balloon lies where the plan has it.
InflationRecord inflate(Bedside& bed, const Plan& plan, int balloon, double gauge_Pa, double hold_s);
/// What the plan inflates, in its order.
struct PlannedInflation {
  int balloon;
  double gauge_Pa;
};
std::vector<PlannedInflation> inflations_of(const Plan& plan);
/// Everything that the plan says, from predilatation to postdilatation; ties stents where `shape` and so on are given.
std::vector<InflationRecord> treat(Bedside& bed, const Plan& plan, double hold_s = 15);

}  // namespace ostium::app
