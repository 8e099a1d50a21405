#pragma once
/// Pictures and the recording give way to steps: on two cores there is a window, its display server, a film and its
/// encoder beside the thread that steps, and whichever the scheduler puts on that thread's core makes steps late.
#include <sys/resource.h>

namespace ostium::core {

/// Of the calling thread, and of those and the processes that it starts from now on. Cannot be taken back. The lowest
/// there is: of a core that both want, the scheduler's weights leave steps 99 %, and beside 10 left them 90 %.
inline void give_way_to_steps() { setpriority(PRIO_PROCESS, 0, 19); }  // on Linux a thread's own

}  // namespace ostium::core
