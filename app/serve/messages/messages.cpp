#include "app/serve/messages/messages.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "app/serve/messages/jpeg.h"
#include "core/base/units.h"
#include "core/rod/introducer.h"
#include "data/console/console_keys.h"
#include "fluoro/projection/views.h"

namespace ostium::app {

namespace {

using Json = nlohmann::ordered_json;
using units::degree;

/// JSON has no word for what is no number.
Json number(double value, double to = 1e-3) {
  return std::isfinite(value) ? Json(std::round(value / to) * to) : Json(nullptr);
}

/// Samples as whole numbers of `unit`; null: no trace.
Json trace_of(const std::vector<float>& samples, double unit) {
  Json out = Json::array();
  for (const float one : samples)
    out.push_back(std::isfinite(one) ? Json(std::lround(static_cast<double>(one) / unit)) : Json(nullptr));
  return out;
}

const char* word(Hands hands) { return hands == Hands::script ? "script" : hands == Hands::box ? "box" : "seats"; }
const char* word(data::ConsoleNeeds needs) {
  return needs == data::ConsoleNeeds::hands ? "hands" : needs == data::ConsoleNeeds::console ? "console" : "nothing";
}

/// Along each branch not closer than its spheres are wide, nor than 1.5 mm.
std::vector<int> drawn_spheres(const SessionModel& model) {
  std::vector<int> out;
  int first = 0;
  for (const vascular::TreeBranch& branch : model.vessel->way->branches()) {
    double last_m = -1;
    for (std::size_t i = 0; i < branch.spheres.size(); ++i) {
      const vascular::TreeSphere& sphere = branch.spheres[i];
      const bool end = i + 1 == branch.spheres.size();
      if (last_m >= 0 && !end && sphere.s_m - last_m < std::max(1.5e-3, 0.6 * sphere.radius_m)) continue;
      last_m = sphere.s_m;
      out.push_back(first + static_cast<int>(i));
    }
    first += static_cast<int>(branch.spheres.size());
  }
  return out;
}

Json tree_of(const Setting& setting) {
  const auto& branches = setting.model.vessel->way->branches();
  Json out = Json::array();
  std::size_t at = 0;
  int first = 0;
  for (const vascular::TreeBranch& branch : branches) {
    const int end = first + static_cast<int>(branch.spheres.size());
    Json radii = Json::array(), places = Json::array();
    for (; at < setting.spheres.size() && setting.spheres[at] < end; ++at) {
      const vascular::TreeSphere& sphere = branch.spheres[static_cast<std::size_t>(setting.spheres[at] - first)];
      radii.push_back(number(1e3 * sphere.radius_m, 0.01)), places.push_back(number(1e3 * sphere.s_m, 0.1));
    }
    out.push_back({{"name", branch.name}, {"parent", branch.parent}, {"radius_mm", radii}, {"s_mm", places}});
    first = end;
  }
  return out;
}

Json console_table() {
  Json rows = Json::array(), keys = Json::array();
  for (const data::ConsoleRow& row : data::console_rows)
    rows.push_back({{"do", row.name},
                    {"held", row.held},
                    {"needs", word(row.needs)},
                    {"patient", row.patient},
                    {"what", row.what}});
  for (const data::ConsoleKey& key : data::console_keys) {
    const data::ConsoleRow& row = data::row_of(key.order.command);
    keys.push_back({{"key", key.key},
                    {"ctrl", key.ctrl},
                    {"do", row.name},
                    {"values", std::vector<double>(key.order.values.begin(), key.order.values.begin() + row.count())}});
  }
  return {{"rows", rows}, {"keys", keys}};
}

/// What can be given and provoked, and where: arteries with their length, lesions as a place in one.
Json emergency_of(const SessionModel& model) {
  Json arteries = Json::array(), lesions = Json::array(), drugs = Json::array();
  const vascular::FlowTree& tree = model.vessel->coronaries->tree();
  for (const vascular::FlowBranch& branch : tree.branches)
    arteries.push_back({{"name", branch.name},
                        {"tree_branch", branch.tree_branch},
                        {"from_mm", number(1e3 * tree.s_of(branch.first), 0.1)},
                        {"to_mm", number(1e3 * tree.s_of(branch.last - 1), 0.1)}});
  for (const Plan& plan : model.vessel->coronaries->lesions)
    lesions.push_back({{"artery", tree.branch(plan.lesion.branch)},
                       {"mm", number(1e3 * (plan.lesion.from_m + plan.lesion.length_m / 2), 0.1)}});
  for (const vascular::Drug& drug : model.treatment.drugs.others)
    drugs.push_back(
        {{"name", drug.name}, {"title", drug.title}, {"unit", drug.unit}, {"least", drug.least}, {"most", drug.most}});
  Json kinds = Json::array();
  for (const Provocable& one : provocables)
    kinds.push_back({{"what", static_cast<int>(one.kind)},
                     {"name", vascular::provocation_names[static_cast<int>(one.kind)]},
                     {"has_place", one.has_place},
                     {"size", one.size ? Json(one.size) : Json(nullptr)},
                     {"least", one.least},
                     {"most", one.most},
                     {"usual", one.usual}});
  return {{"arteries", arteries},
          {"lesions", lesions},
          {"drugs", drugs},
          {"provocables", kinds},
          {"breathes", model.breaths_1_min > 0}};
}

const char* kind_of(data::ScoreKind kind) {
  return kind == data::ScoreKind::step ? "step" : kind == data::ScoreKind::error ? "error" : "critical";
}

class Bytes {
 public:
  Bytes(int kind, double second) {
    bytes_.assign(16, '\0');
    bytes_[0] = static_cast<char>(kind);
    std::memcpy(bytes_.data() + 8, &second, sizeof second);
  }
  void put(std::uint32_t count) { raw(&count, sizeof count); }
  void put(const Eigen::Vector3d& p_m) {
    const Eigen::Vector3f mm = (1e3 * p_m).cast<float>();
    raw(mm.data(), 3 * sizeof(float));
  }
  void put(float value) { raw(&value, sizeof value); }
  void append(const std::string& more) { bytes_ += more; }
  std::string take() { return std::move(bytes_); }

 private:
  void raw(const void* from, std::size_t size) { bytes_.append(static_cast<const char*>(from), size); }
  std::string bytes_;
};

}  // namespace

Setting::Setting(const SessionModel& own_model, const ScriptPlan& own_plan, data::ScoreList list)
    : model(own_model),
      plan(own_plan),
      scoring(std::move(list)),
      signals(signal_names(own_model)),
      spheres(drawn_spheres(own_model)),
      title(own_model.vessel->name + ", " + own_plan.script.title) {}

std::string message_of(const std::vector<TimelineEntry>& moments) {
  Json all = Json::array();
  for (const TimelineEntry& m : moments)
    all.push_back({{"n", m.number}, {"s", number(m.second)}, {"kind", m.kind}, {"words", m.words}});
  return Json({{"type", "events"}, {"events", all}}).dump();
}

std::string ticks_message(const std::vector<std::optional<double>>& at_s) {
  Json at = Json::array();
  for (const auto& one : at_s) at.push_back(one ? number(*one, 0.1) : Json(nullptr));
  return Json({{"type", "ticks"}, {"at", at}}).dump();
}

std::string welcome(const Setting& setting, Role role, const std::string& viewer_link, bool goes_back) {
  const SessionModel& model = setting.model;
  Json tools = Json::array(), steps = Json::array(), views = Json::array(), items = Json::array(),
       instructions = Json::array();
  for (const SessionTool& tool : model.tools) tools.push_back({{"name", tool.name}, {"title", tool.instrument.title}});
  for (const data::ScriptStep& step : setting.plan.script.steps) steps.push_back(step.words());
  for (const fluoro::StandardView& view : fluoro::standard_views())
    views.push_back({{"name", view.name}, {"angles", fluoro::angles_text(view.lao_deg, view.cran_deg)}});
  for (const data::ScoreItem& item : setting.scoring.items)
    items.push_back({{"phase", item.phase}, {"kind", kind_of(item.kind)}, {"what", item.what}, {"when", item.when}});
  for (const LessonWords::Instruction& one : setting.lesson.instructions)
    instructions.push_back({{"text", one.text}, {"ticks", one.ticks}, {"hints", one.hints.size()}});
  const Json emergency = model.has_patient() ? emergency_of(model) : Json(nullptr);
  return Json({{"type", "welcome"},
               {"protocol", 1},
               {"role", role == Role::trainer ? "trainer" : "viewer"},
               {"viewer_link", viewer_link},
               {"title", setting.title},
               {"case", model.vessel->name},
               {"lesson",
                {{"title", setting.lesson.title},
                 {"goal", setting.lesson.goal},
                 {"instructions", instructions},
                 {"needed", setting.lesson.needed},
                 {"next", setting.lesson.next},
                 {"exam", setting.lesson.exam}}},
               {"goes_back", goes_back},
               {"has_patient", model.has_patient()},
               {"tools", tools},
               {"steps", steps},
               {"views", views},
               {"console", console_table()},
               {"emergency", emergency},
               {"tree", tree_of(setting)},
               {"scoring", {{"title", setting.scoring.title}, {"note", setting.scoring.note}, {"items", items}}}})
      .dump();
}

std::string message_of(const Setting& setting, const Snapshot& now, const LivePicture& live) {
  const auto signal = [&](const char* name) {
    const auto at = std::find(setting.signals.begin(), setting.signals.end(), name);
    return at == setting.signals.end()
               ? NAN
               : static_cast<double>(now.signals[static_cast<std::size_t>(at - setting.signals.begin())]);
  };
  Json tools = Json::array();
  for (std::size_t t = 0; t < now.tools.size(); ++t) {
    const ToolReport& tool = now.tools[t];
    tools.push_back({{"in", tool.in_body},
                     {"inserted_mm", number(1e3 * now.state.rods.rods[t].inserted_m, 0.1)},
                     {"turned_deg", number(now.state.hands[t].turned_rad / degree, 1)},
                     {"push_N", number(tool.push_N, 0.01)},
                     {"torque_mNm", number(1e3 * tool.torque_Nm, 0.01)},
                     {"wall_N", number(tool.wall_force_N, 0.01)},
                     {"tip_N", number(tool.tip_force_N, 0.001)}});
  }
  const CArmInputs& arm = now.inputs.c_arm;
  const PictureSettings& p = now.picture;
  Json out = {
      {"type", "now"},
      {"s", number(seconds(setting.model, now.state))},
      {"hands", word(now.hands)},
      {"paused", now.paused},
      {"late", now.overruns},
      {"step", now.script_step},
      {"right_hand", now.right_hand},
      {"reference", live.reference().picture() != nullptr},
      {"refused", now.refused},
      {"in_its_way", now.in_its_way},
      {"tools", tools},
      {"arm",
       {{"words", fluoro::angles_text(arm.lao_rad / degree, arm.cran_rad / degree)},
        {"lao", number(arm.lao_rad / degree, 0.1)},
        {"cran", number(arm.cran_rad / degree, 0.1)},
        {"field_mm", number(1e3 * arm.field_m, 1)},
        {"table_mm", {number(1e3 * arm.p_PI.x(), 1), number(1e3 * arm.p_PI.y(), 1), number(1e3 * arm.p_PI.z(), 1)}},
        {"fluoroscopy", arm.fluoroscopy},
        {"cine", arm.cine}}},
      {"xray",
       {{"fluoroscopy_s", number(now.state.c_arm.fluoroscopy_s, 0.1)},
        {"cine_s", number(now.state.c_arm.cine_s, 0.1)},
        {"runs", now.state.c_arm.cine_runs},
        {"dap_Gycm2", number(1e4 * live.dose().dose_area_Gy_m2, 0.01)}}},
      {"picture",
       {{"rate", p.frames_per_s},
        {"roadmap", p.roadmap},
        {"gamma", p.gamma},
        {"level", p.level},
        {"width", p.width},
        {"shutters", {p.shutters.left, p.shutters.right, p.shutters.top, p.shutters.bottom}},
        {"review", p.review},
        {"review_frame", live.review_frame()},
        {"review_frames", live.review_frames()}}}};
  if (setting.model.has_patient()) {
    out["patient"] = {{"rate", number(now.inputs.rate_1_min, 1)},
                      {"high_mmHg", number(now.guide_high_mmHg, 1)},
                      {"low_mmHg", number(now.guide_low_mmHg, 1)},
                      {"aorta_mmHg", number(signal("aorta_mmHg"), 1)},
                      {"trace", number(signal("trace"), 1)},
                      {"ST_mV", number(signal("ST_mV"), 0.01)},
                      {"act_s", number(signal("act_s"), 1)},
                      {"flow_share", number(signal("flow_share"), 0.01)},
                      {"hazard", number(signal("wire_hazard"))},
                      {"contrast_mL", number(signal("contrast_mL"), 0.1)},
                      {"gauge_atm", number(signal("gauge_atm"), 0.1)},
                      {"balloon_mm", number(signal("balloon_mm"), 0.01)},
                      {"second_gauge_atm", number(signal("second_gauge_atm"), 0.1)},
                      {"second_balloon_mm", number(signal("second_balloon_mm"), 0.01)},
                      {"lesion_mld_mm", number(signal("lesion_mld_mm"), 0.01)},
                      {"pericardium_mL", number(signal("pericardium_mL"), 1)},
                      {"pericardium_mmHg", number(signal("pericardium_mmHg"), 0.1)},
                      {"leak_mL_s", number(signal("leak_mL_s"), 0.01)},
                      {"rhythm", number(signal("rhythm"), 1)},
                      {"systolic_mmHg", number(signal("systolic_mmHg"), 1)},
                      {"awake", number(signal("awake"), 1)},
                      {"compressions_1_min", number(now.inputs.delivery.compressions_1_min, 1)},
                      {"pacing_mA", number(now.inputs.delivery.pacing_mA, 0.1)},
                      {"infusion_mL_min", number(now.inputs.delivery.infusion_m3_s / units::mL_min, 1)},
                      {"drain_mL_min", number(now.inputs.delivery.drain_m3_s / units::mL_min, 1)}};
    out["ecg_10uV"] = trace_of(now.ecg_mV, 0.01);
    out["line_mmHg"] = trace_of(now.line_mmHg, 1);
  }
  return out.dump();
}

std::string scores_message(const data::ScoreList& list, const std::vector<data::Score>& scores) {
  Json items = Json::array();
  for (std::size_t i = 0; i < scores.size() && i < list.items.size(); ++i) {
    Json at = Json::array();
    for (const double s : scores[i].at_s) at.push_back(number(s, 0.1));
    const auto holds = scores[i].holds;
    items.push_back({{"holds", holds == data::Ticked::yes  ? Json(true)
                               : holds == data::Ticked::no ? Json(false)
                                                           : Json()},
                     {"at_s", at},
                     {"value", scores[i].value}});
  }
  return Json({{"type", "scores"}, {"items", items}}).dump();
}

std::string refusal(const std::string& what, const std::string& why) {
  return Json({{"type", "refused"}, {"do", what}, {"why", why}})
      .dump(-1, ' ', false, Json::error_handler_t::replace);  // what a client has sent may be no UTF-8
}

std::string picture_bytes(int kind, double second, const fluoro::Picture& picture) {
  Bytes bytes(kind, second);
  bytes.append(jpeg_of(picture));
  return bytes.take();
}

std::string truth_bytes(const Setting& setting, const Snapshot& now) {
  const SessionModel& model = setting.model;
  Bytes bytes(3, seconds(model, now.state));
  bytes.put(static_cast<std::uint32_t>(model.tools.size()));
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const core::Rod& rod = model.rods.rods[t];
    const core::RodState& own = now.state.rods.rods[t];
    const int first = in_body(rod, own) ? own.first : rod.nodes();
    std::vector<float> force_N(static_cast<std::size_t>(rod.nodes()), 0);
    for (const core::Touch& touch : now.touches)
      if (touch.rod == static_cast<int>(t))
        force_N[static_cast<std::size_t>(touch.node)] += static_cast<float>(touch.normal_W_N.norm());
    bytes.put(static_cast<std::uint32_t>(rod.nodes() - first));
    for (int i = first; i < rod.nodes(); ++i) {
      bytes.put(Eigen::Vector3d(own.position[i]));
      bytes.put(force_N[static_cast<std::size_t>(i)]);
    }
  }
  bytes.put(static_cast<std::uint32_t>(setting.spheres.size()));
  for (const int sphere : setting.spheres) bytes.put(model.vessel->way->p(sphere, now.state.blood.heart.phase));
  return bytes.take();
}

}  // namespace ostium::app
