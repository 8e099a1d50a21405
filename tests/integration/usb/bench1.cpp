#include "tests/integration/usb/usbfs_bench.h"

namespace ostium::test {

std::unique_ptr<Bench> make_bench(std::string& why_not) { return make_usbfs_bench(why_not); }
void prepare_bench(char** arguments) { prepare_usbfs_bench(arguments); }

}  // namespace ostium::test
