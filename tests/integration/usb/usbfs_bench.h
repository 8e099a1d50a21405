#pragma once
#include "tests/integration/usb/bench.h"

namespace ostium::test {

std::unique_ptr<Bench> make_usbfs_bench(std::string& why_not);
void prepare_usbfs_bench(char** arguments);

}  // namespace ostium::test
