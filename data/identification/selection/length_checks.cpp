#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "data/identification/selection/data_faults.h"

namespace ostium::data {

namespace {

using Eigen::Vector3d;
using units::mm;

/// Lengths of one shape agree to within slip and scale, which are effects; beyond that it is not the same length.
constexpr double unlike = 1.25, same_factor = 1.15;
constexpr int chords = 30;                                   // coarse enough that noise does not lengthen the line
constexpr double near_the_base = 0.05, off_the_base = 0.15;  // of what is inserted

struct LengthUnit {
  double mm_each;
  const char* name;
};
constexpr LengthUnit other_units[] = {{10, "cm"}, {25.4, "inches"}, {1000, "m"}};

double length_of(const std::vector<Vector3d>& points) {
  double whole = 0, sum = 0;
  for (std::size_t i = 1; i < points.size(); ++i) whole += (points[i] - points[i - 1]).norm();
  Vector3d last = points.front();
  for (const Vector3d& p : points)
    if ((p - last).norm() > whole / chords) sum += (p - last).norm(), last = p;
  return sum + (points.back() - last).norm();
}

bool alike(double a, double b) { return std::fabs(std::log(a / b)) < std::log(same_factor); }

std::string ids_in_words(const std::vector<std::string>& ids, std::size_t all) {
  if (ids.size() == all && all > 1) return "every experiment";
  std::string out;
  for (const std::string& id : ids) out += (out.empty() ? "" : ", ") + id;
  return out;
}

/// A fault that several experiments share is told once.
void add(std::vector<DataFault>& faults, const std::string& id, const std::string& mend, const std::string& told_by) {
  for (DataFault& f : faults)
    if (f.mend == mend) return f.experiments.push_back(id);
  faults.push_back({"unit_error", {id}, "", mend, told_by});
}

/// Mends the length that was written in another unit; false: no unit explains it.
bool mend_unit(Experiment& e, double ratio, std::vector<DataFault>& faults) {
  for (const LengthUnit& unit : other_units) {
    const std::string told = "the centreline's length and what is inserted differ by the factor between two units";
    if (alike(ratio, unit.mm_each)) {
      e.set.back().inserted_m *= unit.mm_each;
      add(faults, e.id, fmt::format("inserted_length_mm is in {}: times {:g}", unit.name, unit.mm_each), told);
      return true;
    }
    if (alike(ratio, 1 / unit.mm_each)) {
      for (Vector3d& p : e.points_m) p *= unit.mm_each;
      add(faults, e.id, fmt::format("centreline_mm is in {}: times {:g}", unit.name, unit.mm_each), told);
      return true;
    }
  }
  return false;
}

}  // namespace

std::optional<Mended> mend_lengths(const MeasurementSet& set, std::vector<std::string>& warnings) {
  Mended out{set, {}, false};
  bool turned = false;
  for (Experiment& e : out.set.experiments) {
    if (e.kind != Experiment::Kind::centreline) continue;
    const double ratio = length_of(e.points_m) / e.set.back().inserted_m;
    if ((ratio > unlike || ratio < 1 / unlike) && !mend_unit(e, ratio, out.faults))
      warnings.push_back(fmt::format("{}: its centreline is {:.4g} mm long where {:.4g} mm are inserted.", e.id,
                                     length_of(e.points_m) / mm, e.set.back().inserted_m / mm));
    if (set.imaging.registration_free) continue;
    const double inserted = e.set.back().inserted_m, first = (e.points_m.front() - e.base.p_W).norm(),
                 last = (e.points_m.back() - e.base.p_W).norm();
    if (last < near_the_base * inserted && first > 2 * last && first > near_the_base * inserted) {
      std::reverse(e.points_m.begin(), e.points_m.end());
      warnings.push_back(e.id + ": its centreline runs from the tip to the base; it was read the other way round.");
      turned = true;
    } else if (std::min(first, last) > off_the_base * inserted) {
      warnings.push_back(fmt::format("{}: its centreline begins {:.3g} mm from the base.", e.id, first / mm));
    }
  }
  for (DataFault& f : out.faults)
    f.what = "a length of " + ids_in_words(f.experiments, set.experiments.size()) + " is in another unit";
  if (out.faults.empty() && !turned) return {};
  return out;
}

}  // namespace ostium::data
