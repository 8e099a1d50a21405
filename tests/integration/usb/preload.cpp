/// Bench 1 for an unmodified program: with LD_PRELOAD=libusb_bench.so:libumockdev-preload.so.0, COMMAND sees a box on
/// USB at which a hand moves a wire in strokes. OSTIUM_BENCH_FAULT: after two seconds the wire is lost (lost), the hand
/// stays at the end of the travel (full), or the cable is pulled (unplugged).
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "device/emulator/stroking_hand.h"
#include "tests/integration/usb/usbfs_bench.h"

namespace {

struct Plugged {
  std::string why_not;
  std::unique_ptr<ostium::test::Bench> bench = ostium::test::make_usbfs_bench(why_not);
  ostium::device::StrokingHand hand;

  Plugged() {
    if (!bench) {
      std::fprintf(stderr, "no bench: %s\n", why_not.c_str());
      return;
    }
    const char* asked = std::getenv("OSTIUM_BENCH_FAULT");
    const std::string fault = asked ? asked : "";
    bench->usb.set_hand([this, fault](ostium::device::EmulatedBox& box) {
      if (fault != "" && box.time_s() < 10) return;
      if (fault == "full" && box.station[1].advanced_mm > 318) return;
      if (fault != "" && fault != "full" && box.time_s() > 12) {
        if (fault == "lost") box.station[1].quality = 3;
        return;
      }
      hand.move(box);
    });
    bench->plug();
    if (fault == "unplugged")
      std::thread([this] {
        std::this_thread::sleep_for(std::chrono::seconds(12));
        bench->unplug();
      }).detach();
  }
};

__attribute__((constructor)) void plug() { static Plugged plugged; }

}  // namespace
