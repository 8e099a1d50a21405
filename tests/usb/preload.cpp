/// Bench 1 for a program that knows nothing of it: LD_PRELOAD=libusb_bench.so:libumockdev-preload.so.0 COMMAND sees a
/// box on USB, at which a hand moves a wire in strokes.
#include <cstdio>

#include "device/stroking_hand.h"
#include "tests/usb/usbfs_bench.h"

namespace {

struct Plugged {
  std::string why_not;
  std::unique_ptr<ostium::Bench> bench = ostium::make_usbfs_bench(why_not);
  ostium::StrokingHand hand;

  Plugged() {
    if (!bench) {
      std::fprintf(stderr, "no bench: %s\n", why_not.c_str());
      return;
    }
    bench->usb.hand = [this](ostium::EmulatedBox& box) { hand.move(box); };
    bench->plug();
  }
};

__attribute__((constructor)) void plug() { static Plugged plugged; }

}  // namespace
