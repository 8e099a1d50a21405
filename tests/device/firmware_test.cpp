/// The firmware's C code against the emulated box, which all other tests use: the same events give the same bytes.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "device/emulator/emulated_box.h"
#include "device/firmware/ostium_box.h"
#include "device/protocol/bytes.h"

namespace ostium::device {
namespace {

/// A calibration in which one count is one unit of tool movement.
Calibration by_counts() {
  Calibration c;
  c.serial = "FW-1";
  for (TrackCalibration& t : c.track) t.mm_per_count = t.deg_per_count = 1;
  c.atm_per_count = c.mL_s_per_count = 1;
  return c;
}

struct Both {
  std::mt19937 generator;
  EmulatedBox emulated{by_counts()};
  box firmware{};
  box_sensors sensors{};
  std::uint16_t out_sequence = 0;

  explicit Both(unsigned seed) : generator(seed) {
    box_init(&firmware, bytes_of(by_counts()).data());
    emulated.separate_brakes = seed % 2;
    firmware.separate_brakes = seed % 2;
  }

  unsigned any(unsigned below) { return static_cast<unsigned>(generator() % below); }

  void sample() {
    std::array<std::uint8_t, in_report_bytes> mine{};
    const auto theirs = emulated.sample();
    box_sample(&firmware, &sensors, static_cast<std::uint32_t>(std::llround(1e6 * emulated.time_s())), mine.data());
    ASSERT_EQ(mine, theirs);
    for (int k = 0; k < 4; ++k) {
      ASSERT_EQ(box_clamp(&firmware, k), emulated.clamp()[static_cast<std::size_t>(k)]);
      ASSERT_EQ(box_rotary_clamp(&firmware, k), emulated.rotary()[static_cast<std::size_t>(k)]);
    }
  }

  void move_world() {
    const std::size_t k = any(4);
    EmulatedTool& tool = emulated.station[k];
    tool.advanced_mm += static_cast<int>(any(200)) - 100, tool.turned_deg += static_cast<int>(any(2000)) - 1000;
    tool.tool = static_cast<Tool>(any(5)), tool.quality = static_cast<std::uint8_t>(any(256));
    sensors.insertion[k] = static_cast<std::int32_t>(tool.advanced_mm);
    sensors.roll[k] = static_cast<std::int32_t>(tool.turned_deg);
    sensors.tool[k] = static_cast<std::uint8_t>(tool.tool), sensors.quality[k] = tool.quality;
    sensors.pressure = static_cast<std::int16_t>(any(65536)), sensors.flow = static_cast<std::int16_t>(any(65536));
    emulated.pressure_atm = sensors.pressure, emulated.flow_mL_s = sensors.flow;
    emulated.pedals = sensors.pedals = static_cast<std::uint16_t>(any(65536));
    emulated.emergency_stop = any(50) == 0, emulated.over_temperature = any(80) == 0;
    sensors.emergency_stop = emulated.emergency_stop, sensors.over_temperature = emulated.over_temperature;
  }

  void out() {
    OutReport report;
    report.sequence = ++out_sequence;
    report.arm = any(4) != 0, report.identify = any(2) == 0;
    for (std::uint16_t& level : report.clamp) level = static_cast<std::uint16_t>(any(65536));
    std::vector<std::uint8_t> bytes;
    const auto put = [&](const auto& whole) { bytes.assign(whole.begin(), whole.end()); };
    if (any(2) == 0) {
      report.rotary.emplace();
      for (std::uint16_t& level : *report.rotary) level = static_cast<std::uint16_t>(any(65536));
      put(brake_bytes_of(report));
    } else {
      put(bytes_of(report));
    }
    if (any(5) == 0) bytes[any(static_cast<unsigned>(bytes.size()))] = static_cast<std::uint8_t>(any(256));
    if (any(40) == 0) bytes.resize(any(80));
    emulated.take(bytes);
    box_take(&firmware, bytes.data(), bytes.size());
  }

  void control() {
    const auto request = static_cast<std::uint8_t>(any(10));
    std::uint16_t value = any(3) == 0 ? calibration_key : static_cast<std::uint16_t>(any(600));
    if (request == 7 && any(2) == 0) value = static_cast<std::uint16_t>(125 << any(4));
    std::vector<std::uint8_t> data;
    if (request == 3) {
      Calibration c = by_counts();
      c.date = any(1000);
      if (any(3) == 0) c.serial = "NEW";
      const auto record = bytes_of(c);
      data.assign(record.begin(), record.end());
      if (any(2) == 0) data[any(128)] ^= static_cast<std::uint8_t>(1 << any(8));
      if (any(10) == 0) data.resize(any(128));
    }
    const auto theirs = emulated.control(request, value, data);
    std::uint8_t reply[BOX_RECORD_BYTES] = {};
    const int count =
        box_control(&firmware, request, value, data.data(), static_cast<std::uint16_t>(data.size()), reply);
    ASSERT_EQ(count >= 0, theirs.has_value()) << "request " << int{request} << ", value " << value;
    if (!theirs) return;
    ASSERT_TRUE(std::equal(theirs->begin(), theirs->end(), reply, reply + count)) << int{request};
  }
};

TEST(Firmware, DoesWhatTheEmulatedBoxDoes) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    Both both(seed);
    int armed = 0, watchdogs = 0;
    for (int i = 0; i < 100'000 && !testing::Test::HasFatalFailure(); ++i) {
      const unsigned dice = both.any(100);
      if (dice < 30) both.out();
      if (dice == 99) both.control();
      if (dice == 98 && both.any(10) == 0) both.emulated.release(), box_release(&both.firmware);
      if (dice == 97 && both.any(10) == 0)  // the host stops responding
        for (int n = 0; n < 300; ++n) both.sample();
      if (dice < 20) both.move_world();  // visible to this sample, not before
      both.sample();
      armed += both.firmware.armed, watchdogs += both.firmware.watchdog_released;
    }
    EXPECT_GT(armed, 1000);
    EXPECT_GT(watchdogs, 100);
  }
}

/// Firmware and host's reader refuse the same records: with a correct CRC, and any one number random.
TEST(Firmware, TakesTheRecordsThatTheHostTakes) {
  std::mt19937 generator(3);
  int taken = 0, refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    auto record = bytes_of(by_counts());
    static constexpr std::uint32_t wild[] = {0, 0x80000000, 0x7f800000, 0xff800000, 0x7fc00000, 0x3f800000, 0xbf800000};
    const std::size_t at = 4 * (generator() % 31);
    put<std::uint32_t>(record, at, generator() % 2 ? wild[generator() % 7] : static_cast<std::uint32_t>(generator()));
    // The correct CRC, from the polynomial.
    std::uint32_t crc = 0xffffffff;
    for (std::size_t b = 0; b < 124; ++b) {
      crc ^= record[b];
      for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
    }
    put<std::uint32_t>(record, 124, ~crc);
    bool host = true;
    try {
      parse_calibration(record);
    } catch (const CalibrationError&) {
      host = false;
    }
    box firmware;
    box_init(&firmware, record.data());
    ASSERT_EQ(firmware.calibrated != 0, host) << "byte " << at;
    ++(host ? taken : refused);
  }
  EXPECT_GT(taken, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace ostium::device
