#pragma once
/// Faults of the data: what was written in another unit, exchanged, or handled wrongly once. A physical effect moves
/// every experiment that it acts on; a fault sits in one or two, and what mends it has no number to fit.
#include <functional>
#include <optional>

#include "data/identification/estimation/fitted_model.h"
#include "data/identification/parallel/workers.h"
#include "data/identification/selection/data_fault.h"

namespace ostium::data {

/// The set without its faults.
struct Mended {
  MeasurementSet set;
  std::vector<DataFault> faults;
  bool left_out = false;  ///< nothing mends it: the experiment was left out
};

/// Compares the length of each centreline with what is inserted, and its first point with the base. A length that is
/// off by the factor between two units is a fault; `warnings` gets what looks wrong and cannot be mended, or was
/// harmless.
std::optional<Mended> mend_lengths(const MeasurementSet& set, std::vector<std::string>& warnings);

/// Looks for one experiment without which most of what is beyond noise is gone, and for what mends it: a unit, or the
/// measurement of another. `declared`: fitted and judged by `noise`, whose sigma is known.
std::optional<Mended> find_fault(const MeasurementSet& set, const Workers& workers, const FittedModel& declared,
                                 const Noise& noise, const std::function<void(const std::string&)>& progress);

}  // namespace ostium::data
