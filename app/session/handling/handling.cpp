#include "app/session/handling/handling.h"

#include "app/session/handling/errors.h"

namespace ostium::app {

HandlingWatch::HandlingWatch(const SessionModel& model) : map_(model), errors_(std::make_unique<HandlingErrors>()) {}
HandlingWatch::~HandlingWatch() = default;

void HandlingWatch::look(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
                         const SessionReport& report, const EventSink& say) {
  see(model, map_, inputs, state, report, scene_);
  errors_->look(map_, scene_, say);
}

}  // namespace ostium::app
