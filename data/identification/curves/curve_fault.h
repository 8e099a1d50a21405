#pragma once
/// Mistakes in the data themselves: one run or all in another unit, columns of the other sign, two runs that changed
/// places, samples out of order, a run that went wrong. Each is tried by mending it in the file's values and reading
/// them again, so that it needs to know nothing of the kind.
#include "data/identification/curves/set/curve_kind.h"

namespace ostium::data::curves {

struct Fault {
  std::string id;  ///< "unit_error", "sign_error", "swapped_experiments", "shuffled_time", "outlier_experiment"
  std::vector<std::string> runs;
  std::string what;                       ///< "force_N of b3 is in gram-force"
  std::string mend;                       ///< "multiply by 0.00981"
  std::shared_ptr<const Set> set;         ///< mended
  std::shared_ptr<const JsonValue> root;  ///< the file, mended; null: nothing in it is changed
  double paid = 0;                        ///< in BIC, beside what any choice among faults costs
  std::vector<std::vector<bool>> chosen;  ///< which channels of which runs still count; empty: all
};

/// One run left out at a time.
std::vector<Fault> left_out(const std::shared_ptr<const Set>& set);

/// Mends of run `r` that the file's keys allow: each number in another unit, exchanged with another run, in order of
/// time. Only those that can be read.
std::vector<Fault> mends_of(const JsonValue& root, std::size_t r);

/// Mends of a column of all runs alike: in another unit, or, as pushing and turning have a sign by convention only, of
/// the other sign; also of two columns.
std::vector<Fault> mends_of_all(const JsonValue& root);

}  // namespace ostium::data::curves
