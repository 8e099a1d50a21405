#pragma once
/// A run with a tracking box: what has to be put together for it.
#include <memory>

#include "app/session/device/box_driver.h"

namespace ostium::app {

class BoxRun {
 public:
  virtual ~BoxRun() = default;
  virtual Driver& driver() = 0;
  virtual const BoxDriver& hand() const = 0;
  virtual BoxDriver& hand() = 0;
  virtual bool real() const = 0;  ///< it has to be played at the clock's pace
};

/// A box on USB, and people; or a script's speeds, if it has any steps left (`free_hands`). Throws std::runtime_error
/// if USB cannot be used.
std::unique_ptr<BoxRun> run_at_usb(const std::string& serial, BoxDriverSettings settings,
                                   const std::atomic<bool>* stop);
/// An emulated box in this process, at which a scripted hand does what the script asks: through the box's bytes, in its
/// time, so that it is the same every time.
std::unique_ptr<BoxRun> run_at_emulator(BoxDriverSettings settings, const std::atomic<bool>* stop);

}  // namespace ostium::app
