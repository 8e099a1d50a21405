/// `ostium` without a subcommand.
#include <fmt/format.h>

#include "app/command_line/command.h"
#include "app/commands/run/run.h"
#include "app/window/window.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::string folder = "ostium-run";
};

void declare(Options& options, Arguments& a) {
  options.add("--out", a.folder, "Without a subcommand: an angioplasty by script goes into this folder")
      .type("DIR")
      .show_default();
}

/// An angioplasty from start to end, with all outputs.
int run(const Arguments& arguments) {
  const std::string& folder = arguments.folder;
  RunArguments a;
  a.session.vessel = "rca-mid-focal", a.session.script = "pci-rca-mid-focal";
  a.folder = folder, a.film = a.report = true;
  std::string why;
  if (has_display(why)) a.display = "window";
  fmt::print(
      stderr,
      "A right coronary angioplasty by script, from the groin to the last film{}. What comes of it goes to {}.\n",
      why.empty() ? "" : ", without a window (" + why + ")", folder);
  const int code = run_script(a);
  fmt::print(
      "\n{0}/report.html: what happened; procedure.mp4, key-frames/, run.h5, metrics.json, events.csv beside it\n"
      "Yourself: ostium run rca-mid-focal --script pci-rca-mid-focal --device keyboard --out mine\n"
      "More: ostium --help\n",
      folder);
  return code;
}

}  // namespace

Command demonstration() {
  return make_command("ostium",
                      "Ostium: an endovascular simulator. Training and research, not for decisions on a patient.", {},
                      declare, run);
}

}  // namespace ostium::app
