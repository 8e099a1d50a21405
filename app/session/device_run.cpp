#include "app/session/device_run.h"

#include <chrono>
#include <thread>

#include "app/session/emulated_hand.h"
#include "device/box_thread.h"
#include "device/emulated_port.h"
#include "device/usb_port.h"

namespace ostium {

namespace {

class UsbRun : public DeviceRun {
 public:
  UsbRun(const std::string& serial, DeviceHandSettings settings, const std::atomic<bool>* stop)
      : thread_(std::make_unique<UsbPort>(serial), {}),
        hand_(
            std::move(settings),
            [this](const BoxRequest& request) -> const BoxSnapshot& {
              thread_.ask(request);
              const BoxSnapshot& now = thread_.newest();
              if (now.pause != Pause::none) std::this_thread::sleep_for(std::chrono::milliseconds(1));
              return now;
            },
            stop) {}
  Driver& driver() override { return hand_; }
  const DeviceHand& hand() const override { return hand_; }
  DeviceHand& hand() override { return hand_; }
  bool real() const override { return true; }

 private:
  BoxThread thread_;
  DeviceHand hand_;
};

class EmulatedRun : public DeviceRun {
 public:
  EmulatedRun(DeviceHandSettings settings, const std::atomic<bool>* stop)
      : port_(box_, [this](EmulatedBox& box) { fingers_.move(box); }),
        host_(port_, {}),
        hand_(
            std::move(settings),
            [this](const BoxRequest& request) -> const BoxSnapshot& {
              const std::uint64_t before = host_.now().reports;
              while (host_.now().reports == before) host_.poll(0, request);
              fingers_.see(host_.now());
              return host_.now();
            },
            stop),
        operator_(hand_, fingers_) {}
  Driver& driver() override { return operator_; }
  const DeviceHand& hand() const override { return hand_; }
  DeviceHand& hand() override { return hand_; }
  bool real() const override { return false; }

 private:
  static Calibration calibration() {
    Calibration c;
    c.serial = "EMULATED";
    return c;
  }
  EmulatedBox box_{calibration()};
  EmulatedHand fingers_;
  EmulatedPort port_;
  TrackingBox host_;
  DeviceHand hand_;
  EmulatedOperator operator_;
};

}  // namespace

std::unique_ptr<DeviceRun> run_at_usb(const std::string& serial, DeviceHandSettings settings,
                                      const std::atomic<bool>* stop) {
  return std::make_unique<UsbRun>(serial, std::move(settings), stop);
}

std::unique_ptr<DeviceRun> run_at_emulator(DeviceHandSettings settings, const std::atomic<bool>* stop) {
  return std::make_unique<EmulatedRun>(std::move(settings), stop);
}

}  // namespace ostium
