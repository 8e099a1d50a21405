#include "app/serve/station/station.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "app/serve/messages/words.h"
#include "app/serve/page/page_files.h"
#include "core/base/thread_priority.h"
#include "data/console/console_order.h"
#include "data/formats/load_error.h"
#include "data/formats/write_file.h"

namespace ostium::app {

namespace {

using Json = nlohmann::ordered_json;
using namespace std::chrono_literals;
constexpr std::size_t longest_note = 500, most_notes = 500;

/// Whether a moment says how well it goes.
bool judges(const TimelineEntry& moment) { return moment.kind == "error" || moment.kind == "critical"; }

/// Events alone; what needs signals is told at the end.
data::RunRecord record_of_events(const std::vector<SessionEvent>& events, double step_s) {
  data::RunRecord record{
      .step_s = step_s, .steps = 0, .signal_columns = {}, .signals = {}, .events = {}, .branches = {}};
  for (const SessionEvent& e : events) {
    record.events.insert(record.events.end(), {static_cast<double>(e.step), static_cast<double>(e.code),
                                               static_cast<double>(e.tool), e.value});
    record.steps = std::max<std::uint64_t>(record.steps, e.step);
  }
  return record;
}

}  // namespace

Station::Station(const ScriptedRun& run, LiveDriver& hand, data::ScoreList scoring, const StationSettings& settings)
    : run_(run),
      hand_(hand),
      settings_(settings),
      setting_(run.model, run.plan, std::move(scoring)),
      trainer_token_(make_token()),
      viewer_token_(settings.server ? settings.viewer_token : make_token()),
      server_(settings.server) {
  setting_.lesson = settings.lesson;
  hands_ = static_cast<int>(hand.began_as());  // until a snapshot says more: keys may come before
  hand_.show_to(Seat::browser);
  if (!server_) {
    ServerSettings server;
    server.address = settings.address, server.port = settings.port;
    server.trainer_token = trainer_token_, server.viewer_token = viewer_token_;
    server.pages = page_files();
    own_server_ = std::make_unique<Server>(std::move(server), *this);
    server_ = own_server_.get();
  }
  thread_ = std::thread([this] { follow(); });
}

Station::~Station() {
  over_ = true;
  thread_.join();
  own_server_.reset();
}

std::string page_link(const std::string& address, std::uint16_t port, const std::string& token) {
  const bool six = address.find(':') != std::string::npos;
  return fmt::format("http://{}:{}/#token={}", six ? "[" + address + "]" : address, port, token);
}
std::string Station::trainer_link() const { return page_link(settings_.address, port(), trainer_token_); }
std::string Station::viewer_link() const { return page_link(settings_.address, port(), viewer_token_); }

std::function<void(const SessionEvent&)> Station::ear() {
  return [this](const SessionEvent& event) { heard_.put(event); };
}

/// Draws and tells, as fast as snapshots come; nobody waits for it.
void Station::follow() {
  core::give_way_to_steps();
  LivePicture live(run_.model, {nullptr, settings_.has_pedals, settings_.pixels, settings_.renderer});
  drawing_.set_value();
  core::TripleBuffer<Snapshot>& latest = hand_.snapshots(Seat::browser);
  double told_s = -1, truth_s = -1;
  int references = 0, begun = 0;
  auto told_at = std::chrono::steady_clock::now();
  while (!over_) {
    take_events();
    if (notes_are_new_) keep_notes_or_tell();
    const bool fresh = latest.update();
    const auto clock = std::chrono::steady_clock::now();
    if (!fresh) {
      std::this_thread::sleep_for(2ms);
      continue;
    }
    const Snapshot& now = latest.front();
    const double second = seconds(run_.model, now.state);
    hands_ = static_cast<int>(now.hands);
    now_s_ = second, furthest_s_ = std::max(furthest_s_.load(), second);
    if (now.begun != begun) begun = now.begun, truth_s = told_s = -1;
    const bool paused_again = now.paused && clock - told_at < 100ms;
    if (!paused_again && live.look(now, fresh) && !live.picture().grey.empty())
      server_->send(Channel::frame, {picture_bytes(1, second, live.picture()), true});
    if (const fluoro::Picture* reference = live.reference().picture();
        reference && live.reference().changes() != references) {
      references = live.reference().changes();
      server_->send(Channel::reference, {picture_bytes(2, second, *reference), true});
    }
    if (paused_again || (!now.paused && second < told_s + 0.06)) continue;
    told_s = second, told_at = clock;
    server_->send(Channel::now, {message_of(setting_, now, live), false});
    if (!setting_.lesson.exam && (now.paused || second >= truth_s + 0.095))
      truth_s = second, server_->send(Channel::truth, {truth_bytes(setting_, now), true});
  }
}

/// With the mutex. What the timeline gets of it.
std::optional<TimelineEntry> Station::take_event(const SessionEvent& event) {
  events_.push_back(event);
  TimelineEntry moment{static_cast<int>(moments_.size()) + 1, static_cast<double>(event.step) * run_.model.step_s(),
                       kind_of(event), words_of(event, run_.model, run_.plan)};
  if (moment.kind == "mark" && !unplaced_notes_.empty()) {
    notes_.push_back({recording_, moment.second, unplaced_notes_.front()});
    moment.words = "mark: " + unplaced_notes_.front();
    unplaced_notes_.erase(unplaced_notes_.begin());
    notes_are_new_ = true;
  }
  if (moment.words.empty() || (setting_.lesson.exam && judges(moment))) return {};
  moments_.push_back(moment);
  return moment;
}

void Station::take_events() {
  std::vector<TimelineEntry> fresh;
  bool ticked = false;
  {
    const std::lock_guard lock(mutex_);
    bool changed = false;
    while (const std::optional<SessionEvent> event = heard_.next()) {
      changed = true;
      ticked |= event->code == static_cast<int>(data::EventCode::instruction_done);
      if (const auto moment = take_event(*event)) fresh.push_back(*moment);
    }
    if (!changed) return;
  }
  if (!fresh.empty()) server_->send(Channel::all, {message_of(fresh), false});
  if (ticked) tell_ticks();
  tell_scores();
}

void Station::recall(const std::vector<SessionEvent>& events, const std::string& recording) {
  std::vector<Note> notes = read_notes(settings_.folder);
  const std::lock_guard lock(mutex_);
  for (const SessionEvent& event : events) take_event(event);
  for (TimelineEntry& moment : moments_)
    for (const Note& note : notes)
      if (moment.kind == "mark" && moment.second == note.second) moment.words = "mark: " + note.text;
  notes_ = std::move(notes), recording_ = recording;
}

/// With the mutex.
std::vector<std::optional<double>> Station::ticks() const {
  std::vector<std::optional<double>> at(setting_.lesson.instructions.size());
  for (const SessionEvent& event : events_)
    if (event.code == static_cast<int>(data::EventCode::instruction_done) && event.value >= 0 &&
        event.value < static_cast<double>(at.size()))
      at[static_cast<std::size_t>(event.value)] = static_cast<double>(event.step) * run_.model.step_s();
  return at;
}

void Station::tell_ticks() {
  const std::lock_guard lock(mutex_);
  server_->send(Channel::all, {ticks_message(ticks()), false});
}

void Station::tell_scores() {
  if (setting_.lesson.exam) return;
  std::vector<SessionEvent> events;
  {
    const std::lock_guard lock(mutex_);
    if (has_ended_) return;
    events = events_;
  }
  const auto scores = score(setting_.scoring, record_of_events(events, run_.model.step_s()), {});
  std::string message = scores_message(setting_.scoring, scores);
  const std::lock_guard lock(mutex_);  // the final ones may have been told meanwhile, and are the last
  if (!has_ended_) server_->send(Channel::all, {std::move(message), false});
}

Wish Station::wish() {
  const std::lock_guard lock(mutex_);
  return std::exchange(wish_, Wish{});
}

Wish Station::wait(const std::atomic<bool>& stop) {
  std::unique_lock lock(mutex_);
  while (wish_.kind == Wish::Kind::none && !stop) asked_.wait_for(lock, 100ms);
  return std::exchange(wish_, Wish{});
}

void Station::gone_back(std::size_t second, const std::string& recording) {
  const std::string message = Json({{"type", "branch"}, {"from_s", second}, {"recording", recording}})
                                  .dump(-1, ' ', false, Json::error_handler_t::replace);
  take_events();
  {
    const std::lock_guard lock(mutex_);
    const double limit = static_cast<double>(second);
    std::erase_if(events_, [&](const SessionEvent& e) {
      return static_cast<double>(e.step) * run_.model.step_s() > limit + 1e-9;
    });
    // Numbers go on, so that nothing is taken for something told before.
    for (TimelineEntry& moment : moments_)
      if (moment.second > limit) moment.words.clear();
    for (const std::string& text : unplaced_notes_) notes_.push_back({recording_, furthest_s_, text});
    unplaced_notes_.clear();
    recording_ = recording, furthest_s_ = limit;
    has_ended_ = false, end_.clear(), report_.clear();
    sticky_.push_back(message);
  }
  server_->send(Channel::all, {message, false});
  tell_ticks();
  tell_scores();
}

void Station::ended(const PlayReport& report, const std::vector<data::Score>& scores) {
  take_events();
  Json metrics = Json::array();
  for (const data::Metric& m : report.metrics)
    if (const std::string words = value_text(m); !words.empty() && !setting_.lesson.exam)
      metrics.push_back({{"name", m.name}, {"words", words}});
  const std::string end =
      Json({{"type", "ended"}, {"outcome", report.outcome}, {"reason", report.reason}, {"metrics", metrics}}).dump();
  const std::string last = scores_message(setting_.scoring, scores);
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  end_ = end, final_scores_ = last;
  server_->send(Channel::all, {end, false});
  if (!setting_.lesson.exam) server_->send(Channel::all, {last, false});
}

void Station::reported(const std::string& html) {
  {
    const std::lock_guard lock(mutex_);
    report_ = html;
  }
  server_->send(Channel::all, {R"({"type":"reported"})", false});
}

void Station::tell_problem(const std::string& what) { server_->send(Channel::all, {refusal("run", what), false}); }

std::vector<Note> Station::notes() {
  take_events();
  const std::lock_guard lock(mutex_);
  std::vector<Note> all = notes_;
  for (const std::string& text : unplaced_notes_) all.push_back({recording_, now_s_, text});  // while time stood
  return all;
}

void Station::keep_notes() {
  const std::lock_guard keeping(keeping_);
  notes_are_new_ = false;
  if (!settings_.folder.empty()) write_notes(settings_.folder, notes());
}

/// While the run is on; what fails now is tried again at its end.
void Station::keep_notes_or_tell() {
  try {
    keep_notes();
  } catch (const data::WriteError& error) {
    tell_problem(error.what());
  }
}

std::vector<std::string> Station::greet(Role role) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> out = {
      welcome(setting_, role, role == Role::trainer ? "#token=" + viewer_token_ : "", settings_.goes_back)};
  out.insert(out.end(), sticky_.begin(), sticky_.end());
  std::vector<TimelineEntry> told;
  for (const TimelineEntry& moment : moments_)
    if (!moment.words.empty()) told.push_back(moment);
  out.push_back(message_of(told));
  if (!setting_.lesson.instructions.empty()) out.push_back(ticks_message(ticks()));
  if (!end_.empty()) out.push_back(end_);
  if (setting_.lesson.exam) return out;
  out.push_back(has_ended_
                    ? final_scores_
                    : scores_message(setting_.scoring,
                                     score(setting_.scoring, record_of_events(events_, run_.model.step_s()), {})));
  if (!report_.empty()) out.emplace_back(R"({"type":"reported"})");
  return out;
}

void Station::lost_trainer() { hand_.controls(Seat::browser).let_all_go(); }

std::string Station::ask_to_go_back(const data::JsonValue& message) {
  const data::JsonValue* values = message.find("values");
  const bool one = values && values->items.size() == 1 && values->items[0].type == data::JsonValue::Type::number;
  const double second = one ? values->items[0].number : -1;
  if (!settings_.goes_back) return refusal("rewind", "this run cannot go back; `ostium serve` can");
  if (!(second >= 0 && second <= std::floor(now_s_)))
    return refusal("rewind", fmt::format("expected a second from 0 to {:.0f}", std::floor(now_s_)));
  {
    const std::lock_guard lock(mutex_);
    wish_ = {Wish::Kind::go_back, static_cast<std::size_t>(second)};
  }
  asked_.notify_all();
  hand_.controls(Seat::browser).order(ConsoleCommand::end);
  return "";
}

void Station::leave() {
  {
    const std::lock_guard lock(mutex_);
    wish_ = {Wish::Kind::leave, 0};
  }
  asked_.notify_all();
  hand_.controls(Seat::browser).order(ConsoleCommand::end);
}

/// How the expert does the first instruction that is not done; asked again, the expert's step after it.
std::string Station::hint() {
  const std::lock_guard lock(mutex_);
  if (has_ended_) return refusal("hint", "the run has ended");
  const auto done = ticks();
  const auto& all = setting_.lesson.instructions;
  std::size_t at = 0;
  while (at < all.size() && (all[at].hints.empty() || done[at])) ++at;
  if (at == all.size()) return refusal("hint", "there is no hint on what is left to do");
  if (const int on = static_cast<int>(at); on != hint_on_) hint_on_ = on, hints_told_ = 0;
  const std::vector<std::string>& hints = all[at].hints;
  const std::size_t which = std::min(hints_told_++, hints.size() - 1);
  hand_.hinted(hint_on_);
  return Json({{"type", "hint"}, {"instruction", at}, {"words", hints[which]}, {"more", which + 1 < hints.size()}})
      .dump();
}

std::string Station::obey(const std::string& what, const data::JsonValue& message) {
  Controls& controls = hand_.controls(Seat::browser);
  if (what == "rewind") return ask_to_go_back(message);
  if (what == "hint") return hint();
  if (what == "mark") {
    const data::JsonValue* text = message.find("text");
    const std::lock_guard lock(mutex_);
    const bool is_text = !text || text->type == data::JsonValue::Type::text;
    if (!is_text || message.members.size() > (text ? 2 : 1) || (text && text->text.size() > longest_note))
      return refusal(what, "expected {\"do\": \"mark\"}, with a \"text\" of at most 500 bytes");
    if (notes_.size() + unplaced_notes_.size() >= most_notes) return refusal(what, "there are 500 notes already");
    if (text && !text->text.empty()) unplaced_notes_.push_back(text->text), notes_are_new_ = true;
    controls.order(ConsoleCommand::mark);
    return "";
  }
  const ConsoleOrder order = data::read_console_order(message);
  const data::ConsoleRow& row = data::row_of(order.command);
  const auto hands = static_cast<Hands>(hands_.load());
  if (row.needs == data::ConsoleNeeds::hands && hands == Hands::script && order.values[0] != 0)
    return refusal(what, "the script has the instruments; take over first");
  if (const std::string why = why_not(run_.model, order); !why.empty()) return refusal(what, why);
  if (order.command == ConsoleCommand::end) {
    const std::lock_guard lock(mutex_);
    wish_ = {has_ended_ ? Wish::Kind::leave : Wish::Kind::none, 0};
    asked_.notify_all();
  }
  controls.order(order);
  return "";
}

std::string Station::hear(Role role, const std::string& text) {
  std::string what = "?";
  try {
    const data::JsonValue message = data::parse_json("message", text);
    const data::JsonValue* name = message.find("do");
    if (!name || name->text.empty()) return refusal(what, "expected {\"do\": ...}");
    what = name->text.substr(0, 40);
    if (what == "here") return "";
    if (what == "report") {
      const std::lock_guard lock(mutex_);
      return report_.empty() ? refusal(what, "there is none yet")
                             : Json({{"type", "report"}, {"html", report_}}).dump();
    }
    if (role != Role::trainer) return refusal(what, "viewers look on; the trainer's link has the console");
    return obey(what, message);
  } catch (const data::LoadError& error) {
    return refusal(what, error.what());
  }
}

}  // namespace ostium::app
