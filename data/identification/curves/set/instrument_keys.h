#pragma once
/// The instrument of kinds that bend, turn or push one: its keys, and how they are read.
#include "data/formats/json/json_object.h"

namespace ostium::data::curves {

/// What a kind has to know of it.
struct InstrumentNeeds {
  bool length = false;   ///< from the tip to where it is held, and sections as far as that
  bool no_gaps = false;  ///< sections from the tip on, each from where the one before it ends
  bool torsion = false;  ///< torsional stiffness
};

struct InstrumentSection {
  double from_tip_m = 0, to_m = 0, EI_N_m2 = 0;
  double GJ_N_m2 = 0;  ///< 0: not given
};

struct Instrument {
  double radius_m = 0;
  double length_m = 0;  ///< 0: not given
  std::vector<InstrumentSection> sections;
};

/// The keys lie beside a kind's others: readers keep references to them.
class InstrumentKeys {
 public:
  explicit InstrumentKeys(const InstrumentNeeds& needs);
  JsonKey in_set() const;  ///< "instruments", a list of one
  std::vector<const JsonObjectKeys*> with(std::vector<const JsonObjectKeys*> others) const;  ///< for a kind's schema

  /// Of a set's "instruments". Throws LoadError.
  Instrument read(const JsonObject& set) const;

 private:
  InstrumentNeeds needs_;
  JsonObjectKeys instrument_, section_;
};

}  // namespace ostium::data::curves
