#include "app/serve/http/connection.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace ostium::app {

namespace {

using std::chrono::duration;

std::chrono::milliseconds ms(double s) { return std::chrono::milliseconds(static_cast<long>(1000 * s)); }

/// Takes as long wherever the first difference is.
bool same_token(const std::string& given, const std::string& token) {
  unsigned different = given.size() == token.size() ? 0 : 1;
  for (std::size_t i = 0; i < token.size(); ++i)
    different |= static_cast<unsigned char>(token[i]) ^ static_cast<unsigned char>(i < given.size() ? given[i] : 0);
  return different == 0 && !token.empty();
}

/// What a page of ours may do: fetch from here, connect to here, and nothing else.
void secure(http::response<http::string_body>& response, const std::string& host) {
  response.set(
      "Content-Security-Policy",
      "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; connect-src 'self' "
      "ws://" +
          host + "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
  response.set("X-Content-Type-Options", "nosniff");
  response.set("Referrer-Policy", "no-referrer");
  response.set("Cross-Origin-Opener-Policy", "same-origin");
  response.set("Cross-Origin-Resource-Policy", "same-origin");
  response.set(http::field::cache_control, "no-store");
}

}  // namespace

Connection::Connection(tcp::socket socket, Hub& hub)
    : hub_(hub), socket_(std::move(socket)), timer_(socket_.get_executor()), allowed_(hub.settings.burst) {}

void Connection::begin() {
  beast::error_code ignored;
  tcp::socket& raw = socket_.next_layer().socket();
  raw.set_option(tcp::no_delay(true), ignored);
  // What waits in the kernel is no longer the newest.
  raw.set_option(asio::socket_base::send_buffer_size(128 << 10), ignored);
  watch();
  read_request();
}

void Connection::close() {
  if (closed_) return;
  closed_ = true;
  timer_.cancel();
  beast::error_code ignored;
  socket_.next_layer().socket().shutdown(tcp::socket::shutdown_both, ignored);
  socket_.next_layer().close();
  if (is_trainer()) hub_.listener.lost_trainer();
  hub_.connections.erase(shared_from_this());
}

/// Once in a while: those who say no hello, take nothing, or are a trainer whose hands are silent.
void Connection::watch() {
  timer_.expires_after(std::chrono::milliseconds(250));
  timer_.async_wait([self = shared_from_this()](beast::error_code error) {
    if (error || self->closed_) return;
    const auto now = Clock::now();
    const ServerSettings& limits = self->hub_.settings;
    if (self->is_socket_ && !self->role_ && now - self->since_ > ms(limits.hello_s)) return self->close();
    if (self->writing_ && now - self->writing_since_ > ms(limits.stall_s)) return self->close();
    if (self->is_trainer() && !self->quiet_ && now - self->heard_at_ > ms(1.0)) {
      self->quiet_ = true;
      self->hub_.listener.lost_trainer();
    }
    self->watch();
  });
}

void Connection::read_request() {
  request_.emplace();
  request_->header_limit(8192);
  request_->body_limit(0);
  socket_.next_layer().expires_after(ms(hub_.settings.request_s));
  http::async_read(socket_.next_layer(), buffer_, *request_,
                   [self = shared_from_this()](beast::error_code error, std::size_t) { self->answer(error); });
}

/// Whether the request is for this server, and comes from its own page if it comes from one.
bool Connection::is_ours() const {
  const auto& request = request_->get();
  const std::string host(request[http::field::host]);
  if (std::find(hub_.hosts.begin(), hub_.hosts.end(), host) == hub_.hosts.end()) return false;
  const auto origin = request.find(http::field::origin);
  if (origin != request.end()) return std::string(origin->value()) == "http://" + host;
  return !websocket::is_upgrade(request);  // every browser names the origin of a WebSocket
}

void Connection::answer(beast::error_code error) {
  if (closed_) return;
  const bool has_body = error == http::error::body_limit;
  if (error && !has_body) return close();
  const auto& request = request_->get();
  const std::string target(request.target());
  if (!is_ours()) return reply(http::status::forbidden, "text/plain", "This server answers its own page only.\n");
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    return reply(http::status::method_not_allowed, "text/plain", "expected GET\n");
  if (has_body) return reply(http::status::bad_request, "text/plain", "expected no body\n");
  if (target == "/socket") {
    if (!websocket::is_upgrade(request))
      return reply(http::status::upgrade_required, "text/plain", "expected a WebSocket\n");
    return open_socket();
  }
  for (const Page& page : hub_.settings.pages)
    if (page.path == target) return reply(http::status::ok, page.type, page.text);
  reply(http::status::not_found, "text/plain", "There is no such page.\n");
}

void Connection::reply(http::status status, const std::string& type, const std::string& text) {
  const auto& request = request_->get();
  const bool keep = request.keep_alive() && status == http::status::ok;
  response_ = http::response<http::string_body>(status, request.version());
  response_.set(http::field::content_type, type);
  secure(response_, std::string(request[http::field::host]));
  response_.body() = text;
  response_.keep_alive(keep);
  response_.prepare_payload();
  if (request.method() == http::verb::head) response_.body().clear();
  http::async_write(socket_.next_layer(), response_,
                    [self = shared_from_this(), keep](beast::error_code error, std::size_t) {
                      if (self->closed_) return;
                      if (error || !keep) return self->close();
                      self->read_request();
                    });
}

void Connection::open_socket() {
  is_socket_ = true, since_ = Clock::now();
  socket_.next_layer().expires_never();
  websocket::stream_base::timeout timeouts{ms(hub_.settings.hello_s), std::chrono::seconds(20), true};
  socket_.set_option(timeouts);
  socket_.read_message_max(hub_.settings.message_bytes);
  socket_.async_accept(request_->get(), [self = shared_from_this()](beast::error_code error) {
    if (self->closed_) return;
    if (error) return self->close();
    self->buffer_.consume(self->buffer_.size());
    self->read_message();
  });
}

void Connection::read_message() {
  socket_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) { self->hear(error); });
}

bool Connection::too_many() {
  const auto now = Clock::now();
  const ServerSettings& limits = hub_.settings;
  allowed_ = std::min(limits.burst, allowed_ + limits.messages_per_s * duration<double>(now - allowed_at_).count());
  allowed_at_ = now;
  return (allowed_ -= 1) < 0;
}

std::size_t Connection::viewers() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      hub_.connections, [](const auto& other) { return other->is_in() && !other->is_trainer(); }));
}

bool Connection::let_in(const std::string& text) {
  const auto message = nlohmann::json::parse(text, nullptr, false);
  if (!message.is_object() || message.value("do", nlohmann::json()) != "hello") return false;
  const auto token = message.find("token");
  if (token == message.end() || !token->is_string()) return false;
  const std::string given = token->get<std::string>();
  if (same_token(given, hub_.settings.trainer_token))
    role_ = Role::trainer;
  else if (same_token(given, hub_.settings.viewer_token) && viewers() < hub_.settings.most_viewers)
    role_ = Role::viewer;
  else
    return false;
  // One trainer: whoever comes later with the token is the same one, whose browser was killed.
  if (is_trainer())
    for (const auto& other : std::vector(hub_.connections.begin(), hub_.connections.end()))
      if (other.get() != this && other->is_trainer()) other->close();
  greet();
  for (std::size_t i = 0; i < hub_.newest.size(); ++i)
    if (hub_.newest[i]) send(static_cast<Channel>(i + 1), hub_.newest[i]);
  return true;
}

void Connection::greet() {
  if (!role_ || closed_) return;
  newest_ = {};
  for (std::string& greeting : hub_.listener.greet(*role_))
    send(Channel::all, std::make_shared<const Message>(Message{std::move(greeting), false}));
}

void Connection::hear(beast::error_code error) {
  if (closed_) return;
  if (error || too_many() || !socket_.got_text()) return close();
  const std::string text = beast::buffers_to_string(buffer_.data());
  buffer_.consume(buffer_.size());
  if (!role_) {
    if (!let_in(text)) return close();
  } else {
    heard_at_ = Clock::now(), quiet_ = false;
    if (std::string answer = hub_.listener.hear(*role_, text); !answer.empty())
      send(Channel::all, std::make_shared<const Message>(Message{std::move(answer), false}));
  }
  if (!closed_) read_message();
}

void Connection::send(Channel channel, const SharedMessage& message) {
  if (!role_ || closed_) return;
  if (channel == Channel::all) {
    if (waiting_.size() >= hub_.settings.most_waiting) return close();
    waiting_.push_back(message);
  } else {
    newest_[static_cast<std::size_t>(channel) - 1] = message;
  }
  if (!writing_) write_next();
}

/// All that must not be missed first, then the channels in turn.
void Connection::write_next() {
  if (!waiting_.empty()) {
    writing_ = waiting_.front();
    waiting_.pop_front();
  } else {
    for (std::size_t k = 0; k < newest_.size() && !writing_; ++k) {
      SharedMessage& next = newest_[(next_channel_ + k) % newest_.size()];
      if (!next) continue;
      writing_.swap(next);
      next_channel_ = (next_channel_ + k + 1) % newest_.size();
    }
  }
  if (!writing_) return;
  writing_since_ = Clock::now();
  socket_.binary(writing_->binary);
  socket_.async_write(asio::buffer(writing_->bytes), [self = shared_from_this()](beast::error_code error, std::size_t) {
    if (self->closed_) return;
    self->writing_.reset();
    if (error) return self->close();
    self->write_next();
  });
}

}  // namespace ostium::app
