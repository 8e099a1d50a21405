#include "app/predict_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "data/formats/write_file.h"
#include "data/identification/forward/prediction.h"
#include "data/identification/measurement/measurement_reader.h"

namespace ostium {

namespace {

void print_table(const std::vector<Prediction>& predictions) {
  fmt::print("{:<24} {:>10} {:>10} {:>10} {:>12}\n", "experiment", "tip x mm", "y", "z", "off by mm");
  double sum = 0;
  std::size_t compared = 0;
  for (const Prediction& p : predictions) {
    const Eigen::Vector3d tip = 1e3 * p.shape.points_m.back();
    fmt::print("{:<24} {:>10.3f} {:>10.3f} {:>10.3f} {:>12}\n", p.id, tip.x(), tip.y(), tip.z(),
               p.rms_to_measured_m ? fmt::format("{:.3f}", 1e3 * *p.rms_to_measured_m) : "-");
    if (!p.rms_to_measured_m) continue;
    sum += *p.rms_to_measured_m * *p.rms_to_measured_m;
    ++compared;
  }
  if (compared > 0)
    fmt::print("root mean square over {} experiments: {:.3f} mm\n", compared,
               1e3 * std::sqrt(sum / static_cast<double>(compared)));
  else
    fmt::print("the measuring frame or the tracked point is free: ostium explain fits them\n");
}

}  // namespace

int predict_command(const PredictOptions& options) {
  const MeasurementSet set = load_measurement(options.set);
  const bool progress = isatty(STDERR_FILENO);
  const auto predictions = predict(set, [&](std::size_t done, std::size_t of) {
    if (progress) fmt::print(stderr, "experiment {} of {}{}", done, of, done < of ? "\r" : "\r\033[K");
  });
  for (const Prediction& p : predictions)
    for (const double apart_m : p.other_branches_m)
      fmt::print(stderr, "ostium predict: {} has another stable shape, its tip {:.1f} mm away\n", p.id, 1e3 * apart_m);
  const std::filesystem::path folder(options.folder);
  write_file((folder / "prediction.json").string(), to_json(predictions));
  write_file((folder / "prediction.csv").string(), to_csv(predictions));
  if (options.json)
    fmt::print("{}", to_json(predictions));
  else
    print_table(predictions);
  return 0;
}

}  // namespace ostium
