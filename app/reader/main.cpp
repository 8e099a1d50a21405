/// `ostium-reader`: reads one file for `ostium` within limits (read_apart.h). Exit codes: 0 read, and a mesh or its
/// axes are on stdout; 2 usage; 3 refused, and the reason is on stdout.
#include <sys/prctl.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "app/reader/read_apart.h"
#include "app/reader/surface_bytes.h"
#include "data/formats/decimal.h"
#include "data/recording/recording.h"
#include "vascular/geometry/mesh_files/unit_mark.h"

namespace {

void limit(int resource, rlim_t most, rlim_t hard) {
  const rlimit both{most, hard};
  setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

void limit_us(rlim_t seconds) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);         // ends with whoever asked
  limit(RLIMIT_CPU, seconds, seconds + 1);  // SIGXCPU comes before SIGKILL
  limit(RLIMIT_CORE, 0, 0);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // which take terabytes of addresses
  limit(RLIMIT_AS, ostium::app::ReaderLimits::bytes, ostium::app::ReaderLimits::bytes);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  using namespace ostium;
  const std::string kind = argc == 4 ? argv[1] : "";
  const auto seconds = data::whole(argc == 4 ? argv[2] : "");
  if ((kind != "mesh" && kind != "axes" && kind != "recording") || !seconds) {
    std::fputs("usage: ostium-reader mesh|axes|recording SECONDS FILE, as ostium calls it\n", stderr);
    return 2;
  }
  limit_us(*seconds);
  try {
    if (kind == "recording")
      data::read_to_end(argv[3]);
    else if (kind == "axes")
      std::fputs(vascular::axes_mark_of(argv[3]).value_or("").c_str(), stdout);
    else if (!app::write_surface(vascular::read_surface(argv[3]), stdout))
      return 1;
    return 0;
  } catch (const std::exception& error) {
    std::fputs(error.what(), stdout);
    return 3;
  }
}
