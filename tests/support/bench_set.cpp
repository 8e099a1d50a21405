#include "tests/support/bench_set.h"

#include "tests/support/bend_set.h"
#include "tests/support/push_set.h"
#include "tests/support/torque_set.h"

namespace ostium::synthetic {

const std::vector<BenchKind>& bench_kinds() {
  static const std::vector<BenchKind> list = {bend_kind(), torque_kind(), push_kind()};
  return list;
}

}  // namespace ostium::synthetic
