#include "device/host/strokes.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ostium::device {

namespace {

void note_sight(const StrokeSettings& s, const ToolMovement& movement, StrokeTool& tool) {
  if (movement.seen) {
    if (tool.sight == ToolPresence::absent) {
      tool.in_box_mm = tool.inserted_mm = tool.came_in_mm = -movement.before_introducer_mm;
      ++tool.arrivals;
    }
    tool.sight = ToolPresence::seen;
  } else if (tool.sight == ToolPresence::seen) {
    tool.sight = tool.inserted_mm <= tool.came_in_mm + s.margin_mm ? ToolPresence::absent : ToolPresence::lost;
  }
}

Pause out_of_travel(const StrokeSettings& s, const StrokeTool& tool, double advance_mm) {
  const double in_box_mm = tool.in_box_mm + advance_mm;
  if (advance_mm > 0 && in_box_mm > s.travel_mm - s.margin_mm) return Pause::travel_full;
  const bool deeper_than_tool = tool.inserted_mm - tool.in_box_mm > s.still_mm;
  if (advance_mm < 0 && in_box_mm < s.margin_mm && deeper_than_tool) return Pause::travel_empty;
  return Pause::none;
}

void pause(StrokeState& state, Pause why, std::size_t i) {
  state.pause = why;
  state.paused_by = static_cast<Tool>(i + 1);
  state.still_from_mm = state.tool[i].in_box_mm;
  state.still_for_s = 0;
}

void resume_if_back(const StrokeSettings& s, double elapsed_s, StrokeState& state) {
  const StrokeTool& tool = state.tool[index_of(state.paused_by)];
  state.still_for_s += elapsed_s;
  if (std::abs(tool.in_box_mm - state.still_from_mm) > s.still_mm || tool.sight != ToolPresence::seen) {
    state.still_from_mm = tool.in_box_mm;
    state.still_for_s = 0;
  }
  const bool back =
      state.pause == Pause::travel_full ? tool.in_box_mm <= s.travel_mm - s.half_mm : tool.in_box_mm >= s.half_mm;
  if (!back || state.still_for_s < s.still_s) return;
  state.pause = Pause::none;
  state.paused_by = Tool::none;
}

void fade(const StrokeSettings& s, double elapsed_s, StrokeState& state) {
  const double step = elapsed_s / s.fade_s;
  state.picture = std::clamp(state.picture + (state.pause == Pause::none ? step : -step), 0.0, 1.0);
}

}  // namespace

std::array<InstrumentMovement, tools> follow(const StrokeSettings& s, const Movements& m, StrokeState& state) {
  for (std::size_t i = 0; i < tools; ++i) {
    note_sight(s, m.tool[i], state.tool[i]);
    if (state.pause != Pause::none) continue;
    if (const Pause why = out_of_travel(s, state.tool[i], m.tool[i].advance_mm); why != Pause::none)
      pause(state, why, i);
  }
  std::array<InstrumentMovement, tools> moved{};
  for (std::size_t i = 0; i < tools; ++i) {
    StrokeTool& tool = state.tool[i];
    tool.in_box_mm += m.tool[i].advance_mm;
    if (state.pause != Pause::none) continue;
    moved[i] = {m.tool[i].advance_mm, m.tool[i].turn_deg};
    tool.inserted_mm += moved[i].advance_mm;
  }
  if (state.pause != Pause::none) resume_if_back(s, m.elapsed_s, state);
  fade(s, m.elapsed_s, state);
  return moved;
}

void zero(StrokeState& state, Tool tool) {
  assert(tool != Tool::none);
  StrokeTool& t = state.tool[index_of(tool)];
  t.in_box_mm = t.inserted_mm = 0;
}

}  // namespace ostium::device
