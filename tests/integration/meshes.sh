#!/usr/bin/env bash
# Meshes of one's own by the command line: check, centreline and import; what may be written where.
set -euo pipefail
ostium=$1
. "$(dirname "$(readlink -f "$0")")/expect.sh"

dir=$(mktemp -d)
folder=$dir/meshes
mkdir "$folder" "$dir/damaged"
trap 'rm -rf "$dir"' EXIT
touch "$dir/damaged/libostium-openvdb.so"
frame() { "$ostium" frame --pixels 128 "$@"; }
export -f frame
export ostium
printf 'v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n' >"$folder/whole.obj"
printf 'v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\n' >"$folder/open.obj"
expect 1 "no fault, but this is no vessel" "$ostium" check "$folder/whole.obj"
expect 1 "3 open edges" "$ostium" check "$folder/open.obj"
expect 1 '"sound": false' "$ostium" check --json --units cm "$folder/open.obj"
expect 3 "there is no such file" "$ostium" check "$folder/none.obj"
expect 1 '"no_vessel": "this is no vessel' "$ostium" check --json --units cm "$folder/whole.obj"
expect 1 "no vessel" "$ostium" check "$folder/whole.obj" --picture "$folder/whole.svg"
expect 3 "png and .svg are known" "$ostium" check "$folder/whole.obj" --picture "$folder/whole.bmp"
sed 's/9/900000/g' "$folder/whole.obj" >"$folder/huge.obj"
expect 3 "expected vessels" "$ostium" import "$folder/huge.obj" -o "$folder/case"
expect 3 "this is no vessel" "$ostium" import --units mm "$folder/whole.obj" -o "$folder/case"
expect 3 "cannot be read as a mesh" bash -c "printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\n' > '$folder/none.obj'; '$ostium' import '$folder/none.obj' -o '$folder/case'"
# A body of revolution with a spout: no vessel, in whatever unit.
awk 'function row(x, z, r, n,  i) { for (i = 0; i < n; ++i) print "v", x + r * cos(6.2831853 * i / n), r * sin(6.2831853 * i / n), z }
  function tube(first, rows, n,  i, j, a, b) {
    for (j = 0; j + 1 < rows; ++j) for (i = 0; i < n; ++i) { a = first + j * n; b = (i + 1) % n
      print "f", a + i, a + b, a + n + b, a + n + i }
    printf "f"; for (i = n - 1; i >= 0; --i) printf " %d", first + i; print ""
    printf "f"; for (i = 0; i < n; ++i) printf " %d", first + (rows - 1) * n + i; print "" }
  BEGIN { split("12 18 20 19 15 9 3", r); for (j = 1; j <= 7; ++j) row(0, 4 * j, r[j], 24); for (j = 0; j < 4; ++j) row(16 + 5 * j, 12 + 4 * j, 5 - j, 12)
    tube(1, 7, 24); tube(169, 4, 12) }' >"$folder/teapot.obj"
expect 3 "no unit makes a vessel" "$ostium" import "$folder/teapot.obj" -o "$folder/case"
expect 3 "this is no vessel" "$ostium" import --units mm "$folder/teapot.obj" -o "$folder/case"
# A straight vessel, 40 long and 3 wide: a coronary artery in mm, an aorta in cm. Its file may say which.
awk 'BEGIN { n = 24; r = 60; for (j = 0; j < r; ++j) for (i = 0; i < n; ++i)
    print "v", 1.5 * cos(6.2831853 * i / n), 1.5 * sin(6.2831853 * i / n), 40 * j / (r - 1)
  for (j = 0; j + 1 < r; ++j) for (i = 0; i < n; ++i) { a = 1 + j * n; b = (i + 1) % n
    print "f", a + i, a + b, a + n + b, a + n + i } }' >"$folder/vessel.obj"
awk -v n=24 -v r=60 '{ print } END { for (i = 1; i < n - 1; ++i) { print "f", 1, 2 + i, 1 + i; a = 1 + (r - 1) * n; print "f", a, a + i, a + i + 1 } }' \
  "$folder/vessel.obj" >"$folder/closed.obj"
expect 0 '"sound": true' "$ostium" check --json --units mm "$folder/closed.obj"
expect 0 "sound" "$ostium" check --units cm "$folder/closed.obj"
(printf '# unit: mm\n'; cat "$folder/closed.obj"; awk -v n=1440 '/^v/ { $2 += 20; print } /^f/ { print "f", $2 + n, $3 + n, $4 + n, $5 ? $5 + n : "" }' "$folder/closed.obj") >"$folder/pair.obj"
expect 0 "2 separate pieces" "$ostium" centreline "$folder/pair.obj" -o "$folder/pair.json"
# A start in one of them, or outside of both but nearest to it, means that one: their axes are x = 0 and x = 20.
for start in 0,0,10:0 -3,0,10:0 8,0,20:0 20,0,10:20 23,0,10:20 12,0,20:20; do
  expect 0 "separate pieces" "$ostium" centreline "$folder/pair.obj" --start="${start%:*}" -o "$folder/pair.json"
  python3 - "$folder/pair.json" "${start#*:}" <<'END' || { echo "a start at ${start%:*} means the other piece"; exit 1; }
import json, sys
spheres = [s for branch in json.load(open(sys.argv[1]))["branches"] for s in branch["spheres"]]
sys.exit(not (spheres and all(abs(s[0] - float(sys.argv[2])) < 1.6 for s in spheres)))
END
done
printf 'v 0 0 0\nv 1 0 0\nf 1 2 2\n' >"$folder/flat.obj"
expect 3 "no triangle in it has a width" "$ostium" check --units mm "$folder/flat.obj"
for command in "import -o $folder/case" check "centreline -o $folder/tree.json"; do
  expect 3 "its numbers may be mm or cm" "$ostium" $command "$folder/vessel.obj"
done
(printf '# unit: mm\n'; cat "$folder/vessel.obj") >"$folder/marked.obj"
expect 3 "install libostium-openvdb.so beside ostium" env LD_LIBRARY_PATH="$dir/damaged" \
  "$ostium" import "$folder/marked.obj" -o "$folder/single" --motion none
# It is no heart, unless somebody says so.
expect 0 '"beats": false' "$ostium" import "$folder/marked.obj" -o "$folder/single" --motion none --json
expect 0 '"beats": true' "$ostium" import "$folder/marked.obj" -o "$folder/single" --motion coronary --json
# There is no circulation in it, which contrast and treatment need.
for command in "inject" "treat --no-pictures"; do
  expect 3 "no coronary artery leaves an aorta" "$ostium" $command "$folder/single"
done
cat >"$folder/pressed.json" <<'END'
{ "schema": "ostium-script/1", "name": "pressed", "title": "contrast",
  "tools": [{ "name": "guide", "instrument": "guide-jr4-6f" }],
  "steps": [{ "do": "inject", "rate_mL_s": 3, "volume_mL": 5 }] }
END
expect 3 "pressed.json:3: inject: no blood flows in this vessel" "$ostium" run "$folder/single" --script "$folder/pressed.json"
expect 3 "this patient has no LM" frame "$folder/single" --fill left -o "$folder/filled.png"
expect 0 "AP" frame "$folder/single" -o "$folder/empty.png"
expect 2 "it is empty" "$ostium" import "$folder/marked.obj" -o ""
expect 2 "it is empty" "$ostium" run ""
# A throat in 3.4 mm, DEPTH of its width, in the middle of ROWS times 0.4 mm.
throat() {  # DEPTH ROWS
  awk -v depth="$1" -v r="$2" 'BEGIN { n = 32; for (j = 0; j < r; ++j) for (i = 0; i < n; ++i) {
    z = 0.4 * j; x = (z - 0.2 * (r - 1)) / 4; w = 1.7 * (1 - depth * (x * x < 1 ? 0.5 * (1 + cos(3.14159265 * x)) : 0))
    print "v", w * cos(6.2831853 * i / n), w * sin(6.2831853 * i / n), z }
  for (j = 0; j + 1 < r; ++j) for (i = 0; i < n; ++i) { a = 1 + j * n; b = (i + 1) % n
    print "f", a + i, a + b, a + n + b, a + n + i } }'
}
# 0.9 mm, too small a share of a long vessel to set its grid; 0.34 mm, which the first grid closes.
throat 0.73 301 >"$folder/throat.obj"
expect 0 '"stenosis_percent": 7[234]\.' "$ostium" import "$folder/throat.obj" -o "$folder/throat" --units mm --json
throat 0.9 101 >"$folder/tight.obj"
expect 0 '"stenosis_percent": \(89\|90\|91\)\.' "$ostium" import "$folder/tight.obj" -o "$folder/tight" --units mm --json

# A run in it is shown and reported as long as its case is the same, its entry included.
cat >"$folder/still.json" <<'END'
{ "schema": "ostium-script/1", "name": "still", "title": "A wire that waits",
  "tools": [{ "name": "wire", "instrument": "wire-014-workhorse" }],
  "steps": [{ "do": "wait", "until": [{ "seconds": 0.2 }] }] }
END
"$ostium" run "$folder/throat" --script "$folder/still.json" --out "$folder/run" >/dev/null
expect 0 "0.100 s" "$ostium" replay "$folder/run/run.h5" --from 0.1 --pixels 64 --png "$folder/moment.png"
expect 3 "no blood flows" "$ostium" replay "$folder/run/run.h5" --monitor --video "$folder/none.mp4"
sed -i -E 's/("access_mm": \[[^,]*, [^,]*\.)./\19/' "$folder/throat/anatomy.json"
for command in "replay --png $folder/moment.png" "report -o $folder/report.html"; do
  expect 3 "have changed since" "$ostium" $command "$folder/run/run.h5"
done

# Instruments that the vessel has no room for, and ways in that lead into its wall.
awk '/^v/ { print "v", $2 / 3, $3 / 3, $4; next } { print }' "$folder/closed.obj" >"$folder/thin.obj"
sed 's/wire-014-workhorse/guide-jr4-6f/' "$folder/still.json" >"$folder/thick.json"
way_in=(--units mm --entry 0,0,10 --towards)
expect 3 "mm wide where instruments come in, and wire is 2" "$ostium" run "$folder/thin.obj" --script "$folder/thick.json" "${way_in[@]}" 0,0,20
expect 0 "leads into the wall after 1.5 mm" "$ostium" run "$folder/closed.obj" --script "$folder/still.json" "${way_in[@]}" 1,0,10
expect 3 "is a mesh; expected a case" "$ostium" frame "$folder/throat.obj" -o "$folder/none.png"

# What is not an import's own is never lost to one.
echo mine >"$folder/mine.txt"
for place in mine.txt not-there/../mine.txt; do
  expect 3 "is no folder" "$ostium" import "$folder/marked.obj" -o "$folder/$place"
done
cp "$folder/mine.txt" "$folder/single/run.h5"
expect 3 "holds run.h5, too" "$ostium" import "$folder/marked.obj" -o "$folder/single"
[[ $(cat "$folder/mine.txt" "$folder/single/run.h5") == $'mine\nmine' && ! -e $folder/not-there ]]
expect 3 "is a folder, not a file; expected a recording" "$ostium" report "$folder/single"
rm "$folder/single/run.h5"
mkdir "$folder/twice.unfinished"
expect 3 "another ostium writes there" flock "$folder/twice.unfinished" "$ostium" import "$folder/marked.obj" -o "$folder/twice"
rmdir "$folder/twice.unfinished"
mv "$folder/single" "$folder/renamed"
expect 3 "has no renamed.json" "$ostium" cases "$folder/renamed"
mv "$folder/renamed" "$folder/single"
for name in RCA LM; do
  expect 3 "a coronary artery beats" "$ostium" import "$folder/marked.obj" -o "$folder/case" --rename "vessel 1=$name"
done
expect 3 "add --sequence" "$ostium" import "$folder/marked.obj" -o "$folder/case" --motion own
expect 3 "leave one of them out" "$ostium" import "$folder/marked.obj" -o "$folder/case" --motion none --sequence
expect 1 '"unit_from": "file"' "$ostium" check --json "$folder/marked.obj"
expect 1 '"unit": "cm"' "$ostium" check --json --units cm "$folder/marked.obj"
(printf '# unit: cm\n'; cat "$folder/vessel.obj") >"$folder/other.obj"
expect 3 "expected files of one unit" "$ostium" import "$folder/marked.obj" "$folder/other.obj" -o "$folder/case"
expect 3 "its numbers may be mm or cm" "$ostium" run "$folder/vessel.obj" --entry 0,0,1 --towards 0,0,9
head -c -1 "$folder/closed.obj" >"$folder/clipped.obj"
expect 1 "clipped.obj has no end" "$ostium" run "$folder/clipped.obj" --units mm --entry 0,0,1 --towards 0,0,9 \
  --script iliac-wire --seconds 0.01
expect 3 "has no inside" "$ostium" run "$folder/marked.obj" --entry 0,0,1 --towards 0,0,9 --out "$dir/left/behind"
[[ ! -e $dir/left ]] || { echo "a run that is refused leaves folders behind"; exit 1; }
# What is written takes the place of nothing that is read, nor of what else is written.
cp "$folder/vessel.obj" "$folder/own.obj"
ln -s own.obj "$folder/link.json"
expect 3 "would take the place of what is read" "$ostium" centreline --units mm "$folder/own.obj" -o "$folder/link.json"
expect 3 "would take the place of what is read" "$ostium" sweep rca-mid-focal --script "$folder/own.obj" -o "$folder/own.obj"
expect 3 "are one file" "$ostium" report "$folder/own.obj" --csv "$folder/a" --events "$folder/./a"
expect 3 "are one file" "$ostium" report "$folder/own.obj" --csv report.html
"$ostium" explain --template projections -o "$folder/set" >/dev/null
expect 3 "a file of the measured set" "$ostium" explain "$folder/set" --write-instrument "$folder/set/measurement.json"
expect 3 "a file of the measured set" "$ostium" explain "$folder/set" --write-instrument "$folder/set/clicks.csv"
expect 3 "is set already" "$ostium" run rca-mid-focal --set person=1 --set person=2
# In metres nothing is welded that should not be.
awk '$1 == "v" { print "v", $2 / 1000, $3 / 1000, $4 / 1000; next } { print }' "$folder/vessel.obj" >"$folder/metres.obj"
expect 1 '"welded_vertices": 0' "$ostium" check --json "$folder/metres.obj"
expect 1 '"unit": "m"' "$ostium" check --json "$folder/metres.obj"
head -c 40 "$folder/teapot.obj" >"$folder/cut.obj"
expect 3 "cut.obj: cannot be read" "$ostium" import "$folder/cut.obj" -o "$folder/case"
printf 'ply\nformat ascii 1.0\nelement vertex 3\n' >"$folder/cut.ply"
expect 3 "is cut short" "$ostium" import "$folder/cut.ply" -o "$folder/case"
expect 3 "cannot be read" bash -c "printf '{\"asset\":{\"version\":\"2.0\"}' >'$folder/cut.gltf'; '$ostium' check '$folder/cut.gltf'"
# What others made may be damaged in any way: it is named, and nothing is ended by it.
printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n9 0 0\n0 9 0\n0\n' >"$folder/no-corners.ply"
expect 3 "no-corners.ply: .*has no corners" "$ostium" check "$folder/no-corners.ply"
printf 'mtllib /etc/passwd\n' | cat - "$folder/whole.obj" >"$folder/outside.obj"
expect 3 "does not lie in its folder" "$ostium" check "$folder/outside.obj"
for ending in glb fbx 3ds dae x3d off vtp; do
  head -c 3000 "$ostium" >"$folder/program.$ending"
  expect 3 "program.$ending: " "$ostium" check "$folder/program.$ending"
done
cp "$folder/whole.obj" "$folder/whole.blend"
expect 3 "names nothing that is read .*\.vtp.*\.mrk\.json" "$ostium" check "$folder/whole.blend"
expect 3 "names nothing that is read" "$ostium" import "$folder/whole.blend" -o "$folder/case"
expect 3 "right-handed" "$ostium" import "$folder/whole.obj" --axes LPI -o "$folder/case"
expect 3 "gets another name already" "$ostium" import "$folder/whole.obj" --rename 1=a 1=b -o "$folder/case"
expect 3 "FOUND=WANTED" "$ostium" import "$folder/whole.obj" --rename x -o "$folder/case"
expect 3 "expected a name of at most" "$ostium" import "$folder/whole.obj" --rename "1=../x" -o "$folder/case"
expect 3 "a case that ships" "$ostium" import "$folder/whole.obj" -o rca-mid-focal
expect 3 "units is for a mesh" "$ostium" run rca-mid-focal --units cm
expect 3 "are one point" "$ostium" centreline --units mm "$folder/closed.obj" --start 0,0,0 --end 0,0,0 -o "$folder/point.json"
expect 3 "BRANCH:FROM" "$ostium" import "$folder/whole.obj" --lesion RCA -o "$folder/case"
[[ ! -e $folder/case && ! -e $folder/case.unfinished ]] || { echo "a refused import left something"; exit 1; }
expect 3 "this is no vessel" "$ostium" centreline "$folder/whole.obj" -o "$folder/tree.json"
expect 0 "1 branches.*in the mesh's axes and in mm" "$ostium" centreline --units mm "$folder/closed.obj" -o "$folder/tree.json"
expect 0 "in the mesh's axes and in cm;" "$ostium" centreline "$folder/closed.obj" --units cm -o "$folder/tree.vtp"
sed -E 's/^v ([^ ]*) ([^ ]*) (.*)/v \1e4 \2e4 \3e4/' "$folder/whole.obj" >"$folder/huge.obj"
expect 3 "expected vessels" "$ostium" check --units mm "$folder/huge.obj"
expect 3 "three numbers" "$ostium" centreline "$folder/whole.obj" --start 1,2 -o "$folder/tree.json"
for option in --start --end; do
  for point in 1e300,0,0 0,500,0; do
    expect 3 "lies far outside the mesh" "$ostium" centreline --units mm "$folder/closed.obj" "$option" "$point" -o "$folder/far.json"
  done
done
[[ ! -e $folder/far.json ]]
expect 3 "lies far outside the mesh" "$ostium" import --units mm "$folder/closed.obj" --entry 1e300,0,0 -o "$folder/case"
expect 3 "no format of a tree" "$ostium" centreline "$folder/whole.obj" -o "$folder/tree.txt"
