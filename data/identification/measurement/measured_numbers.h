#pragma once
/// The numbers that were measured, as they stand in a set's file: whether one measurement is there twice, and how
/// coarsely they were written.
#include <string>
#include <vector>

#include "data/identification/measurement/measurement_set.h"

namespace ostium::data {

/// Of one experiment or run.
struct MeasuredNumbers {
  std::string id;
  std::vector<double> numbers;  ///< in the file's unit
};

/// A radius has none: two are easily the same by chance.
std::vector<MeasuredNumbers> measured_numbers(const MeasurementSet& set);

/// For each measurement that is there again: "a and b are the same measurement, number for number: ...".
std::vector<std::string> copies_in_words(const std::vector<MeasuredNumbers>& list);

/// The power of ten that all numbers are multiples of; 0: there is none, or they are so few that it may be chance.
double written_to(const std::vector<MeasuredNumbers>& list);

/// Why the numbers cannot have noise as small as `sigma`, in their unit; empty: they can. What was rounded is off by
/// the rounding alone.
std::string doubt_of_noise_below_rounding(const std::vector<MeasuredNumbers>& list, double sigma,
                                          const std::string& unit);

}  // namespace ostium::data
