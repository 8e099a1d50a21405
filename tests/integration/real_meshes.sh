#!/usr/bin/env bash
# Meshes of real people, as untidy as they come: each is checked and imported to closed lumens in less than a minute,
# and is a case then. They are not part of this project: $OSTIUM_MESHES, or shared/geometry beside this checkout.
#   tests/integration/real_meshes.sh OSTIUM [all]      without "all" the two quickest
set -euo pipefail
ostium=$1
meshes=${OSTIUM_MESHES:-$(dirname "$(readlink -f "$0")")/../../../shared/geometry}
if [[ ! -d $meshes ]]; then
  echo "skipped: there are no meshes at $meshes"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# lumens, and what beats
declare -A expected=(
  [visible-human-female-coronaries.stl]='"lumens": 2,|"beats": true,|"name": "LM"|"name": "LAD"|"name": "LCx"|"name": "RCA"'
  [visible-human-female-aorta.stl]='"lumens": 1,|"beats": true,|"name": "aorta"|"name": "brachiocephalic"'
  [visible-human-female-aorta-coronaries.stl]='"lumens": 1,|"beats": true,|"name": "aorta"|"name": "LM"|"name": "LAD"|"name": "LCx"|"name": "RCA"'
  [iliac-aorta-arch-carotids.obj]='"lumens": 1,|"beats": true,|"name": "aorta"|"name": "left iliac"|"name": "right iliac"'
  [iliac-aorta-arch-coarse.obj]='"lumens": 1,|"beats": true,|"name": "aorta"|"name": "left iliac"'
)
files=(visible-human-female-coronaries.stl visible-human-female-aorta.stl)
[[ ${2:-} != all ]] || files=("${!expected[@]}")
for file in "${files[@]}"; do
  [[ -e $meshes/$file ]] || continue
  rc=0
  "$ostium" check --json "$meshes/$file" >"$work/check.json" || rc=$?
  ((rc <= 1)) && grep -q '"unit": "mm"' "$work/check.json" || { echo "$file: not checked"; exit 1; }
  # Processor time: others may be on the machine.
  TIMEFORMAT=%U
  { time "$ostium" import --json "$meshes/$file" -o "$work/case" >"$work/import.json" 2>"$work/progress" || touch "$work/failed"; } 2>"$work/time"
  [[ ! -e $work/failed ]] || { echo "$file: not imported"; cat "$work/progress"; exit 1; }
  taken=$(<"$work/time")
  IFS='|' read -ra words <<<"${expected[$file]}|\"sound\": true,"
  for word in "${words[@]}"; do
    grep -qF -- "$word" "$work/import.json" || { echo "$file: the import lacks $word"; cat "$work/import.json"; exit 1; }
  done
  "$ostium" cases "$work/case" >"$work/case.txt"
  "$ostium" check "$work/case/lumen.ply" >"$work/lumen.txt" || { echo "$file: the lumen is not sound"; cat "$work/lumen.txt"; exit 1; }
  ((${taken%.*} < 60)) || { echo "$file: took $taken s; 60 are allowed"; exit 1; }
  echo "$file: $taken s"
  rm -rf "$work/case"
done
