#pragma once
/// Pictures give way to steps: on two cores there is a window, its display server and a film beside the thread that
/// steps, and whichever the scheduler puts on that thread's core makes steps late.
#include <sys/resource.h>

namespace ostium {

/// Of the calling thread, and of those that it starts from now on. Cannot be taken back. On a core that both want the
/// lowest priority leaves a step 99 % of it; one of 10 left it 90 %, while the other core had time to spare.
inline void give_way_to_steps() { setpriority(PRIO_PROCESS, 0, 19); }  // on Linux a thread's own

}  // namespace ostium
