/// The tube's spectrum against a standard radiation quality, and the five energies against the sum in steps of 1 keV.
#include <algorithm>
#include <cmath>

#include "app/gates/gate.h"
#include "app/gates/xray/xray_water.h"

namespace ostium::app::gates {

namespace {

double signal_keV(const fluoro::Beam& beam, double soft_m, double bone_m, double iodine_kg_m2) {
  fluoro::PathLengths lengths(1);
  lengths.soft_m().setConstant(static_cast<float>(soft_m));
  lengths.bone_m().setConstant(static_cast<float>(bone_m));
  lengths.iodine_kg_m2().setConstant(static_cast<float>(iodine_kg_m2));
  fluoro::Primary primary;
  attenuate(beam, fluoro::Plane::Ones(1, 1), lengths, fluoro::ShaftLayer(1), primary);
  return double(primary.signal_keV(0, 0));
}

/// Aluminium that gives 70 kV a half-value layer of 2.58 mm: radiation quality RQR 5.
double filter_of_rqr5_mm() {
  double low = 0.5, high = 5;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (fluoro::half_value_layer_mm(fluoro::spectrum({70, middle, 0})) < 2.58 ? low : high) = middle;
  }
  return low;
}

}  // namespace

std::vector<data::GateResult> xray_spectrum(bool) {
  // Kramers' straight line has slightly too many soft photons: 4 % of a half-value layer is allowed for it, equivalent
  // to 3 kV. IEC 61267: RQR 5 behind 21 mm of aluminium is RQA 5, half-value layer 6.8 mm; the same tube at 80 kV is
  // RQR 6, 3.01. IEC 62220-1: RQA 5 has 30174 photons per mm2 and uGy.
  const double filter_mm = filter_of_rqr5_mm();
  const fluoro::Spectrum rqa5 = fluoro::spectrum({70, filter_mm + 21, 0});
  double kerma_Gy_m2 = 0;
  for (Eigen::Index i = 0; i < rqa5.photons.size(); ++i)
    kerma_Gy_m2 += rqa5.photons[i] / rqa5.photons.sum() * fluoro::air_kerma_Gy_m2(rqa5.energy_keV[i]);
  return {
      {"xray-spectrum-rqa5-hvl", half_value_layer_mm(rqa5), 6.8, 0.27, "mm"},
      {"xray-spectrum-rqr6-hvl", fluoro::half_value_layer_mm(fluoro::spectrum({80, filter_mm, 0})), 3.01, 0.15, "mm"},
      {"xray-spectrum-rqa5-photons", 1e-12 / kerma_Gy_m2, 30174, 900, "1/mm2/uGy"}};
}

std::vector<data::GateResult> xray_wedge(bool) {
  const fluoro::Detector detector;
  std::vector<data::GateResult> out;
  for (const fluoro::XrayTube& tube :
       {fluoro::XrayTube{70, 3, 0.1}, fluoro::XrayTube{80, 3, 0.4}, fluoro::XrayTube{110, 3, 0.4}}) {
    const fluoro::Beam beam = make_beam(tube, detector);
    double worst = 0;
    for (double soft_m = 0.10; soft_m < 0.351; soft_m += 0.025)
      for (double bone_m : {0.0, 0.01, 0.02, 0.04})
        for (double iodine_kg_m2 : {0.0, 0.3, 0.7, 1.05, 1.4}) {  // up to 4 mm of undiluted contrast
          const double exact = absorbed_by_keV(tube, detector, soft_m, bone_m, iodine_kg_m2).keV;
          worst = std::max(worst, std::fabs(signal_keV(beam, soft_m, bone_m, iodine_kg_m2) / exact - 1));
        }
    out.push_back({"xray-wedge-" + std::to_string(int(tube.peak_kV)) + "kV", 100 * worst, 0, 3, "%"});
  }
  return out;
}

}  // namespace ostium::app::gates
