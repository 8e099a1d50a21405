#!/usr/bin/env bash
# commands.sh OSTIUM BENCH: `ostium device` and `ostium run --device usb` on bench 1; without a box, too.
set -euo pipefail
ostium=$1 bench=$2

. "$(dirname "$(readlink -f "$0")")/../expect.sh"
plugged() { LD_PRELOAD=$bench:libumockdev-preload.so.0 "$@"; }
plugged true 2>/dev/null || exit 77
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT

expect 0 "Examples" "$ostium" device --help
expect 2 "subcommand" "$ostium" device
expect 0 "wire" "$ostium" device monitor --emulator --seconds 0.3
expect 0 '"sight":"seen"' "$ostium" device monitor --emulator --seconds 2 --json
expect 0 "usbip attach" "$ostium" device emulate --seconds 0.1 --port 32401
expect 3 "not plugged in" "$ostium" device calibrate

expect 0 "OST-0001" plugged "$ostium" device list
expect 0 '"calibrated": 20260101' plugged "$ostium" device list --json
expect 0 "seen" plugged "$ostium" device monitor --seconds 1.5
expect 0 '"lost":0' plugged "$ostium" device monitor --seconds 0.5 --json
plugged "$ostium" device calibrate >"$dir/record.json"
grep -q '"mm_per_count": 0.01' "$dir/record.json"
sed 's/"date": [0-9]*/"date": 20260303/; s/"pressure_offset_atm": [^,]*/"pressure_offset_atm": 0.25/' "$dir/record.json" >"$dir/new.json"
expect 0 '"pressure_offset_atm": 0.25' plugged "$ostium" device calibrate --write "$dir/new.json"
expect 0 "written to" plugged "$ostium" device calibrate --pressure-zero --seconds 0.3
expect 0 '"mm_per_count": 0\.0' plugged "$ostium" device calibrate --track 2 --length 60 --seconds 2 --dry-run
expect 3 "at least 100" plugged "$ostium" device calibrate --track 4 --length 60 --seconds 0.2
expect 3 "the input ended before Enter" plugged "$ostium" device calibrate --track 2 --length 60 </dev/null
expect 3 "track 1 to 4" plugged "$ostium" device calibrate --length 60
sed 's/"tracks"/"trakcs"/' "$dir/record.json" >"$dir/wrong.json"
expect 3 "wrong.json:[0-9]*: .*trakcs" plugged "$ostium" device calibrate --write "$dir/wrong.json"
sed 's/OST-0001/OST-0002/' "$dir/record.json" >"$dir/other.json"
expect 3 'serial is "OST-0002"; expected "OST-0001"' plugged "$ostium" device calibrate --write "$dir/other.json"
sed 's/"date": [0-9]*/"date": 20261399/' "$dir/record.json" >"$dir/day.json"
expect 3 "date is 20261399" plugged "$ostium" device calibrate --write "$dir/day.json"
sed 's/"mm_per_count": 0.01/"mm_per_count": 0/' "$dir/record.json" >"$dir/zero.json"
expect 3 "mm per count is 0" plugged "$ostium" device calibrate --write "$dir/zero.json"

# Without a box a log says so, once.
"$ostium" run rca-mid-focal --script iliac-wire --device usb --seconds 0.5 >/dev/null 2>"$dir/log" || true
(($(grep -c "not plugged in" "$dir/log") == 1)) || { cat "$dir/log" && exit 1; }

# People at the box: the script's instruments, their hands; the recording replays without it.
expect 0 "ended: time limit" plugged "$ostium" run rca-mid-focal --script iliac-wire --device usb --seconds 2 --out "$dir/usb"
expect 0 "bit for bit" "$ostium" replay "$dir/usb/run.h5" --verify
expect 0 '"device": {' "$ostium" run rca-mid-focal --script iliac-wire --device emulator --json
