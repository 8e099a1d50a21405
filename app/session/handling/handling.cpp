#include "app/session/handling/handling.h"

namespace ostium {

namespace {

constexpr double pushed_m = 15e-3, gain_share = 0.2, push_rises_N = 0.2;
constexpr double idle_s = 3;

}  // namespace

void HandlingWatch::look_at_pushing(const SessionModel& model, const EventSink& say) {
  pushing_.resize(scene_.tools.size()), stuck_.resize(scene_.tools.size());
  for (std::size_t t = 0; t < scene_.tools.size(); ++t) {
    const HandledTool& tool = scene_.tools[t];
    const double along_m = tool.in_body ? model.vessel->way->from_access_m(tool.sphere) : 0;
    Pushing& began = pushing_[t];
    const double fed_m = tool.fed_m - began.fed_m;
    if (tool.in_body && tool.advance_m_s >= 0 && fed_m < pushed_m) continue;
    const bool stuck = tool.in_body && tool.advance_m_s > 0 && along_m - began.along_m < gain_share * pushed_m &&
                       tool.push_N - began.push_N > push_rises_N;
    if (stuck_[t].begins(stuck, scene_.time_s)) say(EventCode::push_without_advance, static_cast<int>(t), tool.push_N);
    began = {tool.fed_m, along_m, tool.push_N};
  }
}

void HandlingWatch::look_at_beam(const EventSink& say) {
  bool busy = scene_.injects || scene_.gauge_atm > 1 || scene_.filled;
  for (const HandledTool& tool : scene_.tools) busy = busy || tool.advance_m_s != 0 || tool.turn_rad_s != 0;
  if (idle_.begins(idle_for_.seconds(scene_.beam && !busy, scene_.time_s) > idle_s, scene_.time_s))
    say(EventCode::idle_beam);
}

void HandlingWatch::look(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
                         const SessionReport& report, const EventSink& say) {
  see(model, inputs, state, report, scene_);
  catheter_.look(map_, scene_, state.bedside.guide >= 0 ? state.blood.line.trace : Trace::absent, say);
  wire_.look(map_, scene_, say);
  if (model.has_patient()) device_.look(model, state, scene_, say);
  look_at_pushing(model, say);
  look_at_beam(say);
}

}  // namespace ostium
