#pragma once
/// All handling errors, in the order in which they are reported. Each is a small class, with its limits, in the file of
/// its group; the group's list is at the end of that file.
#include "app/session/handling/catheter_errors.h"
#include "app/session/handling/device_errors.h"
#include "app/session/handling/operation_errors.h"
#include "app/session/handling/wire_errors.h"

namespace ostium::app {

/// Checks every error of a group.
template <class... Errors>
void look_for(std::tuple<Errors...>& group, const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
  std::apply([&](Errors&... error) { (error.look(map, x, say), ...); }, group);
}

struct HandlingErrors {
  CatheterErrors catheter;
  ThickWireErrors thick_wire;
  CoronaryWireErrors coronary_wire;
  int wire = -1;  ///< whose they are: with another one in hand they begin anew
  DeviceErrors device;
  OperationErrors operation;

  void look(const HandlingMap& map, const HandlingScene& x, const EventSink& say) {
    look_for(catheter, map, x, say);
    look_for(thick_wire, map, x, say);
    if (x.thin_wire != wire) coronary_wire = {};
    wire = x.thin_wire;
    if (wire >= 0) look_for(coronary_wire, map, x, say);
    if (x.device < 0 || x.balloon < 0)
      device = {};
    else
      look_for(device, map, x, say);
    look_for(operation, map, x, say);
  }
};

}  // namespace ostium::app
