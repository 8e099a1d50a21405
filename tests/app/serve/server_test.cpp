/// The station's server against clients that are not its page: strangers, the silent, the stalled, floods, nonsense.
#include "app/serve/http/server.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <set>
#include <thread>

#include "tests/app/serve/client.h"

namespace ostium::app {
namespace {

using namespace std::chrono_literals;

struct Room : Listener {
  std::vector<std::string> greet(Role role) override {
    return {role == Role::trainer ? R"({"type":"welcome","role":"trainer"})" : R"({"type":"welcome","role":"viewer"})"};
  }
  std::string hear(Role role, const std::string& text) override {
    ++heard;
    return (role == Role::trainer ? "trainer said " : "viewer said ") + text;
  }
  void lost_trainer() override { ++lost; }
  std::atomic<int> heard{0}, lost{0};
};

const std::string trainer(64, 'a'), viewer(64, 'b');

struct Served {
  Room room;
  Server server;
  explicit Served(ServerSettings settings = {}) : server(with_tokens(std::move(settings)), room) {}
  static ServerSettings with_tokens(ServerSettings s) {
    s.trainer_token = trainer, s.viewer_token = viewer;
    s.pages = {{"/", "text/html", "<p>page</p>"}, {"/a.js", "text/javascript", "1"}};
    return s;
  }
};

TEST(Server, AnswersItsOwnPageOnly) {
  Served s;
  const auto get = [&](const std::string& line, const std::string& more = "", const std::string& host = "-") {
    return Client(s.server.port()).request(line, more, host);
  };
  const std::string own = get("GET /");
  EXPECT_NE(own.find(" 200 "), std::string::npos);
  EXPECT_NE(own.find("Content-Security-Policy: default-src 'none'; script-src 'self'"), std::string::npos) << own;
  EXPECT_NE(own.find("nosniff"), std::string::npos);
  const std::string port = std::to_string(s.server.port());
  EXPECT_NE(get("GET /", "", "localhost:" + port).find(" 200 "), std::string::npos);
  const std::vector<std::string> others = {"evil.example:" + port, "127.0.0.1:1", "127.0.0.1", ""};
  for (const std::string& host : others) EXPECT_NE(get("GET /", "", host).find(" 403 "), std::string::npos) << host;
  EXPECT_NE(get("GET /a.js", "Origin: http://evil.example\r\n").find(" 403 "), std::string::npos);
  for (const char* path : {"/nowhere", "/../etc/passwd", "/%2e%2e/etc/passwd", "/a.js/", "//a.js", "/index.html?x"})
    EXPECT_NE(get(std::string("GET ") + path).find(" 404 "), std::string::npos) << path;
  EXPECT_NE(get("POST /", "Content-Length: 0\r\n").find(" 405 "), std::string::npos);
  EXPECT_NE(get("POST /", "Content-Length: 5\r\n").find(" 405 "), std::string::npos);
  EXPECT_NE(get("GET /", "Content-Length: 5\r\n").find(" 400 "), std::string::npos);
}

TEST(Server, ManyWhoSayNothingKeepNobodyOut) {
  Served s;
  std::vector<std::unique_ptr<Client>> strangers, viewers;
  for (int i = 0; i < 60; ++i) strangers.push_back(std::make_unique<Client>(s.server.port()));
  Client comes(s.server.port());
  EXPECT_TRUE(comes.come_in(trainer));
  EXPECT_TRUE(strangers.front()->is_ended(2000));
  for (int i = 0; i < 50; ++i) viewers.push_back(std::make_unique<Client>(s.server.port()));
  int inside = 0;
  for (const auto& one : viewers) inside += one->come_in(viewer);
  EXPECT_EQ(inside, 40);
  Client again(s.server.port());
  EXPECT_TRUE(again.come_in(trainer)) << "in a room full of viewers";
}

TEST(Server, IsFoundAtThePortThatBrowsersLeaveOut) {
  ServerSettings http;
  http.port = 80;
  std::unique_ptr<Served> s;
  try {
    s = std::make_unique<Served>(http);
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << error.what();
  }
  EXPECT_NE(Client(80).request("GET /", "", "127.0.0.1").find(" 200 "), std::string::npos);
}

TEST(Server, OpensASocketToItsOwnPageOnly) {
  Served s;
  const std::string own = "http://127.0.0.1:" + std::to_string(s.server.port());
  EXPECT_NE(Client(s.server.port()).open_socket(own).find(" 101 "), std::string::npos);
  EXPECT_NE(Client(s.server.port()).open_socket("").find(" 403 "), std::string::npos) << "browsers name the origin";
  EXPECT_NE(Client(s.server.port()).open_socket("http://evil.example").find(" 403 "), std::string::npos);
  EXPECT_NE(Client(s.server.port()).open_socket("null").find(" 403 "), std::string::npos);
  EXPECT_NE(Client(s.server.port()).open_socket("http://evil.example", "evil.example").find(" 403 "), std::string::npos)
      << "a name that was made to mean this machine";
}

TEST(Server, WhoSaysNoHelloOrAWrongOneIsOut) {
  ServerSettings quick;
  quick.hello_s = 0.3;
  Served s(quick);
  const std::string own = "http://127.0.0.1:" + std::to_string(s.server.port());
  Client silent(s.server.port()), wrong(s.server.port()), early(s.server.port()), right(s.server.port());
  silent.open_socket(own), wrong.open_socket(own), early.open_socket(own);
  wrong.say(R"({"do":"hello","token":")" + std::string(64, 'c') + "\"}");
  early.say(R"({"do":"pause"})");
  EXPECT_TRUE(right.come_in(trainer));
  EXPECT_TRUE(wrong.is_ended(2000));
  EXPECT_TRUE(early.is_ended(2000));
  EXPECT_TRUE(silent.is_ended(3000));
  EXPECT_EQ(s.room.heard, 0);
  right.say("here");
  EXPECT_TRUE(right.message_with("trainer said here"));
}

TEST(Server, OneTrainerWhoComesBack) {
  Served s;
  Client first(s.server.port()), second(s.server.port()), looks(s.server.port());
  ASSERT_TRUE(first.come_in(trainer));
  ASSERT_TRUE(looks.come_in(viewer));
  ASSERT_TRUE(second.come_in(trainer));
  EXPECT_TRUE(first.is_ended(2000)) << "the same trainer's old browser";
  EXPECT_GE(s.room.lost, 1) << "its keys are let go";
  looks.say("x");
  EXPECT_TRUE(looks.message_with("viewer said x"));
}

TEST(Server, FloodsAndNonsenseEndTheirOwnConnectionAndNoOther) {
  ServerSettings few;
  few.messages_per_s = 5;  // a server that gets a tenth of a core reads no faster than is allowed otherwise
  Served s(few);
  Client good(s.server.port()), flood(s.server.port()), bytes(s.server.port()), large(s.server.port());
  ASSERT_TRUE(good.come_in(trainer));
  ASSERT_TRUE(flood.come_in(viewer));
  ASSERT_TRUE(bytes.come_in(viewer));
  ASSERT_TRUE(large.come_in(viewer));
  for (int i = 0; i < 2000 && flood.is_open(); ++i) flood.say("x");
  bytes.say("\x01\x02\x03", 2);
  large.say(std::string(20000, 'x'));
  Client garbage(s.server.port());
  garbage.raw(std::string(20000, '\xff'));
  EXPECT_TRUE(flood.is_ended(20000));
  EXPECT_TRUE(bytes.is_ended(2000));
  EXPECT_TRUE(large.is_ended(2000));
  EXPECT_TRUE(garbage.is_ended(2000));
  EXPECT_LE(s.room.heard, 800) << "of 2000";
  good.say("still here");
  EXPECT_TRUE(good.message_with("still here"));
}

TEST(Server, AStalledViewerSkipsThenGoesAndOthersGetTheNewest) {
  ServerSettings quick;
  quick.stall_s = 0.5;
  Served s(quick);
  Client stalled(s.server.port(), 4096), good(s.server.port());
  ASSERT_TRUE(stalled.come_in(viewer));
  ASSERT_TRUE(good.come_in(viewer));
  const std::string last = "frame 299 ";
  std::thread sender([&] {
    for (int i = 0; i < 300; ++i) {
      s.server.send(Channel::frame, {"frame " + std::to_string(i) + " " + std::string(40000, '.'), true});
      std::this_thread::sleep_for(5ms);
    }
  });
  EXPECT_TRUE(good.message_with(last, 10000));
  sender.join();
  // It reads what has been kept for it, which ends.
  EXPECT_TRUE(stalled.is_ended(3000));
  EXPECT_TRUE(good.is_open());
}

TEST(Server, EndsWhileClientsComeIn) {
  const auto begun = std::chrono::steady_clock::now();
  for (int round = 0; round < 30; ++round) {
    auto s = std::make_unique<Served>();
    const std::uint16_t port = s->server.port();
    std::atomic<bool> over{false};
    std::atomic<int> came{0};
    std::thread comers([&] {
      for (; !over; std::this_thread::sleep_for(100us)) came += Client(port).is_open();
    });
    while (came == 0) std::this_thread::sleep_for(100us);
    s.reset();  // returns, though some have come in and are not known yet
    over = true;
    comers.join();
    EXPECT_FALSE(Client(port).is_open()) << "nobody listens any more";
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begun, 60s);
}

TEST(Server, TokensAre256BitsAndNeverTheSame) {
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) {
    tokens.insert(make_token());
    EXPECT_EQ(tokens.begin()->size(), 64u);
  }
  EXPECT_EQ(tokens.size(), 100u);
  EXPECT_TRUE(is_loopback("127.0.0.1") && is_loopback("::1"));
  EXPECT_FALSE(is_loopback("0.0.0.0") || is_loopback("192.168.1.20"));
}

}  // namespace
}  // namespace ostium::app
