#include <gtest/gtest.h>

#include "tests/integration/usb/bench.h"

namespace ostium {

namespace {
std::unique_ptr<Bench> made;
}

Bench& bench() { return *made; }

}  // namespace ostium

int main(int count, char** arguments) {
  ostium::prepare_bench(arguments);
  testing::InitGoogleTest(&count, arguments);
  std::string why_not;
  ostium::made = ostium::make_bench(why_not);
  if (!ostium::made) {
    std::fprintf(stderr, "skipped: %s\n", why_not.c_str());
    return 77;
  }
  std::fprintf(stderr, "%s\n", ostium::made->name().c_str());
  const int failed = RUN_ALL_TESTS();
  ostium::made.reset();
  return failed;
}
