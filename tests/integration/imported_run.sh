#!/usr/bin/env bash
# A real aorta with coronary arteries, imported with a narrowing put into the RCA: a J wire and a guide go from the
# abdominal aorta round the arch into the RCA, and a wire down it, beating. The mesh is not part of this project:
# $OSTIUM_MESHES, or shared/geometry beside this checkout.
#   tests/integration/imported_run.sh OSTIUM [all]      "all": the whole angioplasty, two minutes
set -euo pipefail
ostium=$1
meshes=${OSTIUM_MESHES:-$(dirname "$(readlink -f "$0")")/../../../shared/geometry}
mesh=$meshes/visible-human-female-aorta-coronaries.stl
if [[ ! -e $mesh ]]; then
  echo "skipped: there is no $mesh"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$ostium" import --json "$mesh" -o "$work/case" --lesion RCA:10:6:50 >"$work/import.json" 2>"$work/progress"
for word in "made a taper" "carried on past a branch" '"sound": true' '"beats": true'; do
  grep -qF -- "$word" "$work/import.json" || { echo "the import lacks $word"; cat "$work/import.json"; exit 1; }
done

seconds=90
[[ ${2:-} != all ]] || seconds=400
rc=0
"$ostium" run "$work/case" --script pci-rca-imported --seconds $seconds --record events --out "$work/out" \
  >"$work/run.txt" 2>&1 || rc=$?
"$ostium" report "$work/out/run.h5" -o "$work/report.html" --no-pictures --events "$work/events.csv" >/dev/null
# Steps by their place in the script, from 0: what has to be done by then is the wire, 70 mm down the artery.
step=$(grep -n '"do":' "$(dirname "$0")/../../data/scripts/pci-rca-imported.json" | grep -n '"wire across"' | cut -d: -f1)
grep -q ",script_step_done,,$((step - 1))," "$work/events.csv" || { echo "the wire is not across"; cat "$work/run.txt"; exit 1; }
grep -q "cannulation_time_s  *[0-9]" "$work/run.txt" || { echo "the guide is not in the artery"; cat "$work/run.txt"; exit 1; }
outside=$(grep -o '[0-9]* nodes found outside' "$work/run.txt")
[[ $outside == 0\ * ]] || { echo "$outside"; exit 1; }
if [[ ${2:-} == all ]]; then
  ((rc == 0)) && grep -q '^success' "$work/run.txt" || { echo "no success"; cat "$work/run.txt"; exit 1; }
fi
head -2 "$work/run.txt"
