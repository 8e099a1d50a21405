#pragma once
/// Diameter of a balloon against its pressure: free, in a bare vessel, or with a stent around it.
///
/// Law. A free balloon has the diameter B(p) of its chart (monotone cubic between its rows, Fritsch, Butland 1984, SIAM
/// J Sci Stat Comput 5:300; straight beyond). In a vessel the wall bears a part of the pressure:
///   d = B(p - w(d)),   w(d) = E (d - rest) / healthy + p_m (exp(k ((d / healthy)^2 - 1)) - 1) for d > rest,
/// the exponential beyond the healthy diameter only (media and adventitia), as the wall of
/// `vascular/treatment/plaque.h` before it yields. A stent keeps the largest diameter that it was given when the
/// pressure falls.
#include "data/identification/curves/set/set_reader.h"

namespace ostium::data::pressure_diameter {

/// Pressure to diameter, rising.
class Chart {
 public:
  Chart() = default;
  Chart(std::vector<double> pressure_Pa, std::vector<double> diameter_m);
  double operator()(double pressure_Pa) const;
  double slope(double pressure_Pa) const;
  double least_Pa() const { return least_; }
  double most_Pa() const { return most_; }

 private:
  std::function<double(double)> inside_, prime_;
  double least_ = 0, most_ = 0, at_least_ = 0, at_most_ = 0, slope_least_ = 0, slope_most_ = 0;
};

struct Vessel {
  std::string name;
  double rest_m = 0, healthy_m = 0;
  double stiffness_Pa = 0;                       ///< E
  double media_Pa = 0.05 * 101325, media_k = 5;  ///< p_m, k
};

/// One inflation.
struct Inflation {
  Eigen::VectorXd time_s, pressure_Pa;
  int vessel = -1;  ///< -1: free
  bool stented = false;
};

/// Everything that an effect may change.
struct Setup {
  Chart chart;
  std::vector<Vessel> vessels;
  std::vector<Inflation> inflations;
  std::vector<double> place_m;  ///< where diameters are measured, along the balloon from its middle
  double chart_scale = 1;       ///< of its diameters
  double chart_more_m = 0;      ///< added to them
  double gauge_Pa = 0;          ///< true pressure minus that shown
  double counter_Pa = 0;        ///< by which a vessel presses more than declared wherever it is touched
  double recoil = 0;            ///< share of a stent's diameter that comes back
  double taper = 0;             ///< diameter per length along the balloon
  double creep_per_Pa_s = 0;    ///< relative growth of the balloon
};

curves::Kind kind();

/// Diameters of each inflation, mm, a curve for each place.
std::vector<curves::Curves> diameters(const Setup& setup);

/// Each states its law in its source file.
using Effect = curves::EffectOn<Setup>;
Effect counter_pressure();
Effect recoil();
Effect chart_offset();
Effect taper();
Effect gauge_offset();
Effect creep();

}  // namespace ostium::data::pressure_diameter
