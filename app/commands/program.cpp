#include "app/commands/program.h"

namespace ostium::app {

// Each is defined in the file of its name. To add one, list its name twice below.
Command demonstration();
Command verify_command();
Command instruments_command();
Command cases_command();
Command check_command();
Command import_command();
Command workbench_command();
Command frame_command();
Command inject_command();
Command treat_command();
Command views_command();
Command picture_command();
Command centreline_command();
Command predict_command();
Command explain_command();
Command characterise_command();
Command run_command();
Command serve_command();
Command learn_command();
Command play_command();
Command report_command();
Command study_command();
Command scripts_command();
Command sweep_command();
Command dataset_command();
Command replay_command();
Command device_command();

Command program() {
  Command ostium = demonstration();
  // In the order of --help.
  ostium.subcommands = {verify_command(),  instruments_command(), cases_command(),        check_command(),
                        import_command(),  workbench_command(),   frame_command(),        inject_command(),
                        treat_command(),   views_command(),       picture_command(),      centreline_command(),
                        predict_command(), explain_command(),     characterise_command(), run_command(),
                        serve_command(),   learn_command(),       play_command(),         report_command(),
                        study_command(),   scripts_command(),     sweep_command(),        dataset_command(),
                        replay_command(),  device_command()};
  return ostium;
}

}  // namespace ostium::app
