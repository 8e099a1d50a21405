#pragma once
/// Drawing and recording yield to the stepping thread. On two cores, a window, its display server, a film and its
/// encoder compete with that thread, and whichever the scheduler puts on its core makes steps late.
#include <sys/resource.h>

namespace ostium::core {

/// Gives the calling thread, and all threads and processes that it starts later, the lowest priority. Cannot be undone.
/// On a shared core the scheduler's weights then leave 99 % to the steps; a nice value of 10 left 90 %.
inline void give_way_to_steps() { setpriority(PRIO_PROCESS, 0, 19); }  // on Linux this applies to the thread

}  // namespace ostium::core
