#include "data/identification/curves/curve_explanation.h"

#include "data/identification/curves/curve_search.h"
#include "data/identification/curves/curve_verdict.h"
#include "data/identification/curves/kinds.h"
#include "data/identification/curves/set/run_table.h"

namespace ostium::data::curves {

CurveExplanation explain_curves(const JsonValue& root, const CurveOptions& options) {
  CurveExplanation out;
  out.set = read_set(root);
  out.warnings = doubts_of_tables(root);
  Search(out.set, root, options).run(out);
  decide(out);
  return out;
}

}  // namespace ostium::data::curves
