#include "app/serve/workbench/workbench.h"

#include <fmt/format.h>

#include <chrono>
#include <stdexcept>
#include <utility>

#include "app/serve/messages/messages.h"
#include "app/serve/page/page_files.h"
#include "app/serve/station/station.h"
#include "app/serve/workbench/draft_messages.h"
#include "core/base/units.h"
#include "data/formats/json/json_value.h"
#include "vascular/anatomy/editing/edit_anatomy.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::app {

using Json = data::CaseDraft::Json;
using units::mm;

namespace {

constexpr std::size_t most_orders = 200;  ///< that wait

double number(const Json& order, const char* key) {
  if (!order.contains(key) || !order[key].is_number())
    throw std::invalid_argument(fmt::format("{} is missing; expected a number", key));
  return order[key].get<double>();
}

int index(const Json& order, const char* key) {
  if (!order.contains(key) || !order[key].is_number_integer() || order[key] < 0 || order[key] > 1'000'000)
    throw std::invalid_argument(fmt::format("{} is missing; expected a whole number, 0 or more", key));
  return order[key].get<int>();
}

std::string text(const Json& order, const char* key) {
  if (!order.contains(key) || !order[key].is_string())
    throw std::invalid_argument(fmt::format("{} is missing; expected a text", key));
  return order[key].get<std::string>();
}

/// In m.
Eigen::Vector3d point(const Json& order) {
  const Json p = order.contains("p_mm") ? order["p_mm"] : Json();
  if (!p.is_array() || p.size() != 3 || !p[0].is_number() || !p[1].is_number() || !p[2].is_number())
    throw std::invalid_argument("p_mm is missing; expected three numbers");
  return mm * Eigen::Vector3d(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
}

Json object(const Json& order, const char* key) {
  if (!order.contains(key) || !order[key].is_object())
    throw std::invalid_argument(fmt::format("{} is missing; expected an object", key));
  return order[key];
}

/// A reader's message without the place in a file that nobody has seen yet.
std::string without_place(const std::string& why, const std::string& file) {
  const std::size_t end = why.starts_with(file + ":") ? why.find(": ", file.size()) : std::string::npos;
  return end == std::string::npos ? why : why.substr(end + 2);
}

/// Members of the case's file that a person may set, and how undo calls it.
std::string step_of(const std::string& key) {
  static const std::map<std::string, std::string> known = {{"title", "change the title"},
                                                           {"card.history", "change the history"},
                                                           {"card.ecg", "change the ECG"},
                                                           {"card.planned_access", "change the planned access"},
                                                           {"views", "change the views"},
                                                           {"heart_rate_1_min", "change the heart rate"},
                                                           {"anatomy.seed", "take another person"},
                                                           {"anatomy.access", "change the access"},
                                                           {"anatomy.dominance", "change the dominance"}};
  const auto at = known.find(key);
  if (at == known.end()) throw std::invalid_argument("there is no \"" + key.substr(0, 60) + "\" to be set");
  return at->second;
}

}  // namespace

Workbench::Workbench(data::CaseDraft draft, WorkbenchOwner owner, const std::string& address, std::uint16_t port)
    : draft_(std::move(draft)),
      owner_(std::move(owner)),
      address_(address),
      token_(make_token()),
      viewer_token_(make_token()) {
  if (draft_.imported()) gauge_.emplace(healthy_.emplace(draft_.now().imported->lumen));
  tell_draft();
  ServerSettings settings;
  settings.address = address, settings.port = port;
  settings.trainer_token = token_, settings.viewer_token = viewer_token_;
  settings.pages = workbench_files();
  server_ = std::make_unique<Server>(std::move(settings), *this);
}

std::string Workbench::link() const { return page_link(address_, server_->port(), token_); }
std::string Workbench::viewer_link() const { return page_link(address_, server_->port(), viewer_token_); }

bool Workbench::work(const std::atomic<bool>& stop) {
  while (!stop && !closed_) {
    const std::optional<std::string> order = next(stop);
    if (!order) {
      tell_wall();
      continue;
    }
    std::string what = "?";
    try {
      const Json json = Json::parse(*order);
      what = json["do"].get<std::string>();
      const int before = draft_.revision();
      obey(json);
      if (draft_.revision() != before || what == "save" || what == "save_as") tell_draft();
    } catch (const std::exception& error) {
      tell_refused(what, without_place(error.what(), draft_.file()));
    }
  }
  return draft_.changed() && !given_up_;
}

/// The next order; none, where none waits and the wall that was told is not the draft's.
std::optional<std::string> Workbench::next(const std::atomic<bool>& stop) {
  std::unique_lock lock(mutex_);
  while (orders_.empty() && !stop && wall_of_ == draft_.revision())
    asked_.wait_for(lock, std::chrono::milliseconds(100));
  if (orders_.empty()) return {};
  std::string order = std::move(orders_.front());
  orders_.pop_front();
  return order;
}

void Workbench::obey(const Json& order) {
  const std::string what = order["do"].get<std::string>();
  if (change_case(what, order) || change_course(what, order)) return;
  if (what == "undo") return draft_.undo();
  if (what == "redo") return draft_.redo();
  if (what == "save") return owner_.save(draft_);
  if (what == "save_as") return owner_.save_as(draft_, text(order, "name"));
  if (what == "close") {
    closed_ = true, given_up_ = order.contains("unsaved");
    return tell({{"type", "closed"}});
  }
  if (what == "try") {
    tell({{"type", "busy"}, {"words", "a session on it is being made ready"}});
    return tell({{"type", "session"}, {"link", owner_.try_it(draft_)}});
  }
  if (what == "xray") {
    tell({{"type", "busy"}, {"words", "the X-ray picture is being taken"}});
    const double lao_deg = number(order, "lao_deg"), cran_deg = number(order, "cran_deg");
    const std::string side = text(order, "fill");
    const Fill fill = side == "left" ? Fill::left : side == "right" ? Fill::right : Fill::none;
    server_->send(
        Channel::reference,
        {xray_bytes(lao_deg, cran_deg, picture_.frame(draft_, fill, lao_deg * units::degree, cran_deg * units::degree)),
         true});
    return tell({{"type", "idle"}});
  }
  throw std::invalid_argument("there is no such order");
}

/// Whether the order was one about the case's file.
bool Workbench::change_case(const std::string& what, const Json& order) {
  if (what == "set") {
    const std::string key = text(order, "key");
    draft_.set(step_of(key), key, order.contains("value") ? order["value"] : Json());
  } else if (what == "lesion_add") {
    draft_.add_lesion(object(order, "lesion"));
  } else if (what == "lesion_change") {
    draft_.change_lesion(static_cast<std::size_t>(index(order, "lesion_number")), object(order, "lesion"));
  } else if (what == "lesion_remove") {
    draft_.remove_lesion(static_cast<std::size_t>(index(order, "lesion_number")));
  } else {
    return false;
  }
  return true;
}

/// Whether the order was one about names and courses of an imported case's vessels.
bool Workbench::change_course(const std::string& what, const Json& order) {
  using vascular::Anatomy;
  const auto edit = [&](const std::string& step, auto change, const std::pair<std::string, std::string>& names = {}) {
    draft_.edit_anatomy(
        step, [&](Anatomy anatomy) { return change(std::move(anatomy)); }, names);
    return true;
  };
  if (what == "rename") {
    const std::string found = text(order, "branch"), wanted = text(order, "name");
    return edit("rename " + found, [&](Anatomy a) { return with_name(std::move(a), found, wanted); }, {found, wanted});
  }
  if (what == "split")
    return edit("divide " + text(order, "branch"), [&](Anatomy a) {
      return with_split_branch(std::move(a), text(order, "branch"), mm * number(order, "mm"), text(order, "name"));
    });
  if (what == "entry") return edit("set the entry", [&](Anatomy a) { return with_entry(std::move(a), point(order)); });
  if (what == "move")
    return edit("move a sphere", [&](Anatomy a) {
      return with_moved_node(std::move(a), *gauge_, index(order, "vessel"),
                             static_cast<std::size_t>(index(order, "sphere")), point(order),
                             mm * number(order, "reach_mm"));
    });
  if (what == "centre")
    return edit("centre a course", [&](Anatomy a) {
      return with_centred_course(std::move(a), *gauge_, index(order, "vessel"), mm * number(order, "from_mm"),
                                 mm * number(order, "to_mm"));
    });
  if (what == "end")
    return edit("cut a vessel short",
                [&](Anatomy a) { return with_end(std::move(a), index(order, "vessel"), mm * number(order, "mm")); });
  if (what == "remove")
    return edit("remove a vessel", [&](Anatomy a) { return without_tube(std::move(a), index(order, "vessel")); });
  if (what == "join")
    return edit("join a vessel", [&](Anatomy a) {
      return with_joined_tube(std::move(a), *gauge_, index(order, "vessel"), index(order, "to"));
    });
  if (what == "add") {
    tell({{"type", "busy"}, {"words", "the way there is being looked for"}});
    return edit("add a vessel",
                [&](Anatomy a) { return with_vessel(std::move(a), *healthy_, point(order), text(order, "name")); });
  }
  return false;
}

void Workbench::tell_draft() {
  std::vector<vascular::CourseFault> faults;
  if (gauge_) faults = check_courses(draft_.now().imported->anatomy, *gauge_);
  std::string message = draft_message(draft_, faults, owner_.mends(draft_.file()));
  const std::lock_guard lock(mutex_);
  told_ = message;
  if (server_) server_->send(Channel::all, {std::move(message), false});
}

void Workbench::tell_wall() {
  wall_of_ = draft_.revision();
  try {
    server_->send(Channel::truth, {wall_bytes(picture_.wall(draft_)), true});
    tell({{"type", "idle"}});
  } catch (const std::exception& error) {
    tell_refused("wall", without_place(error.what(), draft_.file()));
  }
}

void Workbench::tell(const Json& message) {
  server_->send(Channel::all, {message.dump(-1, ' ', false, Json::error_handler_t::replace), false});
}

void Workbench::tell_refused(const std::string& what, const std::string& why) {
  server_->send(Channel::all, {refusal(what, why), false});
}

std::vector<std::string> Workbench::greet(Role role) {
  const std::lock_guard lock(mutex_);
  return {Json({{"type", "role"}, {"role", role == Role::trainer ? "editor" : "viewer"}}).dump(), told_};
}

std::string Workbench::hear(Role role, const std::string& text) {
  std::string what = "?";
  try {
    const data::JsonValue message = data::parse_json("message", text);  // which has limits
    if (const data::JsonValue* name = message.find("do")) what = name->text.substr(0, 40);
  } catch (const data::LoadError& error) {
    return refusal(what, error.what());
  }
  if (what == "here") return "";
  if (role != Role::trainer) return refusal(what, "viewers look on");
  const std::lock_guard lock(mutex_);
  if (orders_.size() >= most_orders) return refusal(what, "too much is waiting; try again");
  orders_.push_back(text);
  asked_.notify_all();
  return "";
}

}  // namespace ostium::app
