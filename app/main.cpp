/// The one executable. Its subcommands are in commands/.
#include <malloc.h>

#include "app/command_line/command_line.h"
#include "app/commands/program.h"
#include "app/reader/read_apart.h"

int main(int argc, char** argv) {
  // Returns large temporary blocks to the system at once; otherwise a tenth of a run's memory would be leftovers from
  // building the case.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  ostium::vascular::read_meshes_with(ostium::app::read_surface_apart);
  return ostium::app::run_command_line(ostium::app::program(), argc, argv);
}
