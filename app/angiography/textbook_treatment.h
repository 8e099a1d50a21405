#pragma once
/// Textbook treatment of a lesion, without instrument mechanics: devices are placed on the centreline where they should
/// be. Used to see what flow, balloon and stent do, and for their gates.
#include <functional>

#include "app/angiography/angiogram.h"
#include "vascular/treatment/treatment.h"

namespace ostium::app {

/// Device sizes and pressures, chosen as an operator would for the lesion.
struct Plan {
  vascular::Lesion lesion;
  int branch = -1;              ///< the devices lie along its path
  vascular::VesselPath path;    ///< the path of that branch
  double from_m = 0, to_m = 0;  ///< of the lesion, along the path
  double reference_m = 0;       ///< diameter: mean of 5 mm proximal and distal to it, as far as the branch goes
  double distal_m = 0, proximal_m = 0;
  int predilate = -1, stent = -1, postdilate = -1;  ///< indices of the model's balloons
  double predilate_Pa = 0, stent_Pa = 0, postdilate_Pa = 0;
  double middle_m = 0;  ///< middle of the devices, along the path
  /// In a tapering artery, a short balloon for the stent's proximal end (proximal optimisation); -1: not needed.
  int proximal = -1;
  double proximal_Pa = 0, proximal_middle_m = 0;
};

struct PlanOptions {
  bool stent = true, predilate = true, postdilate = true;
  double oversize = 1;  ///< factor on every device's diameter
  double pressure = 1;  ///< factor on every inflation pressure
  double shift_m = 0;   ///< offset of the devices from the lesion's middle
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
/// Recoil: each ring relative to its largest diameter under a balloon, averaged.
StentNumbers measure(const Plan& plan, const vascular::StentModel& model, const vascular::StentState& stent,
                     const vascular::PlaqueState& wall);

/// Record of one inflation.
struct InflationRecord {
  std::string device;
  double gauge_Pa = 0, pressure_Pa = 0;  ///< highest
  double diameter_m = 0;              ///< mean between the markers at that pressure, inside the stent if there is one
  double largest_over_reference = 0;  ///< balloon-artery ratio
  double waist_at_4_atm = 1, waist_gave_Pa = 0;  ///< waist_gave_Pa: pressure at which the waist was gone
  double slip_m = 0, deflated_s = 0;             ///< deflated_s: time under vacuum until a tenth of the volume is left
  double ST_mV = 0;                              ///< largest ST shift
  bool burst = false;
};

/// The running treatment: everything that changes.
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
  std::function<void(const Bedside&)> each_step;  ///< for recording strips; may be empty

  vascular::TreatmentReport step(double dt_s = 1e-3);
};

/// Inflates at 2 atm/s, holds, applies vacuum, waits until the balloon is empty; the balloon lies where the plan says.
InflationRecord inflate(Bedside& bed, const Plan& plan, int balloon, double gauge_Pa, double hold_s);
/// One of the plan's inflations, in order.
struct PlannedInflation {
  int balloon;
  double gauge_Pa;
};
std::vector<PlannedInflation> inflations_of(const Plan& plan);
/// Runs the whole plan, from predilatation to postdilatation; ties stents to the wall if `shape` and the like are
/// given.
std::vector<InflationRecord> treat(Bedside& bed, const Plan& plan, double hold_s = 15);

}  // namespace ostium::app
