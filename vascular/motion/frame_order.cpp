#include "vascular/motion/frame_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "core/base/units.h"

namespace ostium::vascular {

namespace {

using units::mm;

/// How far the vertex that moves most goes from one frame to another; every so many are looked at.
double step_m(const Mesh& a, const Mesh& b) {
  const std::size_t stride = 1 + a.vertices.size() / 5000;
  double most = 0;
  for (std::size_t v = 0; v < a.vertices.size(); v += stride)
    most = std::max(most, (a.vertices[v] - b.vertices[v]).norm());
  return most;
}

/// From each frame to the next, and from the last to the first.
std::vector<double> steps_m(const std::vector<Mesh>& frames, const std::vector<std::size_t>& order) {
  std::vector<double> out;
  for (std::size_t i = 0; i < order.size(); ++i)
    out.push_back(step_m(frames[order[i]], frames[order[(i + 1) % order.size()]]));
  return out;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// Of numbered frames: out of order, or one left out.
void doubt_numbers(const std::vector<Mesh>& frames, const std::vector<std::string>& files, double travel_m,
                   std::vector<std::string>& out) {
  std::vector<long> numbers;
  for (const std::string& file : files) numbers.push_back(number_in_name(file));
  std::vector<std::size_t> by_number(files.size());
  std::iota(by_number.begin(), by_number.end(), 0);
  const auto lower = [&](std::size_t a, std::size_t b) { return numbers[a] < numbers[b]; };
  std::sort(by_number.begin(), by_number.end(), lower);
  if (numbers[by_number.front()] < 0) return;
  if (travel_m > 1.2 * sum(steps_m(frames, by_number))) {
    std::size_t at = 0;  // the first that is not followed by the next number
    while (at + 2 < files.size() && *std::upper_bound(by_number.begin(), by_number.end(), at, lower) == at + 1) ++at;
    out.push_back(
        fmt::format("the frames jump about, as {} follows {}: in the order of their numbers they would not; "
                    "expected the order of the beat, or their folder, whose frames are taken by number",
                    files[at + 1], files[at]));
    return;
  }
  std::vector<long> apart;
  for (std::size_t i = 1; i < by_number.size(); ++i) apart.push_back(numbers[by_number[i]] - numbers[by_number[i - 1]]);
  std::vector<long> sorted = apart;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const long usual = sorted[sorted.size() / 2];
  for (std::size_t i = 0; i < apart.size(); ++i)
    if (apart[i] > usual)
      out.push_back(
          fmt::format("between {} and {} a frame is missing, by their numbers: frames are taken as equally "
                      "long; expected all of the beat",
                      files[by_number[i]], files[by_number[i + 1]]));
}

}  // namespace

long number_in_name(const std::string& file) {
  const std::string stem = std::filesystem::path(file).stem().string();
  const std::size_t digits = stem.find_last_not_of("0123456789") + 1;
  return digits == stem.size() || stem.size() - digits > 9 ? -1 : std::stol(stem.substr(digits));
}

std::vector<std::string> doubts_of_frames(const std::vector<Mesh>& frames, const std::vector<std::string>& files) {
  std::vector<std::string> out;
  std::vector<std::size_t> as_given(frames.size());
  std::iota(as_given.begin(), as_given.end(), 0);
  const std::vector<double> steps = steps_m(frames, as_given);
  std::vector<double> largest = steps;
  std::sort(largest.rbegin(), largest.rend());
  if (frames.size() < 4 || largest[0] == 0)
    return {"the frames are all the same, so nothing beats; expected the surface at several moments of a beat"};
  doubt_numbers(frames, files, sum(steps), out);
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (steps[i] < 1e-4 * largest[0])
      out.push_back(fmt::format("{} and {} are the same frame; expected each moment once", files[i],
                                files[(i + 1) % files.size()]));
  // Of a beat in eight frames or more, the two longest steps are much alike.
  if (out.empty() && frames.size() >= 8 && largest[0] > 2 * largest[1]) {
    const std::size_t at = static_cast<std::size_t>(std::max_element(steps.begin(), steps.end()) - steps.begin());
    out.push_back(
        fmt::format("from {} to {}{} it moves by {:.1f} mm, and between no other two by more than {:.1f}: "
                    "expected the frames of one whole beat",
                    files[at], at + 1 == files.size() ? "the first, " : "", files[(at + 1) % files.size()],
                    largest[0] / mm, largest[1] / mm));
  }
  return out;
}

}  // namespace ostium::vascular
