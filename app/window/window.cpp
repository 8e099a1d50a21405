#include "app/window/window.h"

#include <SDL2/SDL.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <stdexcept>

#include "app/session/live/live_picture.h"
#include "core/base/thread_priority.h"
#include "data/console/console_keys.h"
#include "data/formats/png.h"

namespace ostium::app {

namespace {

[[noreturn]] void give_up(const char* what) { throw std::runtime_error(std::string(what) + ": " + SDL_GetError()); }

struct Video {
  Video() {
    if (SDL_Init(SDL_INIT_VIDEO | SDL_INIT_GAMECONTROLLER) != 0) give_up("no window");
  }
  ~Video() { SDL_Quit(); }
};

template <class T>
using Owned = std::unique_ptr<T, void (*)(T*)>;

/// SDL's events of keys, mouse buttons and a gamepad, as Controls.
class Events {
 public:
  explicit Events(LiveDriver& hand) : controls_(hand.controls(Seat::window)) {
    for (const data::ConsoleKey& key : data::console_keys) codes_.push_back(SDL_GetKeyFromName(key.key));
  }

  bool help = false;

  void take(const SDL_Event& event) {
    switch (event.type) {
      case SDL_QUIT:
        controls_.order(ConsoleCommand::end);
        break;
      case SDL_KEYDOWN:
      case SDL_KEYUP:
        key(event.key);
        break;
      case SDL_WINDOWEVENT:
        // Keys that are let go while another window has them would stay down.
        if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) let_all_go();
        break;
      case SDL_MOUSEBUTTONDOWN:
      case SDL_MOUSEBUTTONUP:
        controls_.set(event.button.button == SDL_BUTTON_RIGHT ? ConsoleCommand::cine : ConsoleCommand::fluoroscopy,
                      event.type == SDL_MOUSEBUTTONDOWN);
        break;
      case SDL_MOUSEWHEEL:
        if (event.wheel.y != 0) controls_.order(ConsoleCommand::next_field);
        break;
      case SDL_MOUSEMOTION:
        // The table is dragged with the middle button: about as far as the picture moves.
        if (event.motion.state & SDL_BUTTON_MMASK)
          controls_.order({ConsoleCommand::move_table, {-table_mm * event.motion.xrel, table_mm * event.motion.yrel}});
        break;
      case SDL_CONTROLLERDEVICEADDED:
        if (!pad_) pad_.reset(SDL_GameControllerOpen(event.cdevice.which));
        break;
      case SDL_CONTROLLERDEVICEREMOVED:
        pad_.reset();
        let_all_go();
        break;
      case SDL_CONTROLLERAXISMOTION:
        axis(event.caxis);
        break;
      case SDL_CONTROLLERBUTTONDOWN:
      case SDL_CONTROLLERBUTTONUP:
        button(event.cbutton);
        break;
      default:
        break;
    }
  }

 private:
  static constexpr double table_mm = 0.2;  ///< a pixel of the window
  void let_all_go() {
    controls_.let_all_go();
    down_.clear();
  }
  void key(const SDL_KeyboardEvent& event) {
    const bool down = event.type == SDL_KEYDOWN;
    if (event.repeat) return;
    if (event.keysym.sym == SDLK_F1 && down) help = !help;
    const bool ctrl = (event.keysym.mod & KMOD_CTRL) != 0;
    for (std::size_t i = 0; i < codes_.size(); ++i) {
      const data::ConsoleKey& key = data::console_keys[i];
      const bool held = data::row_of(key.order.command).held;
      if (codes_[i] != event.keysym.sym || (!held && (key.ctrl != ctrl || !down))) continue;
      return held ? hold(key, down) : controls_.order(key.order);
    }
  }
  void hold(const data::ConsoleKey& key, bool down) {
    // The opposite key, if it is still down, has the say again.
    std::erase(down_, &key);
    if (down) down_.push_back(&key);
    double value = 0;
    for (const data::ConsoleKey* other : down_)
      if (other->order.command == key.order.command) value = other->order.values[0];
    controls_.set(key.order.command, value);
  }
  void axis(const SDL_ControllerAxisEvent& event) {
    const double raw = event.value / 32767.0, value = std::fabs(raw) < 0.12 ? 0 : raw;
    Controls& c = controls_;
    using enum ConsoleCommand;
    switch (event.axis) {
      case SDL_CONTROLLER_AXIS_LEFTY:
        return c.set(guide_feed, -value);
      case SDL_CONTROLLER_AXIS_LEFTX:
        return c.set(guide_turn, value);
      case SDL_CONTROLLER_AXIS_RIGHTY:
        return c.set(device_feed, -value);
      case SDL_CONTROLLER_AXIS_RIGHTX:
        return c.set(device_turn, value);
      case SDL_CONTROLLER_AXIS_TRIGGERRIGHT:
        return c.set(fluoroscopy, value);
      case SDL_CONTROLLER_AXIS_TRIGGERLEFT:
        return c.set(contrast, value);
      default:
        return;
    }
  }
  void button(const SDL_ControllerButtonEvent& event) {
    const bool down = event.type == SDL_CONTROLLERBUTTONDOWN;
    Controls& c = controls_;
    using enum ConsoleCommand;
    switch (event.button) {
      case SDL_CONTROLLER_BUTTON_RIGHTSHOULDER:
        return c.set(cine, down);
      case SDL_CONTROLLER_BUTTON_LEFTSHOULDER:
        return c.set(fine, down);
      case SDL_CONTROLLER_BUTTON_B:
        return c.set(saline, down);
      case SDL_CONTROLLER_BUTTON_X:
        // A tap is one atmosphere less; held, it draws the plunger back.
        if (down) {
          c.order(change_gauge, -1);
          x_since_ = event.timestamp;
        } else {
          c.set(vacuum, 0);
          x_since_ = 0;
        }
        return;
      default:
        break;
    }
    if (!down) return;
    const bool arm = c.get(fine) > 0.5;
    switch (event.button) {
      case SDL_CONTROLLER_BUTTON_A:
        return c.order(next_device);
      case SDL_CONTROLLER_BUTTON_Y:
        return c.order(change_gauge, 1);
      case SDL_CONTROLLER_BUTTON_DPAD_LEFT:
        return arm ? c.order(turn_arm, 5) : c.order(view, 1);
      case SDL_CONTROLLER_BUTTON_DPAD_RIGHT:
        return arm ? c.order(turn_arm, -5) : c.order(view, 2);
      case SDL_CONTROLLER_BUTTON_DPAD_UP:
        return arm ? c.order(turn_arm, 0, 5) : c.order(next_field);
      case SDL_CONTROLLER_BUTTON_DPAD_DOWN:
        return arm ? c.order(turn_arm, 0, -5) : c.order(view, 3);
      case SDL_CONTROLLER_BUTTON_START:
        return c.order(pause);
      default:
        return;
    }
  }

 public:
  /// Now and then: what is long enough held.
  void look(Uint32 now) {
    if (x_since_ && now - x_since_ > 400) controls_.set(ConsoleCommand::vacuum, 1);
  }

 private:
  Controls& controls_;
  std::vector<SDL_Keycode> codes_;  ///< of console_keys
  std::vector<const data::ConsoleKey*> down_;
  Uint32 x_since_ = 0;
  Owned<SDL_GameController> pad_{nullptr, SDL_GameControllerClose};
};

}  // namespace

bool has_display(std::string& why) {
  // Where no server is named, to ask for one only makes the servers' libraries complain on the terminal.
  const auto is_set = [](const char* name) { return std::getenv(name) != nullptr; };
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY") && !is_set("SDL_VIDEODRIVER")) {
    why = "there is no display";
    return false;
  }
  if (SDL_Init(SDL_INIT_VIDEO) != 0) {
    why = SDL_GetError();
    return false;
  }
  const bool real = std::string(SDL_GetCurrentVideoDriver()) != "offscreen";
  SDL_Quit();
  why = real ? "" : "there is no display";
  return real;
}

long show_window(const SessionModel& model, const ScriptPlan& plan, LiveDriver& hand, const WindowOptions& options) {
  core::give_way_to_steps();
  SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");  // see the renderer
  const Video video;
  const Owned<SDL_Window> window(SDL_CreateWindow("Ostium", SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED, panel_width,
                                                  panel_height, SDL_WINDOW_RESIZABLE),
                                 SDL_DestroyWindow);
  if (!window) give_up("no window");
  // One picture is copied into the window, 15 times a second. Without a graphics card a renderer that asks for one
  // draws with every core there is, those that steps and the film need.
  const Owned<SDL_Renderer> renderer(SDL_CreateRenderer(window.get(), -1, SDL_RENDERER_SOFTWARE), SDL_DestroyRenderer);
  if (!renderer) give_up("the window cannot be drawn in");
  SDL_RenderSetLogicalSize(renderer.get(), panel_width, panel_height);
  const Owned<SDL_Texture> texture(SDL_CreateTexture(renderer.get(), SDL_PIXELFORMAT_ARGB8888,
                                                     SDL_TEXTUREACCESS_STREAMING, panel_width, panel_height),
                                   SDL_DestroyTexture);
  if (!texture) give_up("the window cannot be drawn in");

  LivePicture live(model, {options.filmed, options.has_pedals, options.pixels, options.renderer});
  const PanelTexts texts = panel_texts(model, plan, hand);
  Events events(hand);
  fluoro::Picture faded;
  double shown_brightness = 1;
  bool shown_help = false;
  std::string shown_problem;
  std::vector<std::uint32_t> pixels;
  core::TripleBuffer<Snapshot>& latest = hand.snapshots(Seat::window);
  long shown = 0;
  bool over = false;
  while (!over) {
    over = options.over && options.over->load(std::memory_order_acquire);
    SDL_Event event;
    if (SDL_WaitEventTimeout(&event, 4)) do {
        events.take(event);
      } while (SDL_PollEvent(&event));
    events.look(SDL_GetTicks());
    const bool fresh = latest.update();
    const Snapshot& now = latest.front();
    const bool live_is_new = live.look(now, fresh);
    const double brightness = options.brightness ? options.brightness() : 1;
    const std::string problem = options.problem ? options.problem() : "";
    // While hands have to draw back nothing steps, and what the box says is shown all the same.
    const bool owed = over && pixels.empty() && !options.last_frame_png.empty();  // a run shorter than a picture takes
    if (!live_is_new && !owed && brightness == shown_brightness && problem == shown_problem &&
        events.help == shown_help)
      continue;
    shown_brightness = brightness, shown_problem = problem, shown_help = events.help;
    faded = live.picture();
    for (std::uint8_t& grey : faded.grey) grey = static_cast<std::uint8_t>(brightness * grey);
    draw_panel(texts, now,
               {.picture = faded.grey.empty() ? nullptr : &faded,
                .reference = live.reference().picture(),
                .dose = live.dose(),
                .review_frame = live.review_frame(),
                .review_frames = live.review_frames(),
                .problem = problem,
                .help = events.help},
               pixels);
    SDL_UpdateTexture(texture.get(), nullptr, pixels.data(), 4 * panel_width);
    SDL_RenderClear(renderer.get());
    SDL_RenderCopy(renderer.get(), texture.get(), nullptr, nullptr);
    SDL_RenderPresent(renderer.get());
    ++shown;
  }
  if (!options.last_frame_png.empty() && !pixels.empty()) {
    std::vector<std::uint8_t> rgb;
    for (const std::uint32_t p : pixels)
      rgb.push_back(p >> 16 & 255), rgb.push_back(p >> 8 & 255), rgb.push_back(p & 255);
    data::write_rgb_png(options.last_frame_png, panel_width, panel_height, rgb);
  }
  return shown;
}

}  // namespace ostium::app
