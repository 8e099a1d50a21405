#include "app/window/panel.h"

#include <cairo/cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "data/console/console_keys.h"

namespace ostium::app {

namespace {

struct Colour {
  double r, g, b;
};
constexpr double mark_shown_s = 2;

constexpr Colour paper{0.07, 0.08, 0.09}, pale{0.86, 0.88, 0.89}, dim{0.52, 0.56, 0.58}, green{0.35, 0.85, 0.45},
    red{0.95, 0.33, 0.28}, yellow{0.96, 0.80, 0.30}, box{0.12, 0.135, 0.15};

class Pen {
 public:
  explicit Pen(std::vector<std::uint32_t>& pixels)
      : surface_(cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(pixels.data()),
                                                     CAIRO_FORMAT_RGB24, panel_width, panel_height, 4 * panel_width),
                 cairo_surface_destroy),
        cairo_(cairo_create(surface_.get()), cairo_destroy) {
    cairo_select_font_face(cr(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  }
  cairo_t* cr() const { return cairo_.get(); }
  void colour(const Colour& c) const { cairo_set_source_rgb(cr(), c.r, c.g, c.b); }
  void fill(const Colour& c, double x, double y, double w, double h) const {
    colour(c);
    cairo_rectangle(cr(), x, y, w, h);
    cairo_fill(cr());
  }
  void write(const Colour& c, double size, double x, double y, const std::string& words) const {
    colour(c);
    cairo_set_font_size(cr(), size);
    cairo_move_to(cr(), x, y);
    cairo_show_text(cr(), words.c_str());
  }
  double width(double size, const std::string& words) const {
    cairo_set_font_size(cr(), size);
    cairo_text_extents_t e;
    cairo_text_extents(cr(), words.c_str(), &e);
    return e.x_advance;
  }
  void write_to(const Colour& c, double size, double right, double y, const std::string& words) const {
    write(c, size, right - width(size, words), y, words);
  }
  void show(const fluoro::Picture& picture, double x, double y, double side) const {
    std::vector<std::uint32_t> grey(picture.grey.size());
    for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = 0x010101u * picture.grey[i];
    const std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> image(
        cairo_image_surface_create_for_data(reinterpret_cast<unsigned char*>(grey.data()), CAIRO_FORMAT_RGB24,
                                            picture.width, picture.height, 4 * picture.width),
        cairo_surface_destroy);
    cairo_save(cr());
    cairo_translate(cr(), x, y);
    cairo_scale(cr(), side / picture.width, side / picture.height);
    cairo_set_source_surface(cr(), image.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(cr()), CAIRO_FILTER_BILINEAR);
    cairo_paint(cr());
    cairo_restore(cr());
  }

 private:
  std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)> surface_;
  std::unique_ptr<cairo_t, void (*)(cairo_t*)> cairo_;
};

std::string minutes(double s) { return fmt::format("{}:{:02d}", static_cast<int>(s) / 60, static_cast<int>(s) % 60); }

void draw_strip(const Pen& pen, const std::vector<float>& samples, const Colour& c, double least, double most,
                const std::string& name, const std::string& value, double x, double y, double w, double h) {
  pen.fill(box, x, y, w, h);
  const double trace_w = w - 82;
  pen.colour(c);
  cairo_set_line_width(pen.cr(), 1.4);
  bool down = false;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!(samples[i] == samples[i])) {
      down = false;
      continue;
    }
    const double px = x + 4 + (trace_w - 8) * static_cast<double>(i) / static_cast<double>(samples.size());
    const double part = std::clamp((samples[i] - least) / (most - least), 0.0, 1.0);
    const double py = y + h - 5 - (h - 10) * part;
    down ? cairo_line_to(pen.cr(), px, py) : cairo_move_to(pen.cr(), px, py);
    down = true;
  }
  cairo_stroke(pen.cr());
  pen.write(dim, 12, x + 6, y + 15, name);
  pen.write(c, 20, x + trace_w + 2, y + h / 2 + 9, value);
}

std::string pressure_words(const Snapshot& now) {
  return std::isnan(now.guide_low_mmHg) ? "—" : fmt::format("{:.0f}/{:.0f}", now.guide_high_mmHg, now.guide_low_mmHg);
}

void draw_strips(const Pen& pen, const PanelTexts& texts, const Snapshot& now, double x, double y, double w) {
  const double rate = 60 / now.state.blood.heart.cycle_s;
  draw_strip(pen, now.ecg_mV, green, -0.6, 1.6, "II", fmt::format("{:.0f}", rate), x, y, w, 74);
  draw_strip(pen, now.line_mmHg, red, 0, 180, "guide, mmHg", pressure_words(now), x, y + 78, w, 88);
  const double trace = signal(texts, now, "trace");
  const char* kinds[] = {"", "damped", "ventricularised", "ventricle", "no trace"};
  if (trace >= 1 && trace < 5) pen.write(yellow, 12, x + 100, y + 93, kinds[static_cast<int>(trace)]);
}

void draw_tray(const Pen& pen, const PanelTexts& texts, const Snapshot& now, double x, double y, double w) {
  pen.write(dim, 12, x, y, now.hands == Hands::seats ? "tools (left hand, right hand; Tab changes)" : "tools");
  y += 6;
  for (std::size_t t = 0; t < texts.tools.size(); ++t) {
    const bool left = static_cast<int>(t) == texts.left_hand, right = static_cast<int>(t) == now.right_hand;
    const double inserted = 100 * now.state.rods.rods[t].inserted_m;
    const bool in = now.tools[t].in_body;
    pen.fill(box, x, y, w, 22);
    if (now.hands == Hands::seats && (left || right)) pen.write(yellow, 12, x + 5, y + 15, left ? "L" : "R");
    pen.write(in ? pale : dim, 12.5, x + 22, y + 15.5, texts.tools[t]);
    pen.write_to(in ? pale : dim, 12.5, x + w - 8, y + 15.5, in ? fmt::format("{:.1f} cm", inserted) : "out");
    y += 24;
  }
  if (now.refused >= 0 && now.in_its_way >= 0)
    pen.write(yellow, 12.5, x, y + 14,
              fmt::format("{} cannot enter: {} is in its place",
                          texts.tools[static_cast<std::size_t>(now.refused)].substr(
                              0, texts.tools[static_cast<std::size_t>(now.refused)].find(':')),
                          texts.tools[static_cast<std::size_t>(now.in_its_way)].substr(
                              0, texts.tools[static_cast<std::size_t>(now.in_its_way)].find(':'))));
}

void draw_numbers(const Pen& pen, const PanelTexts& texts, const Snapshot& now, const PanelView& view, double x,
                  double y, double w) {
  struct Entry {
    std::string what, value;
  };
  std::vector<Entry> entries;
  entries.push_back({"time", minutes(signal(texts, now, "time_s"))});
  entries.push_back({"fluoroscopy", minutes(now.state.c_arm.fluoroscopy_s)});
  entries.push_back({"cine", fmt::format("{} run{}, {:.1f} s", now.state.c_arm.cine_runs,
                                         now.state.c_arm.cine_runs == 1 ? "" : "s", now.state.c_arm.cine_s)});
  entries.push_back({"DAP", fmt::format("{:.2f} Gy cm²", view.dose.dose_area_Gy_m2 * 1e4)});
  const double gauge = signal(texts, now, "gauge_atm");
  if (gauge == gauge) {
    const double balloon = signal(texts, now, "balloon_mm");
    entries.push_back(
        {"gauge", fmt::format("{:.0f} atm{}", gauge, balloon > 0 ? fmt::format(", {:.2f} mm", balloon) : "")});
    if (const double second = signal(texts, now, "second_balloon_mm"); second > 0)
      entries.push_back(
          {"second", fmt::format("{:.0f} atm, {:.2f} mm", signal(texts, now, "second_gauge_atm"), second)});
    entries.push_back({"contrast", fmt::format("{:.1f} mL", signal(texts, now, "contrast_mL"))});
    entries.push_back({"ACT", fmt::format("{:.0f} s", signal(texts, now, "act_s"))});
  }
  if (now.overruns > 0) entries.push_back({"late steps", std::to_string(now.overruns)});
  const double column = w / 2;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::size_t row = i / 2;
    const double ex = x + (i % 2) * column, ey = y + static_cast<double>(row) * 22;
    pen.write(dim, 12, ex, ey, entries[i].what);
    pen.write(pale, 14, ex + 74, ey, entries[i].value);
  }
}

void draw_help(const Pen& pen, const PanelTexts& texts, const Snapshot& now) {
  cairo_set_source_rgba(pen.cr(), 0.03, 0.04, 0.05, 0.88);
  cairo_rectangle(pen.cr(), 30, 30, 735, 720);
  cairo_fill(pen.cr());
  double y = 62;
  pen.write(pale, 18, 54, y, "Keys");
  y += 6;
  const std::vector<KeyHelp> keys = key_help(texts, now);
  double widest = 140;
  for (const KeyHelp& help : keys) widest = std::max(widest, pen.width(13, help.keys));
  for (const KeyHelp& help : keys) {
    y += 19;
    pen.write(yellow, 13, 54, y, help.keys);
    pen.write(pale, 13, 54 + widest + 16, y, help.what);
  }
}

/// Whether the console carries it out, as this run stands.
bool does_something(const data::ConsoleRow& row, const PanelTexts& texts, const Snapshot& now) {
  using enum ConsoleCommand;
  if (row.patient && !texts.has_patient) return false;
  if (row.needs == data::ConsoleNeeds::hands && now.hands == Hands::script) return false;
  switch (row.command) {
    case guide_feed:
    case guide_turn:
    case fine:
      return now.hands == Hands::seats;
    case device_feed:
    case device_turn:
      return now.hands == Hands::seats && now.right_hand >= 0;
    case next_device:
      return now.hands == Hands::seats && texts.tools.size() > 2;
    case vacuum:
    case gauge:
    case change_gauge:
    case second_gauge:
    case change_second_gauge:
      return texts.has_balloon;
    case take_over:
      return now.hands == Hands::script;
    case hand_back:
      return now.script_step >= 0 && now.hands != Hands::script;
    default:
      return true;
  }
}

}  // namespace

std::vector<KeyHelp> key_help(const PanelTexts& texts, const Snapshot& now) {
  std::vector<KeyHelp> all;
  for (const data::ConsoleRow& row : data::console_rows) {
    std::string keys;
    for (const data::ConsoleKey& key : data::console_keys)
      if (key.order.command == row.command)
        keys += (keys.empty() ? "" : "  ") + std::string(key.ctrl ? "Ctrl+" : "") + key.key;
    if (!keys.empty() && does_something(row, texts, now)) all.push_back({keys, row.what});
  }
  return all;
}

double signal(const PanelTexts& texts, const Snapshot& now, const std::string& name) {
  const auto at = std::find(texts.signal_names.begin(), texts.signal_names.end(), name);
  if (at == texts.signal_names.end()) return NAN;
  return now.signals[static_cast<std::size_t>(at - texts.signal_names.begin())];
}

PanelTexts panel_texts(const SessionModel& model, const ScriptPlan& plan, const LiveDriver& hand) {
  PanelTexts texts;
  texts.title = model.vessel->name + (plan.script.by_hand ? "" : ", " + plan.script.name);
  for (const SessionTool& tool : model.tools) texts.tools.push_back(tool.name + ": " + tool.instrument.title);
  for (std::size_t s = 0; s < plan.script.steps.size(); ++s) texts.steps.push_back(plan.script.steps[s].words());
  texts.signal_names = signal_names(model);
  texts.left_hand = hand.left_hand();
  texts.has_patient = model.has_patient();
  texts.has_balloon = std::any_of(model.tools.begin(), model.tools.end(),
                                  [](const SessionTool& tool) { return tool.instrument.balloon.has_value(); });
  return texts;
}

void draw_panel(const PanelTexts& texts, const Snapshot& now, const PanelView& view,
                std::vector<std::uint32_t>& pixels) {
  pixels.assign(static_cast<std::size_t>(panel_width) * panel_height, 0);
  const Pen pen(pixels);
  pen.fill(paper, 0, 0, panel_width, panel_height);
  constexpr double side = 768, x = 784, w = panel_width - x - 12;
  if (view.picture)
    pen.show(*view.picture, 4, 4, side);
  else
    pen.write(dim, 16, 240, 380, "Space: fluoroscopy");
  constexpr double small = 300;
  if (view.reference) {
    pen.show(*view.reference, x, 4, small);
    pen.write(dim, 12, x + small + 10, 18, "reference");
  } else {
    pen.fill(box, x, 4, small, small);
    pen.write(dim, 13, x + 62, 4 + small / 2, "H: reference picture");
  }
  draw_strips(pen, texts, now, x, 312, w);
  draw_tray(pen, texts, now, x, 500, w);
  draw_numbers(pen, texts, now, view, x, 508 + 24.0 * static_cast<double>(texts.tools.size()) + 38, w);
  pen.write(pale, 14, 8, 792, texts.title);
  if (now.script_step >= 0 && now.script_step < static_cast<int>(texts.steps.size()))
    pen.write(yellow, 14, 330, 792, texts.steps[static_cast<std::size_t>(now.script_step)]);
  pen.write_to(dim, 12, panel_width - 12, 776, "F1: keys");
  pen.write_to(dim, 11, panel_width - 12, 793, "Training and research, not for decisions on a patient");
  if (!view.problem.empty()) {
    const std::size_t end = view.problem.find(". ");  // what is wrong; what to do
    pen.fill(red, 4, 340, side, end == std::string::npos ? 44 : 68);
    pen.write({1, 1, 1}, 18, 24, 368, view.problem.substr(0, end == std::string::npos ? end : end + 1));
    if (end != std::string::npos) pen.write({1, 1, 1}, 18, 24, 392, view.problem.substr(end + 2));
  }
  if (now.marks > 0 && signal(texts, now, "time_s") < now.marked_s + mark_shown_s)
    pen.write(yellow, 16, 16, 60, fmt::format("mark {} at {:.1f} s", now.marks, now.marked_s));
  if (view.review_frames > 0)
    pen.write(yellow, 16, 16, 36, fmt::format("cine review {} of {}", view.review_frame, view.review_frames));
  if (now.paused) {
    pen.fill(yellow, 324, 20, 128, 30);
    pen.write({0, 0, 0}, 16, 350, 41, "PAUSED");
  }
  if (view.help) draw_help(pen, texts, now);
}

}  // namespace ostium::app
