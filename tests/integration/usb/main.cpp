#include <gtest/gtest.h>

#include "tests/integration/usb/bench.h"

namespace ostium::test {

namespace {
std::unique_ptr<Bench> made;
}

Bench& bench() { return *made; }

}  // namespace ostium::test

int main(int count, char** arguments) {
  ostium::test::prepare_bench(arguments);
  testing::InitGoogleTest(&count, arguments);
  std::string why_not;
  ostium::test::made = ostium::test::make_bench(why_not);
  if (!ostium::test::made) {
    std::fprintf(stderr, "skipped: %s\n", why_not.c_str());
    return 77;
  }
  std::fprintf(stderr, "%s\n", ostium::test::made->name().c_str());
  const int failed = RUN_ALL_TESTS();
  ostium::test::made.reset();
  return failed;
}
