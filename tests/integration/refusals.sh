#!/usr/bin/env bash
# What is refused: said as what it is, before anything is read or written, and nothing is left behind.
set -euo pipefail
ostium=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

here=$(dirname "$(readlink -f "$0")")
. "$here/expect.sh"
cd "$folder"

# Pipes, sockets, devices and links in place of files: none is opened, as it would wait, or never end.
python3 -c 'import socket; socket.socket(socket.AF_UNIX).bind("socket.json")'
for ending in .json .h5 .stl .png ""; do
  mkfifo "pipe$ending"
  ln -s "round$ending" "round$ending"
done
refused() { # refused WORD ARGUMENTS...: within some seconds
  expect 3 "$1" timeout 20 "$ostium" "${@:2}"
}
round="symbolic link on the way leads to itself"
for what in "pipe:it is a pipe" "round:$round"; do
  for command in replay report; do
    refused "${what#*:}" "$command" "${what%:*}.h5"
    refused "${what#*:}" "$command" "${what%:*}"
  done
  for ending in .json ""; do
    file=${what%:*}$ending
    refused "${what#*:}" run rca-mid-focal --set "wire=$file"
    refused "${what#*:}" run rca-mid-focal --script "$file"
    refused "${what#*:}" run "$file"
    refused "${what#*:}" serve rca-mid-focal --scoring "$file"
    for command in learn explain predict; do refused "${what#*:}" "$command" "$file"; done
  done
  refused "${what#*:}" check "${what%:*}.stl"
  refused "${what#*:}" import "${what%:*}.stl" -o case
  refused "${what#*:}" picture "${what%:*}.png"
done
refused "it is a socket" predict socket.json
refused "it is a device" replay /dev/zero
mkfifo table.csv.part other.csv.part-1-of-2
refused "it is a pipe" sweep rca-mid-focal --script iliac-wire -o table.csv --resume
refused "it is a pipe" sweep --merge other.csv
mkdir -p learnt/first-steps
mkfifo learnt/first-steps/progress.json
refused "it is a pipe" learn --list --out learnt
TMPDIR=/nowhere refused "TMPDIR" serve rca-mid-focal
# A list of values is longer than any file's name, and is none.
expect 0 "1 runs" "$ostium" sweep rca-mid-focal --script iliac-wire --seconds 0.05 --seeds 1..1 -o many.csv --part 100/100 \
  --vary "person=$(seq -s, 1 100)"

# A run at a box that never was there is no success (or, where no bus can be looked at, refused).
code=0
said=$(timeout 60 "$ostium" run rca-mid-focal --script iliac-wire --device usb --seconds 0.2 2>&1) || code=$?
[[ $code == 3 || ($code == 1 && $said == *"never answered"*) ]]

# What goes against what else is said is not passed over.
refused "one emulated box, EMULATED" device monitor --emulator --serial X
expect 0 "running" "$ostium" device monitor --emulator --serial EMULATED --seconds 0.3
refused "one emulated box, EMULATED" run rca-mid-focal --device emulator --serial X
refused "is of a tracking box" run rca-mid-focal --serial X
refused "nothing of it is given" device calibrate --track 2
refused "nothing is measured" device calibrate --seconds 3
refused "is for a case" frame --phase 0.3 -o none.png
refused "is for the phantom" frame rca-mid-focal --stenosis 30 -o none.png
refused "is for the phantom" frame rca-mid-focal --guide none -o none.png
refused "angle inf degrees cannot be reached" frame --lao 1e308 -o none.png
expect 2 "--out beside --no-pictures would do nothing" "$ostium" treat --no-pictures -o none.png
expect 2 "--seeds beside --merge would do nothing" "$ostium" sweep --merge other.csv --seeds 1..4
expect 2 "not in range 0.01" "$ostium" inject --rate 0 -o none.png
expect 2 "not in range 0.01" "$ostium" inject --volume 0 -o none.png
mkdir frames
for name in 0 1 2 3 01; do echo >"frames/lumen-$name.obj"; done
refused "has the number of" import frames --sequence -o none

# A step that no tool of the script can do was done at once, in a run that succeeded.
script() { # script TOOL STEP [INSTRUMENT]: a script of one tool, called TOOL
  cat >mine.json <<END
{ "schema": "ostium-script/1", "name": "mine", "title": "a wire",
  "tools": [{ "name": "$1", "instrument": "${3:-rosen}" }],
  "steps": [$2] }
END
}
script wire '{ "do": "inflate", "gauge_atm": 3, "over_s": 5 }'
refused "mine.json:3: inflate: no tool has a balloon" run rca-mid-focal --script mine.json
script wire '{ "do": "deflate" }'
refused "mine.json:3: deflate: no tool has a balloon" run rca-mid-focal --script mine.json
script wire '{ "do": "inject", "rate_mL_s": 3, "volume_mL": 5 }'
refused "mine.json:3: inject: no tool is a catheter" run rca-mid-focal --script mine.json
# Nor did a balloon have to be in the body.
script balloon '{ "do": "inflate", "gauge_atm": 3, "over_s": 1, "timeout_s": 2 }' balloon-20x10
expect 1 "waiting for gauge_atm 3 (now no balloon is in the body)" "$ostium" run rca-mid-focal --script mine.json
script balloon '{ "do": "deflate", "timeout_s": 2 }' balloon-20x10
expect 1 "waiting for an empty balloon (no balloon is in the body)" "$ostium" run rca-mid-focal --script mine.json
script person '{ "do": "wait", "until": [{ "seconds": 1 }] }'
refused "mine.json:2: a tool is called person" run rca-mid-focal --script mine.json

# A picture would be in the way of the case, which appears as a whole.
refused "holds the case alone" import pipe.stl -o ./new-case --picture new-case/picture.svg
[[ ! -e new-case ]]
# What is written goes where a link leads, be there a file or not yet.
mkdir far && ln -s far/tree.json near.json && ln -s ../far.csv far/tree.json
python3 -B "$here/../tools/comparison/made_up_tube.py" tube.stl 2 60
expect 0 "branches" "$ostium" centreline tube.stl --units mm -o near.json
[[ -L near.json && -L far/tree.json && -s far.csv ]]

# A picture that was named and is not there is not passed over, though the others are measured.
expect 0 "frame.png" "$ostium" frame --pixels 256 --frames 1 -o frame.png
expect 0 "of the set are as in real ones" "$ostium" picture frame.png
refused "of the set are as in real ones" picture frame.png none.png
refused "none.png" picture frame.png none.png --json
# Nor is one that is named twice: it would count twice, and is always as like itself as can be.
refused "is named twice" picture frame.png "$folder/frame.png"
mkdir like && cp frame.png like && ln -s like alike
refused "is named twice" picture like --against alike
refused "is named twice" picture like like/frame.png

# A material that is missing colours nothing; it is not one from elsewhere, wherever the mesh is read from.
python3 - <<'END'
import math
rings = [(2 * math.cos(k * math.pi / 8), 2 * math.sin(k * math.pi / 8), z) for z in range(0, 61, 2) for k in range(16)]
faces = [(16 * i + k, 16 * i + (k + 1) % 16, 16 * i + 16 + (k + 1) % 16, 16 * i + 16 + k) for i in range(30) for k in range(16)]
with open("coloured.obj", "w") as file:
    file.write("mtllib not-there.mtl\n" + "".join("v %r %r %r\n" % p for p in rings))
    file.writelines("f " + " ".join(str(k + 1) for k in face) + "\n" for face in faces)
END
expect 1 "32 open edges" "$ostium" check --units mm coloured.obj
expect 1 "32 open edges" "$ostium" check --units mm "$folder/coloured.obj"

# Sizes that no vessel has are told as they are.
python3 -B "$here/../tools/comparison/made_up_tube.py" micrometres.stl 1500 12000
python3 -B "$here/../tools/comparison/made_up_tube.py" wide.stl 50 100
refused "micrometres have to be divided by 1000" check micrometres.stl
expect 1 "vessels: 9[0-9][.]" "$ostium" check wide.stl

# What cannot be put where it should go is refused before the work.
touch before
mkdir folder.png folder.csv folder.html
cannot() { # cannot ARGUMENTS...: within a second of processor
  expect 1 "cannot be written" bash -c 'ulimit -t 1; "$@"' cannot "$ostium" "$@"
}
cannot treat -o folder.png
cannot inject -o folder.png
cannot sweep rca-mid-focal -o folder.csv
cannot report none.h5 -o folder.html
cannot treat -o before/pictures/treat.png
cannot explain bend --write-instrument folder.png
[[ ! -e folder.csv.part ]]
# A device gets what is written, and nothing is kept beside it.
expect 1 "/dev/full: cannot be written" "$ostium" sweep rca-mid-focal --script iliac-wire --seconds 0.05 -o /dev/full
refused "keeps nothing" sweep rca-mid-focal --script iliac-wire --seconds 0.05 -o /dev/full --part 1/2
[[ ! -e /dev/full.part && ! -e /dev/full.part-1-of-2 ]]
# What names a file has does not reach the terminal as it is: C0, DEL, and C1, which is two bytes of UTF-8.
for name in $'no-\x1b[2Jsuch.stl' $'no-\xc2\x9b2Jsuch.stl' $'no-\nsuch.stl' $'no-\x7fsuch.stl'; do
  expect 2 "holds a control character" "$ostium" check "$name"
  expect 2 "holds a control character" "$ostium" run rca-mid-focal --seconds 0.1 --out "$name"
done
OSTIUM_DATA=$'/no-\xc2\x9bwhere' expect 3 "/no-[?]where" "$ostium" scripts

expect 1 "limited-frame.png: cannot be written .File too large" bash -c 'ulimit -f 1; exec "$@"' limited "$ostium" \
  frame --pixels 128 --frames 1 -o limited-frame.png
[[ ! -e limited-frame.png && ! -e limited-frame.png.unfinished ]]

# What is given twice is not passed over, however it is written.
refused "person is set already" frame rca-mid-focal --set person=1 --set person=2 -o none.png
refused "heart_rate has 70 twice" sweep rca-mid-focal --vary heart_rate=70,7e1 -o twice.csv
refused "has A twice" report none.h5 other.h5 --code A A -o none.html
refused "is the table, too" sweep rca-mid-focal -o twice.csv --keep ./twice.csv
[[ ! -e twice.csv && ! -e twice.csv.part ]]

# A lesion where there is no model of one is refused where the case is read.
sed '/"branch"/s/"RCA"/"aorta"/; s/"name": .*/"name": "in-aorta",/' "$here/../../data/cases/rca-mid-focal.json" >in-aorta.json
refused "in-aorta.json:[0-9]*: lesions.0..branch is \"aorta\"; expected a coronary artery" inject in-aorta.json -o none.png

# A name may be as long as the file system takes.
long=$(printf '%0251d' 0).png
expect 0 "" "$ostium" frame --pixels 128 --frames 1 -o "$long"
[[ -s $long ]]

# A folder that is gone is said to be.
mkdir gone
(cd gone && rmdir ../gone && refused "the folder that this runs in is gone" run rca-mid-focal --out there)
(cd "$folder" && mkdir gone && cd gone && rmdir ../gone && refused "the folder that this runs in is gone" cases ./x)

# A course is refused with its file and line, and what would do nothing is not passed over.
expect 2 "would do nothing" "$ostium" learn --list --lesson whole
sed 's/"first-steps"/"my-steps"/; s/"lesson-film"/"no-list"/' "$here/../../data/courses/first-steps.json" >my-steps.json
refused "my-steps.json:[0-9]*: scoring of lesson film: no-list" learn my-steps.json --list
sed 's/"first-steps"/"my-steps"/; s/"event": "nitrate"/"event": "nitrat"/' "$here/../../data/courses/first-steps.json" >my-steps.json
refused "my-steps.json:[0-9]*: an instruction of lesson film waits for the event .nitrat.; expected a name of" learn my-steps.json --list

# A refusal leaves everything as it was.
"$ostium" explain --template three_point_bend -o bend >/dev/null
ls bend >before
mkdir found && cp -r bend found/amended
refused "a file of the measured set" explain found/amended -o found
mv found/amended/b0.csv found/amended/prediction.csv
sed 's/b0.csv/prediction.csv/' bend/measurement.json >found/amended/measurement.json
refused "a file of the measured set" predict found/amended -o found/amended
cmp bend/b0.csv found/amended/prediction.csv
ln -s bend bent
refused "bend and bent/measurement.json are one set" characterise bend bent/measurement.json --like rosen -o wire.json
# Nor under another name, as a whole or in part: what was measured counts once.
cp -r bend copied
refused "b0 is the same measurement as b0 of bend/measurement.json" characterise bend copied --like rosen -o wire.json
[[ ! -e wire.json ]]
sed 's/"b1"/"again"/; s/"b1.csv"/"b0.csv"/' bend/measurement.json >copied/measurement.json
expect 0 "b0 and again are the same measurement" "$ostium" explain copied -o none
rm -r none
# Noise below what the numbers' own digits make kept the search busy for minutes.
sed 's/"force_N": 0[.][0-9]*/"force_N": 1e-9/; s/"displacement_mm": 0[.][0-9]*/"displacement_mm": 0/' bend/measurement.json \
  >copied/measurement.json
refused "all are written to 1e-05 N: rounding alone" explain copied -o none
refused "measurement.json is there already" explain --template projections -o bend
ls bend | cmp - before
refused "there is no template" explain --template nothing -o none
expect 2 "expected one of them" "$ostium" explain bend --template projections -o none
echo none >none.h5
refused "is no HDF5 file" report none.h5 -o none.html --questionnaire none-forms.html --events none.csv
[[ ! -e none && ! -e none.html && ! -e none-forms.html && ! -e none.csv ]]
"$ostium" explain --template projections -o seen >/dev/null
python3 - <<'END'
import json
told = json.load(open("seen/measurement.json"))
for name, noise in ("no-noise", None), ("tiny", 1e-9), ("digits", 0.02):
    told["imaging"]["noise_sigma_px"] = noise
    json.dump(told, open(f"seen/{name}.json", "w"))
END
refused "imaging.noise_sigma_px is 1e-09; expected .* 1e-3 or more" explain seen/tiny.json -o none
refused "written to 0.1 px: rounding alone makes 0.029" explain seen/digits.json -o none
refused "its noise is not declared" predict seen/no-noise.json --with rosen -o none
[[ ! -e none ]]
# A folder that may not be written in is refused before anything is built; root may write everywhere.
mkdir closed && chmod 555 closed
who=()
if [[ $(id -u) == 0 ]]; then
  chmod 711 .
  who=(setpriv --reuid=65534 --regid=65534 --clear-groups)
fi
if "${who[@]}" test -x "$ostium"; then
  expect 1 "^ostium: closed: cannot be written (Permission denied)" "${who[@]}" "$ostium" run rca-mid-focal \
    --script iliac-wire --seconds 0.1 --out closed
fi
# Endings say what a file is to be, in upper case, too.
"$ostium" frame rca-mid-focal --pixels 64 -o FRAME.PNG >/dev/null
[[ $(head -c 4 FRAME.PNG) == $'\x89PNG' ]]
