#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "app/command_line/command.h"
#include "app/command_line/common_options.h"
#include "app/command_line/progress.h"
#include "data/formats/load_error.h"
#include "data/picture/frames_file.h"
#include "data/picture/likeness.h"

namespace ostium::app {

namespace {

using json = nlohmann::ordered_json;

struct Arguments {
  std::vector<std::string> files;
  std::string against;
  bool as_json = false;
};

void declare(Options& options, Arguments& a) {
  options.add("files", a.files, "Frames: PNG or DICOM (XA, RF), or folders of them").type("FILE|DIR").required();
  options.add("--against", a.against, "A folder of real frames, measured too").type("DIR");
  add_json_flag(options, a.as_json);
}

struct Measured {
  std::string name;
  data::Likeness numbers;
};

/// Frames that could be measured, with what was said about the files; trouble with one does not stop the others.
struct Pictures {
  std::vector<Measured> frames;
  std::vector<std::string> remarks;
  bool lacks_one = false;  ///< a file that was named, and not only lay in a folder, could not be measured

  data::Likeness medians() const {
    std::vector<data::Likeness> all;
    for (const Measured& m : frames) all.push_back(m.numbers);
    return data::median_of(all);
  }
};

void measure(const std::string& file, bool was_named, Pictures& out) {
  show_progress("measuring " + file);
  try {
    const data::FramesFile read = data::read_frames(file);
    for (const std::string& remark : read.remarks) out.remarks.push_back(file + ": " + remark);
    for (std::size_t i = 0; i < read.frames.size(); ++i)
      out.frames.push_back({read.frames.size() > 1 ? fmt::format("{} frame {}", file, i + 1) : file,
                            data::measure_likeness(read.frames[i])});
  } catch (const data::LoadError& error) {
    out.remarks.push_back(error.what());
    out.lacks_one |= was_named;
  }
}

Pictures measure_all(const std::vector<std::string>& files) {
  Pictures out;
  for (const std::string& given : files)
    for (const std::string& file : data::frame_files(given)) measure(file, file == given, out);
  show_progress("");
  for (const std::string& remark : out.remarks) fmt::print(stderr, "ostium picture: {}\n", remark);
  if (out.frames.empty()) throw data::LoadError(files.front() + ": no frame in it could be measured");
  return out;
}

json to_json(const data::Likeness& numbers) {
  json out = json::object();
  for (const data::PictureNumber& n : data::picture_numbers()) {
    const auto found = numbers.find(n.name);
    out[n.name] = found == numbers.end() ? json(nullptr) : json(found->second);
  }
  return out;
}

json to_json(const data::LikenessVerdict& verdict) {
  return {{"held", verdict.held}, {"ranges", verdict.ranges}, {"misses", verdict.misses}};
}

json to_json(const Pictures& pictures) {
  json frames = json::array();
  for (const Measured& m : pictures.frames)
    frames.push_back(
        {{"file", m.name}, {"verdict", to_json(data::judge_frame(m.numbers))}, {"numbers", to_json(m.numbers)}});
  return {
      {"frames", frames},
      {"set", {{"verdict", to_json(data::judge_set(pictures.medians()))}, {"numbers", to_json(pictures.medians())}}},
      {"remarks", pictures.remarks}};
}

std::string text(const data::Likeness& numbers, const std::string& name) {
  const auto found = numbers.find(name);
  return found == numbers.end() ? "none" : fmt::format("{:.3g}", found->second);
}

void print_frames(const Pictures& pictures) {
  for (const Measured& m : pictures.frames) {
    const data::LikenessVerdict verdict = data::judge_frame(m.numbers);
    std::string misses;
    for (const std::string& name : verdict.misses) misses += fmt::format(" {} {}", name, text(m.numbers, name));
    fmt::print("{:<40} {} of {}{}\n", m.name, verdict.held, verdict.ranges, misses.empty() ? "" : "; misses" + misses);
  }
}

void print_set(const Pictures& pictures, const Pictures* real) {
  const data::Likeness ours = pictures.medians(), theirs = real ? real->medians() : data::Likeness{};
  fmt::print("\n{:<22} {:>8} {:>8} {:<14} {:<5} {}\n", "median", real ? "real" : "", "here", "range of sets", "",
             "what it is");
  for (const data::PictureNumber& n : data::picture_numbers()) {
    const auto found = ours.find(n.name);
    const bool misses = n.of_set && (found == ours.end() || !n.of_set->holds(found->second));
    fmt::print("{:<22} {:>8} {:>8} {:<14} {:<5} {}\n", n.name, real ? text(theirs, n.name) : "", text(ours, n.name),
               n.of_set ? fmt::format("{:g} to {:g}", n.of_set->low, n.of_set->high) : "", misses ? "miss" : "",
               n.what);
  }
  const data::LikenessVerdict verdict = data::judge_set(ours);
  fmt::print("{} of {} numbers of the set are as in real ones\n", verdict.held, verdict.ranges);
}

/// A frame that is named twice would count twice, and frames are always as like themselves as can be.
void require_each_once(std::vector<std::string> given, const std::string& against) {
  if (!against.empty()) given.push_back(against);
  std::set<std::filesystem::path> seen;
  for (const std::string& name : given)
    for (const std::string& file : data::frame_files(name)) {
      std::error_code unseen;
      if (!seen.insert(std::filesystem::weakly_canonical(file, unseen)).second)
        throw data::LoadError(file + " is named twice; expected each frame once, here or in --against");
    }
}

int run(const Arguments& a) {
  require_each_once(a.files, a.against);
  std::optional<Pictures> real;
  if (!a.against.empty()) real = measure_all({a.against});
  const Pictures pictures = measure_all(a.files);
  constexpr int bad_input = 3;
  const int code = pictures.lacks_one || (real && real->lacks_one) ? bad_input : 0;
  if (a.as_json) {
    json out = to_json(pictures);
    if (real) out["against"] = to_json(*real);
    fmt::print("{}\n", out.dump(2));
    return code;
  }
  print_frames(pictures);
  print_set(pictures, real ? &*real : nullptr);
  return code;
}

}  // namespace

Command picture_command() {
  return make_command(
      "picture", "How like real angiograms frames are, in numbers",
      {"ostium picture frame.png", "ostium picture --against real-frames our-frames", "ostium picture run.dcm --json"},
      declare, run);
}

}  // namespace ostium::app
