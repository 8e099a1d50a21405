#!/usr/bin/env bash
# 3D Slicer's centrelines, with radii: checked, imported, run in.
#   tests/integration/slicer_centrelines.sh OSTIUM
set -euo pipefail
ostium=$1
. "$(dirname "$(readlink -f "$0")")/expect.sh"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

cat >"$folder/lines.mrk.json" <<'END'
{"markups": [{"type": "Curve", "coordinateUnits": "mm", "controlPoints": [{"position": [0, 0, 0]}, {"position": [20, 5, 0]},
  {"position": [40, 0, 0]}], "measurements": [{"name": "Radius", "controlPointValues": [2, 1.8, 1.5]}]}]}
END
expect 0 "mm, as the file says" "$ostium" check "$folder/lines.mrk.json"
expect 0 "vessel 1" "$ostium" import "$folder/lines.mrk.json" -o "$folder/lines"
sed 's/20, 5, 0/20, 0, 0/' "$folder/lines.mrk.json" >"$folder/straight.mrk.json" # from its first point to its last
expect 0 "spans 40.0 mm" "$ostium" check "$folder/straight.mrk.json"
expect 0 "from   -     40.0 mm" "$ostium" centreline "$folder/straight.mrk.json" -o "$folder/straight.json"
# A run in it is of the vessels that it was made in.
expect 1 "time limit" "$ostium" run "$folder/lines" --script iliac-wire --seconds 0.1 --out "$folder/in-lines"
expect 0 "bit for bit" "$ostium" replay "$folder/in-lines/run.h5"
sed 's/1.5\]/1.6]/' "$folder/lines.mrk.json" >"$folder/wider.mrk.json"
expect 0 "vessel 1" "$ostium" import "$folder/wider.mrk.json" -o "$folder/lines"
expect 3 "have changed since" "$ostium" replay "$folder/in-lines/run.h5"
expect 3 "have changed since" "$ostium" report "$folder/in-lines/run.h5" -o "$folder/lines.html"
sed 's/Radius/Curvature/' "$folder/lines.mrk.json" >"$folder/bare.mrk.json"
expect 3 "has no radii; expected a measurement" "$ostium" centreline "$folder/bare.mrk.json" -o "$folder/tree.json"
expect 3 "makes a case of them" "$ostium" frame "$folder/lines.mrk.json" -o "$folder/frame.png"
# What a file says of its axes holds, also against --axes; places are said in the file's own.
sed 's/"type": "Curve"/&, "coordinateSystem": "RAS"/' "$folder/lines.mrk.json" >"$folder/ras.mrk.json"
expect 0 "axes: RAS, as the file says" "$ostium" import "$folder/ras.mrk.json" --entry 0,0,0 -o "$folder/ras"
grep -A3 '"axes": ' "$folder/ras/import.json" | grep -q -- -1.0
expect 3 "its axes are RAS, and --axes says LPS" "$ostium" import "$folder/ras.mrk.json" --axes LPS -o "$folder/ras"
expect 0 "axes, RAS" "$ostium" centreline "$folder/ras.mrk.json" -o "$folder/ras.json"
grep -q '^\[40.0' "$folder/ras.json"
expect 3 "expected files in the same axes" "$ostium" import "$folder/ras.mrk.json" "$folder/lines.mrk.json" -o "$folder/two"
