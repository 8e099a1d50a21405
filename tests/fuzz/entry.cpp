/// libFuzzer's entry, one program a target: OSTIUM_FUZZ_TARGET is its name.
#include <cstdint>

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace ostium::fuzz;
  static const Target target = [] {
    for (const Target& one : targets())
      if (one.name == OSTIUM_FUZZ_TARGET) return one;
    throw Finding("there is no target " OSTIUM_FUZZ_TARGET);
  }();
  static const std::string name = target.seeds().front().name;
  target.read({name, {reinterpret_cast<const char*>(bytes), size}});
  return 0;
}
