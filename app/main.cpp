/// The one executable. Each subcommand is declared here and lives in a file of its own.
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <exception>

#include "app/calibrate_command.h"
#include "app/cases_command.h"
#include "app/centreline_command.h"
#include "app/check_command.h"
#include "app/device_command.h"
#include "app/explain_command.h"
#include "app/frame_command.h"
#include "app/import_command.h"
#include "app/inject_command.h"
#include "app/instruments_command.h"
#include "app/predict_command.h"
#include "app/replay_command.h"
#include "app/report_command.h"
#include "app/run_command.h"
#include "app/sweep_command.h"
#include "app/treat_command.h"
#include "app/verify_command.h"

int main(int argc, char** argv) {
  // What a case takes while it is made goes back at once; else a tenth of a run's memory would be such leftovers.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
  CLI::App app("Ostium: an endovascular simulator. Training and research, not for decisions on a patient.", "ostium");
  app.set_version_flag("--version", OSTIUM_VERSION);
  app.require_subcommand(0, 1);
  std::string demonstration = "ostium-run";
  app.add_option("--out", demonstration, "Without a subcommand: an angioplasty by script goes into this folder")
      ->type_name("DIR")
      ->capture_default_str();
  app.footer("Exit codes: 0 done, 1 failed or did not hold, 2 usage, 3 bad input.");

  ostium::VerifyOptions verify;
  CLI::App* verify_app = app.add_subcommand("verify", "Run the physics gates: value, reference, tolerance, pass");
  verify_app->add_option("--only", verify.only, "Only gates whose name begins with this")->type_name("GATE");
  verify_app->add_flag("--quick", verify.quick, "Fewer elements and cases, the same tolerances");
  verify_app->add_flag("--json", verify.json, "Machine-readable, see data/schemas/verify.schema.json");
  verify_app->add_flag("--list", verify.list, "Name the gates and what they compare, without running them");
  verify_app->footer(
      "Examples:\n  ostium verify\n  ostium verify --only rod-static\n  ostium verify --quick --json > gates.json");

  ostium::InstrumentsOptions instruments;
  CLI::App* instruments_app =
      app.add_subcommand("instruments", "What instruments there are, how stiff, and where from");
  instruments_app->add_option("name", instruments.name, "One of them, in detail and with its sources")
      ->type_name("NAME");
  instruments_app->add_flag("--json", instruments.json, "Machine-readable, see data/schemas/instruments.schema.json");
  instruments_app->add_option("--picture", instruments.picture, "Draw them at rest")->type_name("FILE.svg");
  instruments_app->footer(
      "Examples:\n  ostium instruments\n  ostium instruments guide-jl4-6f\n  ostium instruments --picture all.svg");

  ostium::CasesOptions cases;
  CLI::App* cases_app = app.add_subcommand("cases", "What cases there are to rehearse");
  cases_app->add_option("name", cases.name, "One of them, with its card and its arteries")->type_name("NAME");
  cases_app->add_flag("--json", cases.json, "Machine-readable, see data/schemas/cases.schema.json");
  cases_app->add_option("--export", cases.folder, "Write the beating lumen (24 OBJ) and centrelines (JSON, VTP) there")
      ->type_name("DIR");
  cases_app->footer(
      "Examples:\n  ostium cases\n  ostium cases rca-mid-focal\n  ostium cases rca-mid-focal --export out/rca");

  ostium::CheckOptions check;
  CLI::App* check_app = app.add_subcommand("check", "What is wrong with a mesh: holes, folds, crossings, and where");
  check_app->add_option("mesh", check.files, "OBJ, STL, PLY, ...")->type_name("MESH")->required();
  check_app->add_option("--units", check.unit, "What a number in the file means; auto guesses and says so")
      ->check(CLI::IsMember({"auto", "mm", "cm", "m", "in"}))
      ->capture_default_str();
  check_app->add_flag("--json", check.json, "Machine-readable");
  check_app->add_option("--picture", check.picture, "The mesh with its faults (one file only)")
      ->type_name("FILE.png|FILE.svg");
  check_app->footer(
      "Examples:\n  ostium check aorta.stl --picture faults.svg\n  ostium check --units m --json lumen.obj");

  ostium::ImportOptions import;
  CLI::App* import_app = app.add_subcommand("import", "Anyone's own mesh becomes a case: mended, named, beating");
  import_app->add_option("mesh", import.files, "STL, OBJ, PLY, glTF, ...; several are one patient's parts")
      ->type_name("MESH")
      ->required();
  import_app->add_flag("--sequence", import.sequence,
                       "The files, or those of a folder, are one surface through a beat, from the R wave on");
  import_app->add_option("-o,--out", import.output, "A folder for the case, or a name to keep it under")
      ->type_name("DIR|NAME")
      ->required();
  import_app->add_option("--units", import.unit, "What a number in the files means; auto guesses and says so")
      ->check(CLI::IsMember({"auto", "mm", "cm", "m", "in"}))
      ->capture_default_str();
  import_app->add_option("--axes", import.axes, "Where x, y, z point to: LPS, RAS, LSA, ...; auto tells by the anatomy")
      ->capture_default_str();
  import_app->add_option("--entry", import.entry, "Instruments enter at the centreline's point nearest to this one")
      ->type_name("X,Y,Z");
  import_app->add_option("--rename", import.renames, "Another name for a branch that was found")
      ->type_name("FOUND=WANTED");
  import_app->add_option("--lesion", import.lesions, "A narrowing to put in: branch, from mm, length mm, %")
      ->type_name("BRANCH:FROM:LENGTH:PERCENT");
  import_app->add_option("--title", import.title, "What people call it");
  import_app->add_option("--voxel", import.voxel_mm, "Of the level set, mm; 0: by the narrowest vessels")
      ->check(CLI::Range(0.0, 5.0))
      ->capture_default_str();
  import_app->add_option("--longest-gap", import.longest_gap_mm, "No gap is bridged that is longer, mm")
      ->check(CLI::Range(0.0, 50.0))
      ->capture_default_str();
  import_app->add_option("--picture", import.picture, "What came out of it, with mends and names")
      ->type_name("FILE.png|FILE.svg");
  import_app->add_flag("--json", import.json, "What was found and mended, machine-readable");
  import_app->footer(
      "Examples:\n  ostium import aorta.stl coronaries.stl -o anna --picture anna.svg\n"
      "  ostium import aorta.obj -o cases/aorta --units mm --entry -5,18,-11 --rename 3=coeliac\n"
      "  ostium import heart.ply -o tight-rca --lesion RCA:40:12:75 && ostium cases tight-rca\n"
      "  ostium import frames/ --sequence -o beating-heart");
  ostium::FrameOptions frame;
  CLI::App* frame_app = app.add_subcommand("frame", "One X-ray picture, or a short run of them");
  frame_app->add_option("of", frame.of, "What is in the beam: a case (`ostium cases`), or phantom: fluoro's test chest")
      ->capture_default_str();
  frame_app->add_option("--phase", frame.phase, "Of the heart, 0 is the R wave; a film begins there. Cases")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  frame_app->add_option("--view", frame.view, "Standard view, see `ostium views`")->capture_default_str();
  frame_app->add_option("--lao", frame.lao_deg, "Instead of the view's angle, degrees; negative: RAO");
  frame_app->add_option("--cran", frame.cran_deg, "Instead of the view's angle, degrees; negative: caudal");
  frame_app->add_option("--sid", frame.sid_mm, "Source to detector, mm")->capture_default_str();
  frame_app->add_option("--field", frame.field_mm, "Side of the detector's field, mm: 200, 160, 130")
      ->check(CLI::Range(50.0, 400.0))
      ->capture_default_str();
  frame_app->add_option("--table", frame.table_mm, "Isocentre from the heart's middle: left, head, front, mm")
      ->expected(3)
      ->delimiter(',');
  frame_app->add_option("--shutters", frame.shutters, "Left, right, top, bottom, from the middle; 0.5 is open")
      ->expected(4)
      ->delimiter(',');
  frame_app->add_option("--pixels", frame.pixels, "Along a side")
      ->check(CLI::IsMember({64, 128, 256, 512, 768, 1024}))
      ->capture_default_str();
  frame_app->add_flag("--cine", frame.cine, "Cine dose instead of fluoroscopy");
  frame_app->add_option("--rate", frame.frames_per_s, "Frames a second: 3.75, 7.5, 15, 30")->capture_default_str();
  frame_app->add_option("--frames", frame.frames, "So many; of a still picture the last is shown (8)")
      ->check(CLI::Range(1, 10'000));
  frame_app->add_option("--fill", frame.fill, "Coronary full of contrast")
      ->check(CLI::IsMember({"none", "left", "right"}))
      ->capture_default_str();
  frame_app->add_option("--stenosis", frame.stenosis_percent, "Of the phantom's LAD and RCA, by diameter, %")
      ->check(CLI::Range(0.0, 99.0))
      ->capture_default_str();
  frame_app->add_option("--guide", frame.guide, "Where the phantom's guide and wire are")
      ->check(CLI::IsMember({"left", "right", "none"}))
      ->capture_default_str();
  frame_app->add_option("--seed", frame.seed, "Of the noise")->capture_default_str();
  frame_app->add_option("--renderer", frame.renderer, "What draws path lengths")
      ->check(CLI::IsMember({"scanline", "osmesa"}))
      ->capture_default_str();
  frame_app->add_flag("--overlay", frame.overlay, "Angles, rate, times and dose on the picture (not in DICOM)");
  frame_app->add_flag("--json", frame.json, "Exposure and dose, machine-readable, see data/schemas/frame.schema.json");
  frame_app->add_option("-o,--out", frame.out, "FILE.png, FILE.dcm or FILE.mp4")->capture_default_str();
  frame_app->footer(
      "Examples:\n  ostium frame --view spider --fill left -o spider.png\n"
      "  ostium frame --lao -30 --cran -20 --cine --pixels 1024 --fill left --overlay -o cine.png\n"
      "  ostium frame --view lao --fill right --guide right --frames 15 -o run.dcm\n"
      "  ostium frame lad-proximal-eccentric --view spider --fill left --overlay -o case.png");

  ostium::InjectOptions inject;
  CLI::App* inject_app = app.add_subcommand("inject", "Contrast into a case's arteries, filmed; frame counts, balance");
  inject_app->add_option("case", inject.of, "See `ostium cases`")->type_name("CASE")->capture_default_str();
  inject_app->add_option("--at", inject.at, "Where the catheter's tip is")
      ->check(CLI::IsMember({"left", "right", "left-sinus", "right-sinus", "aorta"}))
      ->capture_default_str();
  inject_app->add_option("--rate", inject.rate_mL_s, "mL/s; as injected by hand if not given: 2.1 left, 1.7 right")
      ->check(CLI::Range(0.0, 30.0));
  inject_app->add_option("--volume", inject.volume_mL, "mL; 7.1 left, 4.8 right")->check(CLI::Range(0.0, 100.0));
  inject_app->add_option("--iodine", inject.iodine_mg_mL, "mg/mL in the syringe")
      ->check(CLI::Range(0.0, 400.0))
      ->capture_default_str();
  inject_app->add_option("--phase", inject.phase, "Of the heart as it begins; 0 is the R wave")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  inject_app->add_option("--seconds", inject.seconds, "Length of the run")
      ->check(CLI::Range(0.2, 60.0))
      ->capture_default_str();
  inject_app->add_option("--rate-fps", inject.frames_per_s, "Frames a second: 3.75, 7.5, 15, 30")
      ->capture_default_str();
  inject_app->add_option("--view", inject.view, "Standard view, see `ostium views`; else the artery's usual one");
  inject_app->add_option("--pixels", inject.pixels, "Along a side")
      ->check(CLI::IsMember({256, 512, 768, 1024}))
      ->capture_default_str();
  inject_app->add_flag("--healthy", inject.healthy, "The same person without lesions");
  inject_app->add_flag("--count", inject.count, "TIMI frame counts too (30 frames/s, a run for each artery)");
  inject_app->add_option("--seed", inject.seed, "Of noise and chance")->capture_default_str();
  inject_app->add_flag("--json", inject.json, "Machine-readable");
  inject_app->add_option("-o,--out", inject.out, "FILE.mp4, or FILE.png: six moments")->capture_default_str();
  inject_app->footer(
      "Examples:\n  ostium inject rca-mid-focal --rate 3 --volume 6 -o run.mp4\n"
      "  ostium inject lad-proximal-eccentric --at left --view spider -o spider.png\n"
      "  ostium inject rca-mid-focal --healthy --count --json");

  ostium::TreatOptions treat;
  CLI::App* treat_app = app.add_subcommand(
      "treat", "A case's lesions treated by the book, devices on the centreline: numbers, pictures, strips");
  treat_app->add_option("case", treat.of, "See `ostium cases`")->type_name("CASE")->capture_default_str();
  treat_app->add_option("--hold", treat.hold_s, "Seconds of each inflation")
      ->check(CLI::Range(0.0, 600.0))
      ->capture_default_str();
  treat_app->add_option("--pressure", treat.pressure, "Of what is usual")
      ->check(CLI::Range(0.1, 3.0))
      ->capture_default_str();
  treat_app->add_option("--oversize", treat.oversize, "Of every device's diameter")
      ->check(CLI::Range(0.5, 2.0))
      ->capture_default_str();
  treat_app->add_option("--shift", treat.shift_mm, "Devices lie so far beside the lesion, distally, mm")
      ->check(CLI::Range(-30.0, 30.0));
  treat_app->add_flag("--no-stent", treat.no_stent, "Balloons alone");
  treat_app->add_flag("--no-predilatation", treat.no_predilatation, "The stent at once");
  treat_app->add_flag("--no-postdilatation", treat.no_postdilatation, "The stent's own balloon is the last");
  treat_app->add_flag("--no-pictures", treat.no_pictures, "Numbers alone, without frame counts");
  treat_app->add_option("--view", treat.view, "Standard view, see `ostium views`; else the artery's usual one");
  treat_app->add_option("--pixels", treat.pixels, "Along a side")
      ->check(CLI::IsMember({256, 512, 768, 1024}))
      ->capture_default_str();
  treat_app->add_option("--seed", treat.seed, "Of what happens by chance")->capture_default_str();
  treat_app->add_flag("--json", treat.json, "Machine-readable");
  treat_app->add_option("-o,--out", treat.out, "FILE.png: before, while inflating, after, and the strips")
      ->capture_default_str();
  treat_app->footer(
      "Examples:\n  ostium treat rca-mid-focal -o rca.png\n"
      "  ostium treat lad-proximal-eccentric --oversize 1.3 --seed 4 --no-pictures\n"
      "  ostium treat rca-diffuse --json > rca-diffuse.json");

  bool views_json = false;
  CLI::App* views_app = app.add_subcommand("views", "The standard views of coronary angiography");
  views_app->add_flag("--json", views_json, "Machine-readable, see data/schemas/views.schema.json");
  views_app->footer("Examples:\n  ostium views\n  ostium views --json");

  ostium::CentrelineCommandOptions centreline;
  CLI::App* centreline_app = app.add_subcommand("centreline", "The centreline-sphere tree of a closed mesh");
  centreline_app->add_option("mesh", centreline.mesh, "OBJ, STL, PLY, ...")->type_name("MESH")->required();
  centreline_app->add_option("--units", centreline.unit, "What a number in the file means")
      ->check(CLI::IsMember({"mm", "cm", "m"}))
      ->capture_default_str();
  centreline_app->add_option("--start", centreline.start, "Where to begin; else at the widest end")->type_name("X,Y,Z");
  centreline_app->add_option("--end", centreline.ends, "Where branches end; else all that stand out")
      ->type_name("X,Y,Z");
  centreline_app->add_option("-o,--output", centreline.output, "A file that ends in .json or .vtp")->required();
  centreline_app->footer(
      "Examples:\n  ostium centreline coronaries.stl -o tree.json\n"
      "  ostium centreline aorta.obj --start 0,120,-30 --end 5,-200,-40 --end -60,-380,10 -o tree.vtp");

  ostium::PredictOptions predict;
  CLI::App* predict_app =
      app.add_subcommand("predict", "The static shapes that a measured set declares, nothing fitted");
  predict_app->add_option("set", predict.set, "The set's folder, or its measurement.json")
      ->required()
      ->type_name("SET");
  predict_app->add_option("-o,--out", predict.folder, "Where prediction.json and prediction.csv go")->type_name("DIR");
  predict_app->add_flag("--json", predict.json, "Print prediction.json, see data/schemas/prediction.schema.json");
  predict_app->footer("Examples:\n  ostium predict my-wire\n  ostium predict my-wire/measurement.json -o shapes");

  ostium::ExplainCommandOptions explain;
  CLI::App* explain_app =
      app.add_subcommand("explain", "Fits a measured set, says what is left, and what an effect would change");
  explain_app->add_option("set", explain.set, "The set's folder, or its measurement.json")
      ->required()
      ->type_name("SET");
  explain_app->add_option("-o,--out", explain.folder, "Where explanation.json, explanation.html and amended/ go")
      ->type_name("DIR");
  explain_app->add_option("--try", explain.tries, "An effect to switch on; with + between them, several together")
      ->type_name("EFFECT");
  explain_app
      ->add_option("--write-instrument", explain.instrument,
                   "Also here: the (innermost) instrument as it was found, for ostium run and the catalogue")
      ->type_name("FILE.json");
  explain_app->add_option("--threads", explain.threads, "Threads of each rank; 0: one for each core")
      ->check(CLI::Range(0, 1024));
  explain_app->add_flag("--json", explain.json, "Print explanation.json, see data/schemas/explanation.schema.json");
  explain_app->footer(
      "Examples:\n  ostium explain my-wire -o found\n  ostium explain my-tubes --try shaft_torsion -o found\n"
      "  mpirun -n 8 ostium explain my-tubes --try shaft_torsion[0] --threads 1 -o found");

  ostium::RunOptions run;
  CLI::App* run_app = app.add_subcommand("run", "Runs a script on a case, or in a mesh");
  const auto add_run_options = [](CLI::App* to, ostium::RunOptions& o) {
    to->add_option("--script", o.script, "One of `ostium scripts`, or a file")
        ->type_name("NAME|FILE")
        ->capture_default_str();
    to->add_option(
          "--set", o.set,
          "A tool's instrument (NAME or FILE.json), or person, heart_rate, breathing (breaths a minute), hand_speed, "
          "friction, begin (an artery), stuck (a tool whose drive is out)")
        ->type_name("KEY=VALUE");
    to->add_option("--seconds", o.seconds, "Most that are simulated")->check(CLI::Range(0.001, 36000.0));
    to->add_option("--units", o.unit, "What a number in a mesh means")
        ->check(CLI::IsMember({"mm", "cm", "m"}))
        ->capture_default_str();
    to->add_option("--entry", o.entry, "Of a mesh: where instruments come in")->type_name("X,Y,Z");
    to->add_option("--towards", o.towards, "Of a mesh: a point that the way in leads to")->type_name("X,Y,Z");
  };
  run_app->add_option("vessel", run.vessel, "A case (`ostium cases`, or a file), or a closed mesh: OBJ, STL, PLY")
      ->type_name("CASE|MESH")
      ->required();
  add_run_options(run_app, run);
  run_app
      ->add_option("--seed", run.seed, "0: exactly as the script says; others vary hands, roll and the heart's moment")
      ->capture_default_str();
  run_app->add_option("--out", run.folder, "Where run.h5 and metrics.json go")->type_name("DIR");
  run_app->add_option("--record", run.record, "What run.h5 holds; events: no states, so replay starts at the beginning")
      ->check(CLI::IsMember({"none", "events", "full"}))
      ->capture_default_str();
  std::string speed = "max";
  run_app->add_option("--speed", speed, "real: a step a millisecond; the result is the same")
      ->check(CLI::IsMember({"real", "max"}))
      ->capture_default_str();
  run_app
      ->add_option(
          "--device", run.device,
          "Hands at a tracking box instead of the script's: usb; auto: usb if one is plugged in; emulator: a "
          "scripted hand at an emulated box, which does what the script asks; keyboard: keyboard, mouse or gamepad, in "
          "the window")
      ->check(CLI::IsMember({"auto", "usb", "emulator", "keyboard"}));
  run_app->add_option("--display", run.display, "window: watch it live, in real time")
      ->check(CLI::IsMember({"none", "window"}))
      ->capture_default_str();
  run_app->add_option("--last-frame", run.last_frame, "The window's last picture")->type_name("FILE.png");
  run_app->add_option("--serial", run.serial, "Of the box; else the first that is found");
  run_app->add_flag("--film", run.film, "Film it as it goes: DIR/procedure.mp4");
  run_app->add_flag("--report", run.report, "DIR/report.html, events.csv and key-frames/");
  run_app->add_flag("--json", run.json, "Machine-readable, see data/schemas/run.schema.json");
  run_app->footer(
      "Examples:\n  ostium run rca-mid-focal --script aorta-arch-wire --out out\n"
      "  ostium run lad-proximal-eccentric --set wire=bentson --set person=3 --seed 7 --json\n"
      "  ostium run rca-mid-focal --script jr4-engages-rca --device usb --out out\n"
      "  ostium run rca-mid-focal --script jr4-engages-rca --device keyboard --out out\n"
      "  ostium run aorta.obj --entry -20,80,14 --towards -20,90,14 --script my-script.json");

  ostium::ReportOptions report;
  CLI::App* report_app =
      app.add_subcommand("report", "Recorded runs as a page: pictures, plots, metrics, steps, errors");
  report_app->add_option("file", report.files, "What `ostium run --out` recorded; several: side by side")
      ->type_name("RUN.h5");
  report_app->add_option("-o,--output", report.page, "The page, which needs nothing else")
      ->type_name("FILE.html")
      ->capture_default_str();
  report_app->add_option("--csv", report.csv, "Metrics and ticks, a row a run")->type_name("FILE.csv");
  report_app->add_option("--events", report.events, "Events of the first run")->type_name("FILE.csv");
  report_app->add_option("--code", report.codes, "Of participants or attempts, one a recording; no names")
      ->type_name("CODE");
  report_app->add_option("--scoring", report.scoring, "Steps and errors: a list of data/scoring, or a file")
      ->type_name("NAME|FILE.json")
      ->capture_default_str();
  report_app->add_option("--questionnaire", report.questionnaire, "Face and content questionnaires, a page with forms")
      ->type_name("FILE.html");
  report_app->add_flag("--pictures,!--no-pictures", report.pictures, "Pictures of key moments (default)");
  report_app->footer(
      "Examples:\n  ostium report out/run.h5 -o report.html\n"
      "  ostium report a.h5 b.h5 --code P07-1 P07-2 -o both.html --csv both.csv\n"
      "  ostium report --questionnaire forms.html");

  bool scripts_json = false;
  CLI::App* scripts_app = app.add_subcommand("scripts", "What scripts there are to run");
  scripts_app->add_flag("--json", scripts_json, "Machine-readable");
  scripts_app->footer("Examples:\n  ostium scripts\n  ostium scripts --json");

  ostium::SweepOptions sweep;
  CLI::App* sweep_app = app.add_subcommand("sweep", "A script many times: cases, seeds, parameters; one table");
  sweep_app->add_option("vessel", sweep.vessels, "Cases, or meshes")->type_name("CASE|MESH")->required();
  add_run_options(sweep_app, sweep.run);
  sweep_app->add_option("--seeds", sweep.seeds, "FROM..TO, or one")->capture_default_str();
  sweep_app->add_option("--vary", sweep.vary, "What --set takes, with several values")->type_name("KEY=A,B,C");
  sweep_app->add_option("--jobs", sweep.jobs, "Runs at the same time; 0: one for each core")
      ->check(CLI::Range(0, 1024));
  sweep_app->add_flag("--resume", sweep.resume, "Go on with a table that was not finished");
  sweep_app->add_option("-o,--output", sweep.table, "The table")->type_name("TABLE.csv")->required();
  sweep_app->footer(
      "Examples:\n  ostium sweep rca-mid-focal --seeds 1..100 -o table.csv\n"
      "  ostium sweep rca-mid-focal lcx-tubular --vary wire=cook-j,rosen,bentson --vary person=0,1,2 --seeds 1..10 -o "
      "table.csv");

  ostium::ReplayOptions replay;
  CLI::App* replay_app = app.add_subcommand("replay", "A recorded run once more: whether it is the same, and pictures");
  replay_app->add_option("file", replay.file, "What `ostium run --out` recorded")->type_name("RUN.h5")->required();
  replay_app->add_flag("--verify", replay.verify, "Compare every step; the default where no picture is asked for");
  replay_app->add_option("--from", replay.from_s, "Second to begin at")->check(CLI::NonNegativeNumber);
  replay_app->add_option("--seconds", replay.seconds, "Length of the film")->check(CLI::PositiveNumber);
  replay_app->add_option("--video", replay.video, "Film it")->type_name("FILE.mp4");
  replay_app->add_option("--dicom", replay.dicom, "Film it")->type_name("FILE.dcm");
  replay_app->add_option("--png", replay.png, "One picture, at --from")->type_name("FILE.png");
  ostium::PictureOptions& look = replay.picture;
  replay_app->add_option("--view", look.view, "Standard view (`ostium views`), instead of the run's")
      ->type_name("VIEW");
  replay_app->add_option("--lao", look.lao_deg, "Instead of the view's angle, degrees; negative: RAO");
  replay_app->add_option("--cran", look.cran_deg, "Instead of the view's angle, degrees; negative: caudal");
  replay_app->add_option("--field", look.field_mm, "Side of the detector's field, mm")->check(CLI::Range(50.0, 400.0));
  replay_app->add_option("--table", look.table_mm, "Isocentre in the patient: left, head, front, mm")
      ->expected(3)
      ->delimiter(',');
  replay_app->add_option("--pixels", look.pixels, "Along a side")
      ->check(CLI::IsMember({64, 128, 256, 512, 768, 1024}))
      ->capture_default_str();
  replay_app->add_flag("--cine", look.cine, "Cine dose instead of fluoroscopy");
  replay_app->add_flag("--plain", look.plain, "Without angles, times and dose on the picture");
  replay_app->add_flag("--monitor", look.monitor, "ECG, pressure and gauge under the picture");
  replay_app->add_option("--rate", look.frames_per_s, "Frames a second: 3.75, 7.5, 15, 30")->capture_default_str();
  replay_app->add_option("--fill", look.fill, "Coronary full of contrast")
      ->check(CLI::IsMember({"none", "left", "right"}))
      ->capture_default_str();
  replay_app->add_flag("--json", replay.json, "Machine-readable");
  replay_app->footer(
      "Examples:\n  ostium replay out/run.h5 --verify\n  ostium replay out/run.h5 --from 12.5 --view spider --video "
      "out.mp4\n"
      "  ostium replay out/run.h5 --from 8 --lao 40 --cran 0 --png moment.png");

  ostium::DeviceOptions device;
  CLI::App* device_app =
      app.add_subcommand("device", "The tracking box: look for it, watch it, calibrate it, emulate it");
  device_app->require_subcommand(1);
  CLI::App* device_list = device_app->add_subcommand("list", "Boxes that are plugged in");
  device_list->add_flag("--json", device.json, "Machine-readable");
  CLI::App* device_monitor = device_app->add_subcommand("monitor", "What the box says: tools, pressure, flow, pedals");
  device_monitor->add_option("--serial", device.serial, "Of the box; else the first that is found");
  device_monitor->add_option("--seconds", device.seconds, "Then end; else at Ctrl-C")->check(CLI::Range(0.01, 1e6));
  device_monitor->add_flag("--arm", device.arm, "Arm the clamps; they stay open");
  device_monitor->add_option("--push", device.push_N, "Arm them, and resist every push with so many N")
      ->check(CLI::Range(0.0, 8.0));
  device_monitor->add_flag("--emulator", device.emulator, "An emulated box whose wire goes in and out");
  device_monitor->add_flag("--json", device.json, "A line of JSON a second");
  device_monitor->footer("Examples:\n  ostium device monitor\n  ostium device monitor --emulator --seconds 20 --json");
  CLI::App* device_emulate = device_app->add_subcommand("emulate", "An emulated box on the network, by USB/IP");
  device_emulate->add_option("--port", device.port, "TCP port")->check(CLI::Range(1, 65535))->capture_default_str();
  device_emulate->add_flag("--any-host", device.any_host, "For other machines too, not for this one alone");
  device_emulate->add_flag("--still", device.still, "Nobody moves its tools");
  device_emulate->add_option("--seconds", device.seconds, "Then end; else at Ctrl-C")->check(CLI::Range(0.01, 1e6));
  device_emulate->footer("Examples:\n  ostium device emulate\n  ostium device emulate --any-host --port 3241");
  ostium::CalibrateOptions calibrate;
  CLI::App* device_calibrate =
      device_app->add_subcommand("calibrate", "The box's calibration: read, measured, written");
  device_calibrate->add_option("--serial", calibrate.serial, "Of the box; else the first that is found");
  device_calibrate->add_option("--write", calibrate.write, "Write this record, as this command prints one")
      ->type_name("FILE.json");
  device_calibrate->add_option("--track", calibrate.track, "That is measured")->check(CLI::Range(1, 4));
  device_calibrate->add_option("--length", calibrate.length_mm, "An instrument is pushed in by so many mm")
      ->check(CLI::Range(1.0, 2000.0));
  device_calibrate->add_option("--turns", calibrate.turns, "An instrument is turned clockwise so many times")
      ->check(CLI::Range(0.1, 1000.0));
  device_calibrate->add_option("--station", calibrate.station_mm, "How far the sensor lies outside the introducer, mm")
      ->check(CLI::Range(0.0, 1000.0));
  device_calibrate->add_option("--clamp", calibrate.clamp_N, "What the closed clamp holds, N")
      ->check(CLI::Range(0.01, 1000.0));
  device_calibrate->add_flag("--pressure-zero", calibrate.pressure_zero, "The indeflator is open to the air");
  device_calibrate->add_option("--pressure", calibrate.pressure_atm, "The indeflator's gauge shows so many atm")
      ->check(CLI::Range(-1.0, 40.0));
  device_calibrate->add_flag("--flow-zero", calibrate.flow_zero, "The syringe rests");
  device_calibrate->add_option("--volume", calibrate.volume_mL, "So many mL are injected")
      ->check(CLI::Range(0.1, 200.0));
  device_calibrate->add_option("--seconds", calibrate.seconds, "A measurement lasts so long; else until Enter")
      ->check(CLI::Range(0.1, 600.0));
  device_calibrate->add_flag("--dry-run", calibrate.dry_run, "Write nothing into the box");
  device_calibrate->footer(
      "Examples:\n  ostium device calibrate > box.json\n  ostium device calibrate --track 2 --length 200\n"
      "  ostium device calibrate --track 2 --turns 10\n  ostium device calibrate --pressure-zero\n"
      "  ostium device calibrate --write box.json");
  device_app->footer("Examples:\n  ostium device list\n  ostium device monitor --seconds 60");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    run.real = speed == "real";
    if (app.get_subcommands().empty()) return ostium::demonstration_command(demonstration);
    if (*run_app) return ostium::run_command(run);
    if (*device_list) return ostium::device_list_command(device);
    if (*device_emulate) return ostium::device_emulate_command(device);
    if (*device_calibrate) return ostium::device_calibrate_command(calibrate);
    if (*device_monitor) return ostium::device_monitor_command(device);
    if (*sweep_app) return ostium::sweep_command(sweep);
    if (*report_app) return ostium::report_command(report);
    if (*replay_app) return ostium::replay_command(replay);
    if (*scripts_app) return ostium::scripts_command(scripts_json);
    if (*verify_app) return ostium::verify_command(verify);
    if (*cases_app) return ostium::cases_command(cases);
    if (*centreline_app) return ostium::centreline_command(centreline);
    if (*import_app) return ostium::import_command(import);
    if (*check_app) return ostium::check_command(check);
    if (*views_app) return ostium::views_command(views_json);
    if (*frame_app) return ostium::frame_command(frame);
    if (*treat_app) return ostium::treat_command(treat);
    if (*inject_app) return ostium::inject_command(inject);
    if (*explain_app) return ostium::explain_command(explain);
    if (*predict_app) return ostium::predict_command(predict);
    if (*instruments_app) return ostium::instruments_command(instruments);
  } catch (const std::exception& error) {
    std::cerr << "ostium: " << error.what() << "\n";
    return 3;
  }
  return 2;
}
