#include "app/window/window.h"

#include <SDL2/SDL.h>

#include <cstdlib>
#include <memory>
#include <optional>
#include <stdexcept>

#include "app/session/scene/film.h"
#include "app/window/live_picture.h"
#include "app/window/reference.h"
#include "core/base/thread_priority.h"
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

struct HeldKey {
  SDL_Keycode key;
  Level level;
  double value;
};
constexpr HeldKey held_keys[] = {
    {SDLK_w, Level::guide_feed, 1},  {SDLK_s, Level::guide_feed, -1},     {SDLK_d, Level::guide_turn, 1},
    {SDLK_a, Level::guide_turn, -1}, {SDLK_i, Level::device_feed, 1},     {SDLK_k, Level::device_feed, -1},
    {SDLK_l, Level::device_turn, 1}, {SDLK_j, Level::device_turn, -1},    {SDLK_LSHIFT, Level::fine, 1},
    {SDLK_RSHIFT, Level::fine, 1},   {SDLK_SPACE, Level::fluoroscopy, 1}, {SDLK_v, Level::cine, 1},
    {SDLK_f, Level::contrast, 1},    {SDLK_g, Level::flush, 1},           {SDLK_BACKSLASH, Level::vacuum, 1}};

struct PressedKey {
  SDL_Keycode key;
  bool ctrl;
  Action action;
};
constexpr PressedKey pressed_keys[] = {{SDLK_TAB, false, Action::swap},
                                       {SDLK_RIGHTBRACKET, false, Action::atm_up},
                                       {SDLK_LEFTBRACKET, false, Action::atm_down},
                                       {SDLK_BACKSPACE, false, Action::release},
                                       {SDLK_LEFT, false, Action::left},
                                       {SDLK_RIGHT, false, Action::right},
                                       {SDLK_UP, false, Action::cranial},
                                       {SDLK_DOWN, false, Action::caudal},
                                       {SDLK_LEFT, true, Action::table_left},
                                       {SDLK_RIGHT, true, Action::table_right},
                                       {SDLK_UP, true, Action::table_up},
                                       {SDLK_DOWN, true, Action::table_down},
                                       {SDLK_z, false, Action::zoom},
                                       {SDLK_h, false, Action::reference},
                                       {SDLK_e, false, Action::heparin},
                                       {SDLK_n, false, Action::nitrate},
                                       {SDLK_b, false, Action::mark},
                                       {SDLK_p, false, Action::pause},
                                       {SDLK_F1, false, Action::help},
                                       {SDLK_ESCAPE, false, Action::quit}};

/// SDL's events of keys, mouse buttons and a gamepad, as Controls.
class Events {
 public:
  explicit Events(LiveDriver& hand) : hand_(hand) {}

  bool reference = false;  ///< was asked for
  bool help = false;

  void take(const SDL_Event& event) {
    switch (event.type) {
      case SDL_QUIT:
        press(Action::quit);
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
        hand_.controls.set(event.button.button == SDL_BUTTON_RIGHT ? Level::cine : Level::fluoroscopy,
                           event.type == SDL_MOUSEBUTTONDOWN);
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
  void press(Action action) {
    if (action == Action::reference) reference = true;
    if (action == Action::help) help = !help;
    hand_.controls.press(action);
  }
  void let_all_go() {
    for (int i = 0; i < levels; ++i) hand_.controls.set(static_cast<Level>(i), 0);
    down_.clear();
  }
  void key(const SDL_KeyboardEvent& event) {
    const bool down = event.type == SDL_KEYDOWN;
    if (event.repeat) return;
    for (const HeldKey& held : held_keys)
      if (held.key == event.keysym.sym) {
        // The opposite key, if it is still down, has the say again.
        std::erase(down_, &held);
        if (down) down_.push_back(&held);
        double value = 0;
        for (const HeldKey* other : down_)
          if (other->level == held.level) value = other->value;
        hand_.controls.set(held.level, value);
        return;
      }
    if (!down) return;
    const bool ctrl = (event.keysym.mod & KMOD_CTRL) != 0;
    for (const PressedKey& pressed : pressed_keys)
      if (pressed.key == event.keysym.sym && pressed.ctrl == ctrl) return press(pressed.action);
    if (event.keysym.sym >= SDLK_1 && event.keysym.sym <= SDLK_8)
      press(static_cast<Action>(static_cast<int>(Action::view_1) + event.keysym.sym - SDLK_1));
  }
  void axis(const SDL_ControllerAxisEvent& event) {
    const double raw = event.value / 32767.0, value = std::fabs(raw) < 0.12 ? 0 : raw;
    Controls& c = hand_.controls;
    switch (event.axis) {
      case SDL_CONTROLLER_AXIS_LEFTY:
        return c.set(Level::guide_feed, -value);
      case SDL_CONTROLLER_AXIS_LEFTX:
        return c.set(Level::guide_turn, value);
      case SDL_CONTROLLER_AXIS_RIGHTY:
        return c.set(Level::device_feed, -value);
      case SDL_CONTROLLER_AXIS_RIGHTX:
        return c.set(Level::device_turn, value);
      case SDL_CONTROLLER_AXIS_TRIGGERRIGHT:
        return c.set(Level::fluoroscopy, value);
      case SDL_CONTROLLER_AXIS_TRIGGERLEFT:
        return c.set(Level::contrast, value);
      default:
        return;
    }
  }
  void button(const SDL_ControllerButtonEvent& event) {
    const bool down = event.type == SDL_CONTROLLERBUTTONDOWN;
    Controls& c = hand_.controls;
    switch (event.button) {
      case SDL_CONTROLLER_BUTTON_RIGHTSHOULDER:
        return c.set(Level::cine, down);
      case SDL_CONTROLLER_BUTTON_LEFTSHOULDER:
        return c.set(Level::fine, down);
      case SDL_CONTROLLER_BUTTON_B:
        return c.set(Level::flush, down);
      case SDL_CONTROLLER_BUTTON_X:
        // A tap is one atmosphere less; held, it draws the plunger back.
        if (down) {
          press(Action::atm_down);
          x_since_ = event.timestamp;
        } else {
          c.set(Level::vacuum, 0);
          x_since_ = 0;
        }
        return;
      default:
        break;
    }
    if (!down) return;
    const bool arm = c.get(Level::fine) > 0.5;
    switch (event.button) {
      case SDL_CONTROLLER_BUTTON_A:
        return press(Action::swap);
      case SDL_CONTROLLER_BUTTON_Y:
        return press(Action::atm_up);
      case SDL_CONTROLLER_BUTTON_DPAD_LEFT:
        return press(arm ? Action::left : Action::view_1);
      case SDL_CONTROLLER_BUTTON_DPAD_RIGHT:
        return press(arm ? Action::right : Action::view_2);
      case SDL_CONTROLLER_BUTTON_DPAD_UP:
        return press(arm ? Action::cranial : Action::zoom);
      case SDL_CONTROLLER_BUTTON_DPAD_DOWN:
        return press(arm ? Action::caudal : Action::view_3);
      case SDL_CONTROLLER_BUTTON_START:
        return press(Action::pause);
      default:
        return;
    }
  }

 public:
  /// Now and then: what is long enough held.
  void look(Uint32 now) {
    if (x_since_ && now - x_since_ > 400) hand_.controls.set(Level::vacuum, 1);
  }

 private:
  LiveDriver& hand_;
  std::vector<const HeldKey*> down_;
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

  LivePicture live(model, {options.filmed, options.has_pedals, options.frames_per_s, options.pixels});
  const PanelTexts texts = panel_texts(model, plan, hand, options.plays);
  Events events(hand);
  fluoro::Picture faded;
  Reference reference;
  double shown_brightness = 1;
  bool shown_help = false;
  std::string shown_problem;
  std::vector<std::uint32_t> pixels;
  core::TripleBuffer<Snapshot>& latest = hand.snapshots();
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
    if (live_is_new) reference.take(live.picture(), live.cine(), signal(texts, now, "contrast_landmark"));
    if (events.reference) reference.freeze(live.picture()), events.reference = false;
    faded = live.picture();
    for (std::uint8_t& grey : faded.grey) grey = static_cast<std::uint8_t>(brightness * grey);
    draw_panel(texts, now,
               {.picture = faded.grey.empty() ? nullptr : &faded,
                .reference = reference.picture(),
                .dose = live.dose(),
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
