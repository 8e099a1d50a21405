#!/usr/bin/env bash
# The command line: exit codes, help with examples, and JSON that parses.
set -euo pipefail
ostium=$1
. "$(dirname "$(readlink -f "$0")")/expect.sh"

expect 0 "verify" "$ostium" --help
for command in $("$ostium" --help | sed '1,/^Subcommands:/d; /^$/,$d' | awk '{print $1}'); do
  expect 0 "Examples" "$ostium" "$command" --help
done
expect 0 "0\." "$ostium" --version
expect 0 "pass" "$ostium" verify --only rod-static-0.4m-100
expect 0 '"pass": true' "$ostium" verify --only rod-static --json
expect 0 "elastica" "$ostium" verify --list
expect 0 '"what"' "$ostium" verify --list --json
expect 2 "no gate begins" "$ostium" verify --only no-such-gate
expect 2 "no gate begins" "$ostium" verify --only rod-staticX
expect 1 "could not be written" bash -c "'$ostium' verify --only rod-static --json > /dev/full"
# What cannot be printed is said, by every command alike; no file takes the place of a stream that is closed.
for command in views scripts "cases rca-mid-focal --json" --help; do
  expect 1 "could not be written" bash -c "'$ostium' $command > /dev/full"
  expect 1 "could not be written" bash -c "'$ostium' $command >&-"
done
expect 3 "" bash -c "'$ostium' check no-such.stl 2> /dev/full"
expect 3 "" bash -c "'$ostium' check no-such.stl 2>&-"
expect 0 "of [0-9]* pass" bash -c "'$ostium' verify --only rod-static-0.4m-100 2> /dev/full"
expect 2 "not expected" "$ostium" verify --quik
expect 2 "not expected" "$ostium" nonsense

expect 0 "guide-jl4-6f" "$ostium" instruments
expect 0 "sources:" "$ostium" instruments guide-jl4-6f
expect 0 '"EI1_Nmm2"' "$ostium" instruments wire-014-workhorse --json
expect 3 "there is no instrument" "$ostium" instruments no-such-thing
expect 1 "cannot be written" "$ostium" instruments --picture /proc/nowhere/all.svg
expect 3 "OSTIUM_DATA" env OSTIUM_DATA=/nowhere "$ostium" instruments

dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
: > "$dir/-dash.obj"
(cd "$dir" && expect 2 "write ./-dash.obj" "$ostium" check -dash.obj)
frame() { "$ostium" frame --pixels 128 "$@"; }
export -f frame
export ostium
expect 0 "kV" frame --view spider --fill left --overlay -o "$dir/frame.png"
expect 0 '"dap_per_frame_Gy_cm2"' frame --json -o "$dir/frame.png"
expect 0 "run.dcm" frame --frames 3 --fill right --guide right -o "$dir/run.dcm"
expect 0 '"iodine_balance"' "$ostium" inject --pixels 256 --seconds 0.4 --json -o "$dir/inject.png"
expect 3 "3 pictures, and .* shows 6 moments; expected 0.4 s" "$ostium" inject --seconds 0.2 -o "$dir/inject.png"
expect 3 "there is no case" "$ostium" inject no-such-case -o "$dir/inject.png"
expect 3 "png and .mp4" "$ostium" inject -o "$dir/inject.jpg"
expect 2 "volume" "$ostium" inject --volume -3 -o "$dir/inject.png"
# Libraries that are loaded when they are used are named where they are missing.
mkdir "$dir/damaged"
touch "$dir/damaged/libOSMesa.so.8" "$dir/damaged/libEGL.so.1" "$dir/damaged/libostium-openvdb.so"
expect 0 "install libosmesa6; drawn by scanline instead" env LD_LIBRARY_PATH="$dir/damaged" \
  "$ostium" frame --pixels 64 --frames 1 --renderer osmesa -o "$dir/frame.png"
expect 0 "^AP" frame --frames 1 --renderer osmesa -o "$dir/frame.png"
expect 0 "drawn by osmesa on llvmpipe" frame --frames 1 --renderer osmesa -o "$dir/frame.png"
expect 0 "install libegl1; drawn by scanline instead" env LD_LIBRARY_PATH="$dir/damaged" \
  "$ostium" frame --pixels 64 --frames 1 --renderer egl --json -o "$dir/frame.png"
expect 0 "drawn by \(egl on\|scanline instead\)" frame --frames 1 --renderer egl -o "$dir/frame.png"
# Ctrl-C, which ffmpeg gets too, leaves a film of what there was.
expect 0 "^130$" bash -c 'setsid "$ostium" frame --pixels 64 --frames 9000 -o "$0/cut.mp4" & p=$!
  until [[ -e $0/cut.mp4.unfinished ]]; do sleep 0.05; done; sleep 0.3; kill -INT -- -$p; wait $p; echo $?' "$dir"
[[ -s $dir/cut.mp4 && ! -e $dir/cut.mp4.unfinished ]]
# Every option of every command that takes a number: finite decimals only.
tried=0
for command in $("$ostium" --help | awk '/^Subcommands:/ { on = 1; next } on && /^  [a-z]/ { print $1 }') \
  "device monitor" "device emulate"; do
  # shellcheck disable=SC2086
  for option in $("$ostium" $command --help | grep -E '^  .*(FLOAT|INT)' | grep -oE -- '--[a-z-]+' | sort -u); do
    expect 2 "not a number" "$ostium" $command "$option=nan"
    tried=$((tried + 1))
  done
done
((tried > 40)) || { echo "only $tried options were tried"; exit 1; }
# An empty text is mostly a variable that is not set, and is never taken as "not given".
for option in --out --entry --record --serial --script --units --set; do
  expect 2 "it is empty" "$ostium" run rca-mid-focal --seconds 0.1 "$option" ""
done
expect 2 "it is not UTF-8" "$ostium" import nothing.stl -o "$dir/nobody" --title $'A\xff'
for value in inf 0x10 1e999 " 7" 7mm ""; do expect 2 "" "$ostium" inject "--volume=$value"; done
expect 2 "not a whole number from 0 on" "$ostium" frame --seed=-1
expect 3 "at most 1000000 of them" "$ostium" sweep rca-mid-focal --seeds 0..18446744073709551615 -o "$dir/sweep.csv"
expect 3 "FROM..TO" "$ostium" sweep rca-mid-focal --seeds=-1 -o "$dir/sweep.csv"
expect 3 'heart_rate is " 70"' "$ostium" run rca-mid-focal --set "heart_rate= 70"
expect 0 '"ffr_model"' "$ostium" treat --no-pictures --no-predilatation --no-postdilatation --hold 1 --json
expect 3 "there is no case" "$ostium" serve no-such-case
# Ended while dose and picture are still made ready, for seconds: at once, and nothing was recorded.
"$ostium" serve rca-mid-focal --out "$dir/served" >"$dir/links" &
served=$!
until grep -q viewers "$dir/links"; do sleep 0.01; done
kill -TERM "$served"
code=0 && wait "$served" || code=$?
((code == 143)) && [[ ! -e $dir/served ]]
expect 3 "there is no view" "$ostium" treat --view upwards -o "$dir/treat.png"
expect 3 "png is known" "$ostium" treat -o "$dir/treat.mp4"
expect 3 "there is no view" frame --view upwards -o "$dir/frame.png"
expect 3 "from -120.0 to 120.0 degrees" frame --lao 150 -o "$dir/frame.png"
expect 3 "from 85.0 to 125.0 cm" frame --sid 1400 -o "$dir/frame.png"
expect 3 "3.75, 7.5, 15 or 30" frame --rate 12 -o "$dir/frame.png"
expect 3 "shutter" frame --shutters 0.5,0.5,0,0.5 -o "$dir/frame.png"
expect 1 "cannot be written" frame -o /proc/nowhere/frame.png
expect 1 "cannot be written" frame -o /proc/nowhere/frame.dcm
expect 3 "png, .dcm and .mp4" frame -o "$dir/frame.jpg"
expect 0 "kV" frame rca-mid-focal --view lao --fill right --phase 0.4 -o "$dir/case.png"
expect 3 "there is no case" frame no-such-case -o "$dir/frame.png"
expect 2 "not in" frame --pixels 100 -o "$dir/frame.png"
if command -v ffmpeg >/dev/null; then
  expect 0 "loop.mp4" frame --frames 5 -o "$dir/loop.mp4"
  ln -s /dev/full "$dir/full.mp4"
  expect 1 "the video ended" frame --frames 5 -o "$dir/full.mp4"
fi
expect 1 "ffmpeg cannot be run" env PATH=/nowhere "$ostium" frame --pixels 128 --frames 2 -o "$dir/none.mp4"

expect 0 "spider" "$ostium" views
expect 0 '"lao_deg"' "$ostium" views --json
expect 0 "rca-mid-focal-radial" "$ostium" cases
expect 0 "Judkins right 4" "$ostium" cases rca-mid-focal
expect 0 '"stenosis_percent": 70' "$ostium" cases rca-mid-focal --json
expect 3 "there is no case" "$ostium" cases no-such-case
folder=$dir/files
mkdir "$folder"
printf 'v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n' >"$folder/whole.obj"

# Sessions: run, record, replay, sweep.
out=$folder/out
expect 0 "aorta-arch-wire" "$ostium" scripts
expect 0 '"instrument"' "$ostium" scripts --json
expect 0 "recorded in" "$ostium" run rca-mid-focal --script iliac-wire --out "$out"
grep -q '"outcome": "success"' "$out/metrics.json"
expect 0 "bit for bit" "$ostium" replay "$out/run.h5" --verify
expect 0 '"same": true' "$ostium" replay "$out/run.h5" --from 0.5 --json
expect 3 "there is nothing to verify" "$ostium" replay "$out/run.h5" --from 1 --verify
expect 2 "is not 0 or more" "$ostium" replay "$out/run.h5" --from=-1
# The first picture of a film is of the view that the run had.
expect 0 "8 frames" "$ostium" replay "$out/run.h5" --seconds 0.5 --pixels 64 --dicom "$out/film.dcm"
[[ ! -e $out/film-2.dcm ]]
expect 0 "moment.png" "$ostium" replay "$out/run.h5" --from 0.5 --view lao --pixels 128 --png "$out/moment.png"
# One picture is of its moment, a film beside it or not; --json is JSON whatever is made.
[[ $("$ostium" replay "$out/run.h5" --from 0.8 --pixels 64 --png "$out/alone.png") == *" at 0.800 s" ]]
[[ $("$ostium" replay "$out/run.h5" --from 0.2 --pixels 64 --png "$out/early.png") == *" at 0.200 s" ]]
"$ostium" replay "$out/run.h5" --from 0.8 --pixels 64 --png "$out/beside.png" --video "$out/beside.mp4" --verify --json |
  python3 -c 'import json, sys; told = json.load(sys.stdin); assert told["same"] and len(told["pictures"]) == 2'
cmp "$out/alone.png" "$out/beside.png"
expect 0 "run.html" "$ostium" report "$out/run.h5" -o "$out/run.html" --csv "$out/runs.csv" --events "$out/events.csv"
grep -q "not for decisions on a patient" "$out/run.html"
grep -q "tool_in" "$out/events.csv"
expect 3 "2 recordings" "$ostium" report "$out/run.h5" "$out/run.h5" --code A -o "$out/none.html"
expect 3 "no-such-list" "$ostium" report "$out/run.h5" --scoring no-such-list -o "$out/none.html"
expect 0 "" "$ostium" report --questionnaire "$out/forms.html"
expect 0 "rca-mid-focal-person-3 " "$ostium" play --list --person 3 --out "$out/play"
expect 3 "has no lesson \"no-such-case\"" "$ostium" play --case no-such-case --out "$out/play"
expect 2 "" "$ostium" play --person -1 --out "$out/play"
expect 0 "protocol.md" "$ostium" study --template "$out/study"
expect 3 "is there already" "$ostium" study --template "$out/study"
"$ostium" report "$out/run.h5" "$out/run.h5" --code P01 P03-1 --csv "$out/study/runs.csv" --no-pictures -o "$out/run.html" >/dev/null
expect 0 "study.html" "$ostium" study "$out/study/participants.csv" --runs "$out/study/runs.csv" -o "$out/study.html" --csv "$out/study.csv"
expect 0 '"same_everywhere"' "$ostium" study "$out/study/participants.csv" --runs "$out/study/runs.csv" -o "$out/study.html" --json
expect 3 "is no participant's code" "$ostium" study "$out/study/participants.csv" --runs "$out/runs.csv" -o "$out/none.html"
expect 3 "nothing to compare" "$ostium" study "$out/study/participants.csv" -o "$out/none.html"
[[ ! -e $out/none.html ]]
SDL_VIDEODRIVER=dummy expect 1 "time limit" "$ostium" run rca-mid-focal --script iliac-wire --display window --seconds 0.5 --film --out "$out/shown" \
  --last-frame "$out/shown.png"
[[ -s $out/shown.png ]]
SDL_VIDEODRIVER=none expect 3 "there is no window here" "$ostium" run rca-mid-focal --device keyboard
expect 1 "time limit" "$ostium" run rca-mid-focal --script iliac-wire --seconds 0.4 --out "$out/filmed" --film --report
[[ -s $out/filmed/procedure.mp4 && -s $out/filmed/report.html && -s $out/filmed/key-frames/01.png ]]
expect 1 "time limit" "$ostium" run rca-mid-focal --seconds 0.2 --speed real --record none --out "$out"
for record in all shapes=0 shapes=1e9 shapes=x full,; do
  expect 3 "expected none|events|full|shapes" "$ostium" run rca-mid-focal --record "$record" --out "$out"
done
sed 's/"name": "iliac-wire"/"name": "mine"/' "$(dirname "$0")/../../data/scripts/iliac-wire.json" >"$folder/copy-2.json"
expect 1 '"script": "mine"' "$ostium" run rca-mid-focal --script "$folder/copy-2.json" --seconds 0.1 --json
expect 130 "ended by the operator" timeout -s INT 120 bash -c "'$ostium' run rca-mid-focal --speed real --out '$out/int' & p=\$!
  while [[ ! -e '$out/int/run.h5' ]]; do sleep 0.05; done; sleep 0.7; kill -INT \$p; wait \$p"
expect 0 "bit for bit" "$ostium" replay "$out/int/run.h5"
expect 3 "another ostium writes there" bash -c "'$ostium' run rca-mid-focal --speed real --record none --out '$out/two' & p=\$!
  trap 'kill -TERM \$p; wait \$p' EXIT; while [[ ! -e '$out/two' ]]; do sleep 0.05; done; sleep 0.3
  '$ostium' run rca-mid-focal --seconds 0.1 --out '$out/two'"
expect 1 "is the disk full" bash -c "ulimit -f 80; trap '' XFSZ; '$ostium' run rca-mid-focal --script iliac-wire --out '$out/full'"
expect 0 "bit for bit" "$ostium" replay "$out/full/run.h5"
expect 3 "there is no case" "$ostium" run no-such-case
expect 3 "there is no script" "$ostium" run rca-mid-focal --script no-such-script
expect 3 "there is no instrument" "$ostium" run rca-mid-focal --set wire=no-such-wire
expect 3 "expected one of wire, person" "$ostium" run rca-mid-focal --set wyre=cook-j
expect 3 "where an instrument comes in" "$ostium" run "$folder/whole.obj"
expect 3 "there is no such file" "$ostium" replay "$out/none.h5"
# What cannot be done is refused before anything is built or made.
soon() { # soon WORD ARGUMENTS...: refused within two seconds of processor
  expect 3 "$1" bash -c 'ulimit -t 2; "$@"' soon "$ostium" "${@:2}"
}
soon "there is no view" replay "$out/run.h5" --view upwards --png "$out/moment.png"
soon "there is no picture to show that in" replay "$out/run.h5" --view lao
soon "there is no picture to show that in" replay "$out/run.h5" --pixels 64
soon "there is no picture to show that in" replay "$out/run.h5" --rate 30
soon "is the length of a film" replay "$out/run.h5" --seconds 1
soon "is the length of a film" replay "$out/run.h5" --seconds 1 --png "$out/moment.png"
soon "s long" replay "$out/run.h5" --from 60
soon "no frame rate of 7 a second" replay "$out/run.h5" --rate 7 --video "$out/moment.mp4"
soon "cannot be reached" replay "$out/run.h5" --lao 300 --png "$out/moment.png"
soon "png is known" replay "$out/run.h5" --png "$out/moment.bmp"
soon "mp4 is known" replay "$out/run.h5" --video "$out/moment.avi"
soon "dcm is known" replay "$out/run.h5" --dicom "$out/moment.png"
soon "LM or RCA" run rca-mid-focal --set begin=LAD2
soon "there is no view" inject --view upwards -o "$out/inject.png"
soon "has no place" run rca-mid-focal --film
soon "has no place" run rca-mid-focal --report
soon "made of a recording" run rca-mid-focal --report --record none --out "$out/refused"
soon "is of the window" run rca-mid-focal --last-frame "$out/last.png" --out "$out/refused"
soon "expected none|events" run rca-mid-focal --record all --out "$out/refused"
[[ ! -e $out/refused ]]
head -c 3000 "$out/run.h5" >"$out/cut.h5"
expect 3 "cut short" "$ostium" replay "$out/cut.h5"
# A byte here and there: read, or refused by name.
for at in 9 60 100 150 700 2100; do
  cp "$out/run.h5" "$out/byte.h5"
  printf '\377' | dd of="$out/byte.h5" bs=1 seek="$at" conv=notrunc status=none
  rc=0 said=$("$ostium" report --no-pictures "$out/byte.h5" -o "$out/byte.html" 2>&1) || rc=$?
  ((rc == 0)) || { ((rc == 3)) && grep -q "byte.h5: " <<<"$said"; } || { echo "byte $at: exit $rc, $said"; exit 1; }
done
sed 's/"speed_mm_s"/"speed_mms"/' "$(dirname "$0")/../../data/scripts/iliac-wire.json" >"$folder/iliac-wire.json"
expect 3 "iliac-wire.json:9: steps\[0\].speed_mms is not a key" "$ostium" run rca-mid-focal --script "$folder/iliac-wire.json"

sweep() { "$ostium" sweep rca-mid-focal --script iliac-wire --seconds 1 --vary wire=cook-j,bentson --seeds 1..2 "$@"; }
export -f sweep
expect 0 "4 runs" sweep -o "$out/one.csv" --jobs 1
expect 0 "4 runs" sweep -o "$out/two.csv" --jobs 2
cmp "$out/one.csv" "$out/two.csv"
# Two into one table: the first goes on, and is ended here.
twice=(sweep rca-mid-focal --script iliac-wire --seeds 1..200 -o "$out/twice.csv")
"$ostium" "${twice[@]}" & child=$!
for _ in $(seq 600); do if [[ -s $out/twice.csv.part ]]; then break; fi; sleep 0.1; done
sleep 0.3
expect 3 "another ostium writes there" "$ostium" "${twice[@]}" --resume
kill -TERM "$child"
wait "$child" || true
# Two that keep their recordings in one folder: runs of the same names would be mixed.
"$ostium" sweep rca-mid-focal --script iliac-wire --seeds 1..200 -o "$out/keeps.csv" --keep "$out/kept" & child=$!
for _ in $(seq 600); do if [[ -e $out/kept ]]; then break; fi; sleep 0.1; done
sleep 0.3
expect 3 "kept: another ostium writes there" sweep -o "$out/other.csv" --keep "$out/kept"
kill -TERM "$child"
wait "$child" || true
sweep -o "$out/three.csv" & child=$!
for _ in $(seq 100); do
  if [[ -e $out/three.csv.part ]] && (($(wc -l <"$out/three.csv.part") > 2)); then break; fi
  sleep 0.05
done
pkill -KILL -P "$child" 2>/dev/null || kill -KILL "$child" 2>/dev/null || true
wait "$child" 2>/dev/null || true
if [[ -e $out/three.csv.part ]]; then
  printf '7 rca-mid-focal,torn' >>"$out/three.csv.part"
  expect 3 "not finished" sweep -o "$out/three.csv"
  expect 3 "another sweep" "$ostium" sweep rca-mid-focal --resume --script iliac-wire --seeds 1..2 -o "$out/three.csv"
  expect 0 "4 runs" sweep -o "$out/three.csv" --resume
  expect 3 "to go on with" sweep -o "$out/three.csv" --resume
fi
cmp "$out/one.csv" "$out/three.csv"
# A lesion as long as the mean's artery: nobody whose own is shorter has room for it, and the sweep goes on.
sed 's/"name": "rca-diffuse"/"name": "long"/; s/"from_mm": 24, "length_mm": 32/"from_mm": 0, "length_mm": 95/; /"from_mm": 70/d; s/"calcified": true},/"calcified": true}/' \
  "$(dirname "$0")/../../data/cases/rca-diffuse.json" >"$folder/long.json"
expect 0 "for person 12" "$ostium" sweep "$folder/long.json" --script iliac-wire --seconds 0.1 --vary person=0,12 --seeds 0..0 -o "$out/four.csv"
grep -q "0,12,aborted,.*expected it within the branch" "$out/four.csv"
expect 3 "no run of the sweep can be made" "$ostium" sweep "$folder/long.json" --script iliac-wire --vary person=12 --seeds 0..0 -o "$out/five.csv"
[[ ! -e $out/five.csv.part ]]
expect 3 "FROM..TO" "$ostium" sweep rca-mid-focal --seeds 9..1 -o "$out/table.csv"
expect 3 "has 0.1 twice" "$ostium" sweep rca-mid-focal --vary friction=0.1,0.2,0.1 -o "$out/table.csv"
expect 3 "both give friction" "$ostium" sweep rca-mid-focal --set friction=0.2 --vary friction=0.1,0.3 -o "$out/table.csv"
expect 3 "has nothing twice" "$ostium" sweep rca-mid-focal --vary wire=, -o "$out/table.csv"
expect 3 "KEY=A,B,C" "$ostium" sweep rca-mid-focal --vary wire= -o "$out/table.csv"
