#include "app/session/device/box_run.h"

#include <chrono>
#include <thread>

#include "app/session/device/emulated_box_driver.h"
#include "device/emulator/emulated_port.h"
#include "device/host/box_thread.h"
#include "device/transport/usb_port.h"

namespace ostium::app {

namespace {

class UsbRun : public BoxRun {
 public:
  UsbRun(const std::string& serial, BoxDriverSettings settings, const std::atomic<bool>* stop)
      : thread_(std::make_unique<device::UsbPort>(serial), {}),
        hand_(
            std::move(settings),
            [this](const device::BoxRequest& request) -> const device::BoxSnapshot& {
              thread_.ask(request);
              const device::BoxSnapshot& now = thread_.newest();
              if (now.pause != device::Pause::none) std::this_thread::sleep_for(std::chrono::milliseconds(1));
              return now;
            },
            stop) {}
  Driver& driver() override { return hand_; }
  const BoxDriver& hand() const override { return hand_; }
  BoxDriver& hand() override { return hand_; }
  bool real() const override { return true; }

 private:
  device::BoxThread thread_;
  BoxDriver hand_;
};

class EmulatedRun : public BoxRun {
 public:
  EmulatedRun(BoxDriverSettings settings, const std::atomic<bool>* stop)
      : port_(box_, [this](device::EmulatedBox& box) { fingers_.move(box); }),
        host_(port_, {}),
        hand_(
            std::move(settings),
            [this](const device::BoxRequest& request) -> const device::BoxSnapshot& {
              const std::uint64_t before = host_.now().reports;
              while (host_.now().reports == before) host_.poll(0, request);
              fingers_.see(host_.now());
              return host_.now();
            },
            stop),
        operator_(hand_, fingers_) {}
  Driver& driver() override { return operator_; }
  const BoxDriver& hand() const override { return hand_; }
  BoxDriver& hand() override { return hand_; }
  bool real() const override { return false; }

 private:
  static device::Calibration calibration() {
    device::Calibration c;
    c.serial = device::emulated_serial;
    return c;
  }
  device::EmulatedBox box_{calibration()};
  EmulatedBoxDriver fingers_;
  device::EmulatedPort port_;
  device::TrackingBox host_;
  BoxDriver hand_;
  EmulatedOperator operator_;
};

}  // namespace

std::unique_ptr<BoxRun> run_at_usb(const std::string& serial, BoxDriverSettings settings,
                                   const std::atomic<bool>* stop) {
  return std::make_unique<UsbRun>(serial, std::move(settings), stop);
}

std::unique_ptr<BoxRun> run_at_emulator(BoxDriverSettings settings, const std::atomic<bool>* stop) {
  return std::make_unique<EmulatedRun>(std::move(settings), stop);
}

}  // namespace ostium::app
