/// The emulator on a socket, as seen by a kernel at the other end: an independent implementation of the USB/IP bytes.
#include "device/emulator/usbip.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>

#include "device/protocol/report.h"

namespace ostium::device {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes big(std::initializer_list<std::uint32_t> words) {
  Bytes b;
  for (const std::uint32_t w : words)
    for (const int shift : {24, 16, 8, 0}) b.push_back(static_cast<std::uint8_t>(w >> shift));
  return b;
}

struct Host {
  int socket;

  void send(Bytes b) { ASSERT_EQ(::send(socket, b.data(), b.size(), 0), static_cast<ssize_t>(b.size())); }
  Bytes receive(std::size_t count) {
    Bytes b(count);
    for (std::size_t done = 0; done < count;) {
      const ssize_t some = recv(socket, b.data() + done, count - done, 0);
      if (some <= 0) return {};
      done += static_cast<std::size_t>(some);
    }
    return b;
  }
  void submit(std::uint32_t number, bool in, std::uint32_t endpoint, std::uint32_t length, const Bytes& setup,
              const Bytes& data = {}) {
    Bytes b = big({1, number, usbip_device, in, endpoint, 0, length, 0, 0, 0});
    b.insert(b.end(), setup.begin(), setup.end());
    b.resize(48, 0);
    b.insert(b.end(), data.begin(), data.end());
    send(b);
  }
  struct Answer {
    std::uint32_t command = 0, number = 0;
    std::int32_t status = 0;
    Bytes data;
  };
  Answer answer(bool with_data) {
    const Bytes h = receive(48);
    if (h.empty()) return {};
    const auto word = [&](std::size_t at) {
      return std::uint32_t{h[at]} << 24 | std::uint32_t{h[at + 1]} << 16 | std::uint32_t{h[at + 2]} << 8 | h[at + 3];
    };
    Answer a{word(0), word(4), static_cast<std::int32_t>(word(20)), {}};
    if (with_data && a.status == 0) a.data = receive(word(24));
    return a;
  }
};

struct Usbip : testing::Test {
  EmulatedUsb usb{Calibration{}};
  std::atomic<bool> over{false};
  std::thread server;
  Host host{-1};

  void SetUp() override {
    int ends[2];
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    host.socket = ends[0];
    server = std::thread([this, end = ends[1]] { UsbipLink(usb, end).serve(over); });
  }
  void TearDown() override {
    over = true;
    close(host.socket);
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
  EmulatedUsb usb{Calibration{}};
  std::atomic<bool> over{false};
  std::uint16_t port = 0;
  std::string problem;
  std::thread server;
  // Finds a free port.
  for (port = 33240; port < 33340; ++port) {
    const int probe = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in a{};
    a.sin_family = AF_INET, a.sin_port = htons(port), a.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const bool is_free = bind(probe, reinterpret_cast<sockaddr*>(&a), sizeof a) == 0;
    close(probe);
    if (is_free) break;
  }
  server = std::thread([&] {
    try {
      serve_usbip(usb, port, false, over, [](const std::string&) {});
    } catch (const std::exception& error) {
      problem = error.what();
    }
  });
  const auto connected = [&] {
    sockaddr_in a{};
    a.sin_family = AF_INET, a.sin_port = htons(port), a.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    for (int i = 0; i < 100; ++i) {
      const int s = socket(AF_INET, SOCK_STREAM, 0);
      if (connect(s, reinterpret_cast<sockaddr*>(&a), sizeof a) == 0) return s;
      close(s);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return -1;
  };
  Host lister{connected()};
  ASSERT_GE(lister.socket, 0) << problem;
  lister.send({0x01, 0x11, 0x80, 0x05, 0, 0, 0, 0});
  const Bytes list = lister.receive(12 + 312 + 4);
  ASSERT_EQ(list.size(), 328u);
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(&list[12 + 256])), "1-1");
  EXPECT_EQ(list[12 + 300] << 8 | list[12 + 301], 0x1209);
  close(lister.socket);

  Host host{connected()};
  Bytes request{0x01, 0x11, 0x80, 0x03, 0, 0, 0, 0, '1', '-', '1'};
  request.resize(40, 0);
  host.send(request);
  ASSERT_EQ(host.receive(8 + 312).size(), 320u);
  host.submit(1, true, 1, 64, {});
  EXPECT_TRUE(parse_in_report(host.answer(true).data));
  close(host.socket);
  over = true;
  server.join();
  EXPECT_EQ(problem, "");
}

}  // namespace
}  // namespace ostium::device
