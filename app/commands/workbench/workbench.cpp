#include "app/serve/workbench/workbench.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "app/command_line/command.h"
#include "app/command_line/interrupt.h"
#include "app/command_line/links.h"
#include "app/command_line/passing_folder.h"
#include "app/command_line/progress.h"
#include "app/commands/import/imported.h"
#include "app/commands/workbench/case_folder.h"
#include "app/commands/workbench/session_beside.h"
#include "data/formats/load_error.h"
#include "data/formats/paths.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::string of;
  int port = 0;
  std::string address = "127.0.0.1";
};

void declare(Options& options, Arguments& a) {
  options.add("case", a.of, "A case (`ostium cases`), its file or folder").type("CASE").required();
  options.add("--port", a.port, "0: any that is free").range(0, 65535).show_default();
  options.add("--address", a.address, "Where it listens; anything but 127.0.0.1 lets others in")
      .type("IP")
      .show_default();
}

/// Beside the imported cases, under the first name that is free. The case's file.
std::string keep_unsaved(data::CaseDraft draft) {
  const std::string own = draft.now().name + "-unsaved";
  for (int i = 1;; ++i)
    if (const std::string name = i == 1 ? own : fmt::format("{}-{}", own, i);
        !data::is_there(std::filesystem::path(data::imported_folder()) / name)) {
      save_as(draft, name);
      return draft.file();
    }
}

/// The angioplasty whose instruments suit the first lesion's artery; without one, or an aorta, a wire.
std::string script_for(const data::Case& c) {
  const vascular::Anatomy anatomy = anatomy_of(c);
  if (c.lesions.empty() || !find_branch(anatomy, "aorta")) return "aorta-arch-wire";
  const std::string access = !c.imported && c.anatomy.access == vascular::Access::radial ? "-radial" : "";
  for (int tube = find_branch(anatomy, c.lesions.front().branch)->tube; tube >= 0;
       tube = anatomy.tubes[static_cast<std::size_t>(tube)].parent)
    for (const vascular::NamedBranch& branch : anatomy.branches) {
      if (branch.tube != tube) continue;
      if (branch.name == "RCA") return "pci-rca-mid-focal" + access;
      if (branch.name == "LCx") return "pci-lcx-tubular" + access;
      if (branch.name == "LAD") return "pci-lad-proximal-eccentric" + access;
    }
  return "aorta-arch-wire";
}

/// From the page no path reaches the disk.
void require_name(const std::string& name) {
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_'; };
  if (name.empty() || name.size() > 60 || !std::ranges::all_of(name, fits))
    throw data::LoadError(
        fmt::format("\"{}\" is no name of a case; expected at most 60 letters, digits, - and _", name.substr(0, 80)));
}

int run(const Arguments& a) {
  stop_on_signals();
  show_progress("reading " + a.of);
  data::CaseDraft draft(a.of);
  auto read_at = written_at(draft.file());
  const PassingFolder passing("workbench");
  std::optional<SessionBeside> session;
  int sessions = 0;
  const WorkbenchOwner owner = {
      .save =
          [&](data::CaseDraft& of) {
            save(of, read_at);
            read_at = written_at(of.file());
          },
      .save_as =
          [&](data::CaseDraft& of, const std::string& name) {
            require_name(name);
            save_as(of, name);
            read_at = written_at(of.file());
          },
      .try_it =
          [&](const data::CaseDraft& of) {
            session.reset();
            const std::string number = std::to_string(++sessions);
            return session.emplace(copy_into(of, std::filesystem::path(passing.path()) / number), script_for(of.now()))
                .link();
          },
      .mends = mends_beside};
  Workbench workbench(std::move(draft), owner, a.address, static_cast<std::uint16_t>(a.port));
  show_progress("");
  tell_links("editor", workbench.link(), workbench.viewer_link(), !is_loopback(a.address));
  if (!workbench.work(interrupted)) return 0;
  const std::string kept = keep_unsaved(workbench.draft());
  fmt::print(stderr, "{}: what had been changed and not saved\n", kept);
  return 0;
}

}  // namespace

Command workbench_command() {
  return make_command("workbench", "A case in the browser: names, entry, lesions, views and courses, edited and tried",
                      {"ostium workbench anna", "ostium workbench rca-mid-focal --port 8100"}, declare, run);
}

}  // namespace ostium::app
