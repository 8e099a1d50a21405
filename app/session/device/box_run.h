#pragma once
/// The parts of a run with a tracking box.
#include <memory>

#include "app/session/device/box_driver.h"

namespace ostium::app {

class BoxRun {
 public:
  virtual ~BoxRun() = default;
  virtual Driver& driver() = 0;
  virtual const BoxDriver& hand() const = 0;
  virtual BoxDriver& hand() = 0;
  virtual bool real() const = 0;  ///< whether it must run in real time
};

/// A box on USB, moved by people; or at a script's speeds, if any of its steps are left (`free_hands`). Throws
/// std::runtime_error if USB cannot be used.
std::unique_ptr<BoxRun> run_at_usb(const std::string& serial, BoxDriverSettings settings,
                                   const std::atomic<bool>* stop);
/// An emulated box in this process, moved by a scripted hand: through the box's protocol and in its time, so the result
/// is reproducible.
std::unique_ptr<BoxRun> run_at_emulator(BoxDriverSettings settings, const std::atomic<bool>* stop);

}  // namespace ostium::app
