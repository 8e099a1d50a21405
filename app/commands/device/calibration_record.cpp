#include "app/commands/device/calibration_record.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "data/formats/json/json_object.h"

namespace ostium::app {

namespace {

const char* const a_number = "a number";
const data::JsonObjectKeys track_keys{
    "track",
    {{"mm_per_count", true, a_number},
     {"deg_per_count", true, a_number},
     {"cross_talk_mm_deg", true, "insertion seen per degree of roll, mm"},
     {"before_introducer_mm", true, "the station's distance outside the introducer, >= 0"},
     {"clamp_full_scale_N", true, "friction of the clamp at level 65535, N, > 0"}}};
const data::JsonObjectKeys record_keys{"calibration",
                                       {{"serial", true, "up to 16 characters without blanks"},
                                        {"date", true, "yyyymmdd, as a number"},
                                        {"tracks", true, "four tracks"},
                                        {"atm_per_count", true, a_number},
                                        {"pressure_offset_atm", true, a_number},
                                        {"mL_s_per_count", true, a_number},
                                        {"flow_offset_mL_s", true, a_number}}};

/// 0 where it was never calibrated.
bool is_day(std::uint32_t yyyymmdd) {
  using namespace std::chrono;
  return yyyymmdd == 0 ||
         year_month_day(year(static_cast<int>(yyyymmdd / 10000)), month(yyyymmdd / 100 % 100), day(yyyymmdd % 100))
             .ok();
}

/// The float as a double with the fewest digits that round to it.
double short_number(float value) { return std::stod(fmt::format("{}", value)); }

}  // namespace

std::string to_json(const device::Calibration& c) {
  nlohmann::ordered_json out = {{"serial", c.serial}, {"date", c.date}};
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
  return out.dump(2);
}

device::Calibration read_calibration_record(const std::string& file) {
  const data::JsonValue value = data::load_json(file);
  const data::JsonObject in(value, record_keys);
  const auto number = [](const data::JsonObject& object, const char* key) {
    return static_cast<float>(object.number(key));
  };
  device::Calibration c;
  c.serial = in.text("serial");
  const double date = in.not_negative("date");
  if (date != std::floor(date) || date > 99991231 || !is_day(static_cast<std::uint32_t>(date))) in.refuse("date");
  c.date = static_cast<std::uint32_t>(date);
  if (in.list("tracks").size() != 4) in.refuse("tracks");
  for (std::size_t k = 0; k < 4; ++k) {
    const data::JsonObject track(in.list("tracks")[k], track_keys);
    c.track[k] = {number(track, "mm_per_count"), number(track, "deg_per_count"), number(track, "cross_talk_mm_deg"),
                  number(track, "before_introducer_mm")};
    c.clamp_full_scale_N[k] = number(track, "clamp_full_scale_N");
  }
  c.atm_per_count = number(in, "atm_per_count"), c.pressure_offset_atm = number(in, "pressure_offset_atm");
  c.mL_s_per_count = number(in, "mL_s_per_count"), c.flow_offset_mL_s = number(in, "flow_offset_mL_s");
  return c;
}

}  // namespace ostium::app
