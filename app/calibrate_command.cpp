#include "app/calibrate_command.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "data/formats/json_object.h"
#include "device/calibrating.h"
#include "device/tracking_box.h"
#include "device/usb_port.h"

namespace ostium {

namespace {

using Json = nlohmann::ordered_json;

// --- a record as text ------------------------------------------------------------------------------------------------

const char* const a_number = "a number";
const JsonObjectKeys track_keys{"track",
                                {{"mm_per_count", true, a_number},
                                 {"deg_per_count", true, a_number},
                                 {"cross_talk_mm_deg", true, "insertion seen per degree of roll, mm"},
                                 {"before_introducer_mm", true, "the station's distance outside the introducer, >= 0"},
                                 {"clamp_full_scale_N", true, "friction of the clamp at level 65535, N, > 0"}}};
const JsonObjectKeys record_keys{"calibration",
                                 {{"serial", true, "up to 16 characters without blanks"},
                                  {"date", true, "yyyymmdd, as a number"},
                                  {"tracks", true, "four tracks"},
                                  {"atm_per_count", true, a_number},
                                  {"pressure_offset_atm", true, a_number},
                                  {"mL_s_per_count", true, a_number},
                                  {"flow_offset_mL_s", true, a_number}}};

/// Nearest float in the fewest digits.
double short_number(float value) { return std::stod(fmt::format("{}", value)); }

Json to_json(const Calibration& c) {
  Json out = {{"serial", c.serial}, {"date", c.date}};
  for (std::size_t k = 0; k < 4; ++k)
    out["tracks"].push_back({{"mm_per_count", short_number(c.track[k].mm_per_count)},
                             {"deg_per_count", short_number(c.track[k].deg_per_count)},
                             {"cross_talk_mm_deg", short_number(c.track[k].cross_talk_mm_deg)},
                             {"before_introducer_mm", short_number(c.track[k].before_introducer_mm)},
                             {"clamp_full_scale_N", short_number(c.clamp_full_scale_N[k])}});
  out["atm_per_count"] = short_number(c.atm_per_count);
  out["pressure_offset_atm"] = short_number(c.pressure_offset_atm);
  out["mL_s_per_count"] = short_number(c.mL_s_per_count);
  out["flow_offset_mL_s"] = short_number(c.flow_offset_mL_s);
  return out;
}

Calibration read_record(const std::string& file) {
  const JsonValue value = load_json(file);
  const JsonObject in(value, record_keys);
  const auto number = [](const JsonObject& object, const char* key) { return static_cast<float>(object.number(key)); };
  Calibration c;
  c.serial = in.text("serial");
  const double date = in.not_negative("date");
  if (date != std::floor(date) || date > 99991231) in.refuse("date");
  c.date = static_cast<std::uint32_t>(date);
  if (in.list("tracks").size() != 4) in.refuse("tracks");
  for (std::size_t k = 0; k < 4; ++k) {
    const JsonObject track(in.list("tracks")[k], track_keys);
    c.track[k] = {number(track, "mm_per_count"), number(track, "deg_per_count"), number(track, "cross_talk_mm_deg"),
                  number(track, "before_introducer_mm")};
    c.clamp_full_scale_N[k] = number(track, "clamp_full_scale_N");
  }
  c.atm_per_count = number(in, "atm_per_count"), c.pressure_offset_atm = number(in, "pressure_offset_atm");
  c.mL_s_per_count = number(in, "mL_s_per_count"), c.flow_offset_mL_s = number(in, "flow_offset_mL_s");
  return c;
}

std::uint32_t today() {
  const std::time_t now = std::time(nullptr);
  std::tm day{};
  localtime_r(&now, &day);
  return static_cast<std::uint32_t>(10000 * (day.tm_year + 1900) + 100 * (day.tm_mon + 1) + day.tm_mday);
}

// --- measuring -------------------------------------------------------------------------------------------------------

double clock_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

bool enter_pressed() {
  pollfd in{STDIN_FILENO, POLLIN, 0};
  if (::poll(&in, 1, 0) <= 0) return false;
  char some[256];
  return read(STDIN_FILENO, some, sizeof some) >= 0;
}

/// The box's raw counts while something is done.
class Measurement : private ReportSink {
 public:
  explicit Measurement(const std::string& serial) : port_(serial) {
    for (const double until = clock_s() + 2; clock_s() < until && reports_ == 0;) state_ = port_.poll(0.02, *this);
    if (reports_ > 0) return;
    BoxSnapshot now;
    now.trouble = state_.trouble;
    now.link = state_.open ? Link::silent : Link::unplugged;
    throw LoadError(std::string(advice(now)));
  }

  UsbPort& port() { return port_; }

  /// Until Enter, or so many seconds.
  void wait(const std::string& what, double seconds) {
    if (seconds <= 0) fmt::print(stderr, "{}, then press Enter\n", what);
    for (const double until = clock_s() + seconds; seconds > 0 ? clock_s() < until : !enter_pressed();)
      if (!port_.poll(0.02, *this).open) throw LoadError("the box was unplugged while it was measured");
  }

  void begin() {
    insertion_ = roll_ = {};
    pressure_ = flow_ = elapsed_s_ = 0;
    samples_ = 0;
  }

  std::int64_t insertion(std::size_t track) const { return insertion_[track]; }
  std::int64_t roll(std::size_t track) const { return roll_[track]; }
  double mean_pressure() const { return pressure_ / samples_; }
  double mean_flow() const { return flow_ / samples_; }
  double elapsed_s() const { return elapsed_s_; }

 private:
  void came(std::span<const std::uint8_t> bytes) override {
    const auto report = parse_in_report(bytes);
    if (!report) return;
    const auto difference = [](auto now, auto before) {
      return static_cast<std::int32_t>(static_cast<std::uint32_t>(now) - static_cast<std::uint32_t>(before));
    };
    if (reports_++ > 0) {
      for (std::size_t k = 0; k < 4; ++k) {
        insertion_[k] += difference(report->insertion[k], last_.insertion[k]);
        roll_[k] += difference(report->roll[k], last_.roll[k]);
      }
      elapsed_s_ += 1e-6 * difference(report->time_us, last_.time_us);
    }
    pressure_ += report->pressure, flow_ += report->flow, samples_ += 1;
    last_ = *report;
  }

  UsbPort port_;
  PortState state_;
  InReport last_;
  std::uint64_t reports_ = 0;
  std::array<std::int64_t, 4> insertion_{}, roll_{};
  double pressure_ = 0, flow_ = 0, elapsed_s_ = 0, samples_ = 0;
};

void measure(Measurement& at, const std::string& begin, const std::string& end, const CalibrateOptions& o) {
  if (o.seconds <= 0) at.wait(begin, 0);
  at.begin();
  at.wait(end, o.seconds);
}

/// True: something of the record has become otherwise.
bool change(Measurement& at, const CalibrateOptions& o, Calibration& c) {
  const auto k = static_cast<std::size_t>(o.track - 1);
  if (o.length_mm) {
    measure(at, "Hold the instrument at a mark", fmt::format("Push it in by {:g} mm, without turning it", *o.length_mm),
            o);
    c.track[k] = with_length(c.track[k], at.insertion(k), *o.length_mm);
  }
  if (o.turns) {
    measure(at, "Hold the instrument", fmt::format("Turn it clockwise {:g} times, its length held", *o.turns), o);
    c.track[k] = with_turns(c.track[k], at.insertion(k), at.roll(k), *o.turns);
  }
  if (o.station_mm) c.track[k].before_introducer_mm = static_cast<float>(*o.station_mm);
  if (o.clamp_N) c.clamp_full_scale_N[k] = static_cast<float>(*o.clamp_N);
  if (o.pressure_zero) {
    measure(at, "Open the indeflator to the air", "Leave it open for some seconds", o);
    c = with_pressure_zero(c, at.mean_pressure());
  }
  if (o.pressure_atm) {
    const std::string what = fmt::format("{:g} atm on the indeflator's gauge", *o.pressure_atm);
    measure(at, "Bring " + what, "Keep it for some seconds", o);
    c = with_pressure(c, at.mean_pressure(), *o.pressure_atm);
  }
  if (o.flow_zero) {
    measure(at, "Let the syringe rest", "Leave it for some seconds", o);
    c = with_flow_zero(c, at.mean_flow());
  }
  if (o.volume_mL) {
    measure(at, "Fill the syringe", fmt::format("Inject {:g} mL", *o.volume_mL), o);
    c = with_volume(c, at.mean_flow() * at.elapsed_s(), at.elapsed_s(), *o.volume_mL);
  }
  return o.length_mm || o.turns || o.station_mm || o.clamp_N || o.pressure_zero || o.pressure_atm || o.flow_zero ||
         o.volume_mL;
}

}  // namespace

int device_calibrate_command(const CalibrateOptions& o) {
  if ((o.length_mm || o.turns || o.station_mm || o.clamp_N) && o.track == 0)
    throw LoadError("--length, --turns, --station and --clamp are of a track: --track 1 to 4");
  std::optional<Calibration> from_file;
  if (!o.write.empty()) {
    from_file = read_record(o.write);
    (void)bytes_of(*from_file);  // refuses what no box may have, before one is looked for
  }
  Measurement at(o.serial);
  Calibration c;
  std::string problem;
  try {
    c = parse_calibration(read_calibration(at.port()));
  } catch (const CalibrationError& error) {
    problem = error.what();
    c.serial = at.port().identity().serial;
  }
  if (from_file) c = *from_file;
  const bool changed = change(at, o, c);
  if (changed) c.date = today();
  if ((changed || from_file) && !o.dry_run) {
    if (!write_calibration(at.port(), bytes_of(c)))
      throw LoadError("the box refuses the record; is it armed by another program, or another firmware's?");
    if (read_calibration(at.port()) != std::vector<std::uint8_t>([&] {
          const auto bytes = bytes_of(c);
          return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
        }()))
      throw LoadError("the box gives back another record than it was given");
    fmt::print(stderr, "written to {}\n", at.port().identity().serial);
  } else if (!problem.empty()) {
    fmt::print(stderr, "ostium device: {}; nominal values:\n", problem);
  }
  fmt::print("{}\n", to_json(c).dump(2));
  return !problem.empty() && !changed && !from_file ? 1 : 0;
}

}  // namespace ostium
