#include <fmt/format.h>

#include <ctime>
#include <optional>

#include "app/command_line/common_options.h"
#include "app/commands/device/calibration_measurement.h"
#include "app/commands/device/calibration_record.h"
#include "app/commands/device/device.h"
#include "data/formats/load_error.h"
#include "device/host/calibrating.h"

namespace ostium::app {

namespace {

struct Arguments {
  std::string serial;                         ///< of the box; empty: the first one found
  std::string write;                          ///< a JSON file with the record to write into the box
  int track = 0;                              ///< 1 to 4: the track to which length, turns, station and clamp apply
  std::optional<double> length_mm, turns;     ///< fed and turned by the user between the two readings
  std::optional<double> station_mm, clamp_N;  ///< measured by hand
  bool pressure_zero = false, flow_zero = false;
  std::optional<double> pressure_atm, volume_mL;
  double seconds = 0;    ///< of a measurement; 0: until Enter is pressed
  bool dry_run = false;  ///< do not write to the box

  bool of_a_track() const { return length_mm || turns || station_mm || clamp_N; }
  bool measures() const { return length_mm || turns || pressure_zero || pressure_atm || flow_zero || volume_mL; }
  bool changes() const { return of_a_track() || pressure_zero || pressure_atm || flow_zero || volume_mL; }
};

void declare(Options& options, Arguments& a) {
  add_box_serial_option(options, a.serial);
  options.add("--write", a.write, "Write this record, as this command prints one").type("FILE.json");
  options.add("--track", a.track, "That is measured").range(1, 4);
  options.add("--length", a.length_mm, "An instrument is pushed in by so many mm").range(1.0, 2000.0);
  options.add("--turns", a.turns, "An instrument is turned clockwise so many times").range(0.1, 1000.0);
  options.add("--station", a.station_mm, "How far the sensor lies outside the introducer, mm").range(0.0, 1000.0);
  options.add("--clamp", a.clamp_N, "What the closed clamp holds, N").range(0.01, 1000.0);
  options.flag("--pressure-zero", a.pressure_zero, "The indeflator is open to the air");
  options.add("--pressure", a.pressure_atm, "The indeflator's gauge shows so many atm").range(-1.0, 40.0);
  options.flag("--flow-zero", a.flow_zero, "The syringe rests");
  options.add("--volume", a.volume_mL, "So many mL are injected").range(0.1, 200.0);
  options.add("--seconds", a.seconds, "A measurement lasts so long; else until Enter").range(0.1, 600.0);
  options.flag("--dry-run", a.dry_run, "Write nothing into the box");
}

std::uint32_t today() {
  const std::time_t now = std::time(nullptr);
  std::tm day{};
  localtime_r(&now, &day);
  return static_cast<std::uint32_t>(10000 * (day.tm_year + 1900) + 100 * (day.tm_mon + 1) + day.tm_mday);
}

void measure(Measurement& at, const std::string& begin, const std::string& end, const Arguments& a) {
  if (a.seconds <= 0) at.wait(begin, 0);
  at.begin();
  at.wait(end, a.seconds);
}

void change_track(Measurement& at, const Arguments& a, device::Calibration& c) {
  const auto k = static_cast<std::size_t>(a.track - 1);
  if (a.length_mm) {
    measure(at, "Hold the instrument at a mark", fmt::format("Push it in by {:g} mm, without turning it", *a.length_mm),
            a);
    c.track[k] = with_length(c.track[k], at.insertion(k), *a.length_mm);
  }
  if (a.turns) {
    measure(at, "Hold the instrument", fmt::format("Turn it clockwise {:g} times, its length held", *a.turns), a);
    c.track[k] = with_turns(c.track[k], at.insertion(k), at.roll(k), *a.turns);
  }
  if (a.station_mm) c.track[k].before_introducer_mm = static_cast<float>(*a.station_mm);
  if (a.clamp_N) c.clamp_full_scale_N[k] = static_cast<float>(*a.clamp_N);
}

void change_pressure(Measurement& at, const Arguments& a, device::Calibration& c) {
  if (a.pressure_zero) {
    measure(at, "Open the indeflator to the air", "Leave it open for some seconds", a);
    c = with_pressure_zero(c, at.mean_pressure());
  }
  if (a.pressure_atm) {
    const std::string what = fmt::format("{:g} atm on the indeflator's gauge", *a.pressure_atm);
    measure(at, "Bring " + what, "Keep it for some seconds", a);
    c = with_pressure(c, at.mean_pressure(), *a.pressure_atm);
  }
}

void change_flow(Measurement& at, const Arguments& a, device::Calibration& c) {
  if (a.flow_zero) {
    measure(at, "Let the syringe rest", "Leave it for some seconds", a);
    c = with_flow_zero(c, at.mean_flow());
  }
  if (a.volume_mL) {
    measure(at, "Fill the syringe", fmt::format("Inject {:g} mL", *a.volume_mL), a);
    c = with_volume(c, at.mean_flow() * at.elapsed_s(), at.elapsed_s(), *a.volume_mL);
  }
}

/// The box's own record, or the factory default with the reason in `problem`.
device::Calibration calibration_of(device::UsbPort& port, std::string& problem) {
  device::Calibration c;
  try {
    c = device::parse_calibration(read_calibration(port));
  } catch (const device::CalibrationError& error) {
    problem = error.what();
    c.serial = port.identity().serial;
  }
  return c;
}

/// Throws LoadError unless the box then has the record.
void write_into_box(device::UsbPort& port, const device::Calibration& c) {
  const auto bytes = bytes_of(c);
  if (!write_calibration(port, bytes))
    throw data::LoadError("the box refuses the record; is it armed by another program, or another firmware's?");
  if (read_calibration(port) != std::vector<std::uint8_t>(bytes.begin(), bytes.end()))
    throw data::LoadError("the box gives back another record than it was given");
  fmt::print(stderr, "written to {}\n", port.identity().serial);
}

/// Prints the record, or the record as it would become.
int run(const Arguments& a) {
  if (a.of_a_track() && a.track == 0)
    throw data::LoadError("--length, --turns, --station and --clamp are of a track: --track 1 to 4");
  if (!a.of_a_track() && a.track != 0)
    throw data::LoadError(fmt::format(
        "--track {}: nothing of it is given; expected --length, --turns, --station or --clamp with it", a.track));
  if (a.seconds > 0 && !a.measures())
    throw data::LoadError(
        fmt::format("--seconds {:g}: nothing is measured; expected --length, --turns, --pressure-zero, "
                    "--pressure, --flow-zero or --volume with it",
                    a.seconds));
  std::optional<device::Calibration> from_file;
  if (!a.write.empty()) {
    from_file = read_calibration_record(a.write);
    (void)bytes_of(*from_file);  // refuses impossible records before looking for a box
  }
  Measurement at(a.serial);
  std::string problem;
  device::Calibration c = calibration_of(at.port(), problem);
  if (from_file) {
    if (const std::string& own = at.port().identity().serial; from_file->serial != own)
      throw data::LoadError(fmt::format("{}: serial is \"{}\"; expected \"{}\", the box that is plugged in", a.write,
                                        from_file->serial, own));
    c = *from_file;
  }
  change_track(at, a, c);
  change_pressure(at, a, c);
  change_flow(at, a, c);
  if (a.changes()) c.date = today();
  const bool is_new = a.changes() || from_file;
  if (is_new && !a.dry_run)
    write_into_box(at.port(), c);
  else if (!problem.empty())
    fmt::print(stderr, "ostium device: {}; nominal values:\n", problem);
  fmt::print("{}\n", to_json(c));
  return problem.empty() || is_new ? 0 : 1;
}

}  // namespace

Command device_calibrate_command() {
  return make_command("calibrate", "The box's calibration: read, measured, written",
                      {"ostium device calibrate > box.json", "ostium device calibrate --track 2 --length 200",
                       "ostium device calibrate --track 2 --turns 10", "ostium device calibrate --pressure-zero",
                       "ostium device calibrate --write box.json"},
                      declare, run);
}

}  // namespace ostium::app
