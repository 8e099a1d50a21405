/// The emulator on a socket, as seen by a kernel at the other end.
#include <gtest/gtest.h>

#include "device/emulator/usbip_link.h"
#include "device/protocol/report.h"
#include "tests/device/usbip_host.h"

namespace ostium::device {
namespace {

struct Usbip : testing::Test {
  EmulatedUsb usb{Calibration{}};
  std::atomic<bool> over{false};
  std::thread server;
  UsbipHost host;

  void SetUp() override {
    int ends[2];
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    host = UsbipHost(ends[0]);
    server = std::thread([this, end = ends[1]] { UsbipLink(usb, Connection(end)).serve(over); });
  }
  void TearDown() override {
    over = true;
    host.leave();
    server.join();
  }
};

TEST_F(Usbip, DescribesItself) {
  host.submit(7, true, 0, 18, {0x80, 6, 0, 1, 0, 0, 18, 0});
  const auto device = host.answer(true);
  EXPECT_EQ(device.command, 3u);
  EXPECT_EQ(device.number, 7u);
  EXPECT_EQ(device.data, device_descriptor());
  host.submit(8, true, 0, 255, {0x80, 6, 0, 2, 0, 0, 255, 0});
  EXPECT_EQ(host.answer(true).data, configuration_descriptor());
  host.submit(9, true, 0, 255, {0x80, 6, 0, 15, 0, 0, 255, 0});
  const Bytes bos = host.answer(true).data;
  ASSERT_EQ(bos.size(), 33u);
  EXPECT_EQ(bos[2], bos.size());
  const std::uint8_t request = bos[31];
  host.submit(10, true, 0, 512, {0xc0, request, 0, 0, 7, 0, 0, 2});
  const Bytes set = host.answer(true).data;
  EXPECT_EQ(set.size(), bos[29] + 256u * bos[30]) << "Microsoft's set is as long as the store says";
  EXPECT_EQ(std::string(set.begin() + 14, set.begin() + 20), "WINUSB");
  host.submit(11, true, 0, 8, {0xc1, 0x66, 0, 0, 0, 0, 8, 0});
  EXPECT_EQ(host.answer(true).status, -EPIPE) << "unknown requests stall";
}

TEST_F(Usbip, SamplesGoToTheOldestTransferAndUnlinkedOnesGetNone) {
  usb.with([](EmulatedBox&, EmulatedFaults& f) { f.silent = true; });
  for (std::uint32_t n = 1; n <= 4; ++n) host.submit(n, true, 1, 64, {});
  Bytes unlink = big({2, 100, usbip_device, 0, 0, 2});
  unlink.resize(48, 0);
  host.send(unlink);
  const auto unlinked = host.answer(false);
  EXPECT_EQ(unlinked.command, 4u);
  EXPECT_EQ(unlinked.number, 100u);
  EXPECT_EQ(unlinked.status, -ECONNRESET);
  usb.with([](EmulatedBox&, EmulatedFaults& f) { f.silent = false; });
  std::uint32_t sequence = 0;
  for (const std::uint32_t n : {1u, 3u, 4u}) {
    const auto sample = host.answer(true);
    EXPECT_EQ(sample.number, n);
    const auto report = parse_in_report(sample.data);
    ASSERT_TRUE(report);
    EXPECT_GT(report->sequence, sequence);
    sequence = report->sequence;
  }
  OutReport out;
  out.sequence = 77;
  const auto bytes = bytes_of(out);
  host.submit(5, false, 2, out_report_bytes, {}, Bytes(bytes.begin(), bytes.end()));
  EXPECT_EQ(host.answer(false).number, 5u);
  host.submit(6, true, 1, 64, {});
  EXPECT_EQ(parse_in_report(host.answer(true).data)->last_out_sequence, 77);
}

TEST(UsbipServer, IsListedImportedAndAttachedOverTcp) {
  UsbipServed served;
  UsbipHost lister = served.connected();
  lister.send({0x01, 0x11, 0x80, 0x05, 0, 0, 0, 0});
  const Bytes list = lister.receive(12 + 312 + 4);
  ASSERT_EQ(list.size(), 328u);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(&list[12 + 256])), "1-1");
  EXPECT_EQ(list[12 + 300] << 8 | list[12 + 301], 0x1209);
  EXPECT_TRUE(lister.is_ended());

  UsbipHost host = served.connected();
  ASSERT_EQ(host.attach(), 0);
  host.submit(1, true, 1, 64, {});
  EXPECT_TRUE(parse_in_report(host.answer(true).data));
}

TEST(UsbipServer, RefusesASecondHostAtOnceAndGivesTheBoxToTheNext) {
  UsbipServed served;
  UsbipHost first = served.connected();
  ASSERT_EQ(first.attach(), 0);
  UsbipHost second = served.connected(), stranger = served.connected();
  const auto begin = Clock::now();
  EXPECT_EQ(second.attach(), 2) << "in use, in the kernel's numbering";
  EXPECT_TRUE(second.is_ended());
  EXPECT_EQ(stranger.attach("2-1"), 4) << "no such device";
  EXPECT_LT(seconds_since(begin), 0.5);
  first.submit(1, true, 1, 64, {});
  EXPECT_TRUE(parse_in_report(first.answer(true).data)) << "the first goes on";
  EXPECT_TRUE(served.said("refused: another one has the box"));
  for (int i = 0; i < 100; ++i) {
    first.leave();
    first = served.connected();
    ASSERT_EQ(first.attach(), 0) << "who asks right after the last one left has the box";
  }
}

}  // namespace
}  // namespace ostium::device
