#!/usr/bin/env bash
# Real aortas, imported: a J wire and a guide go from the entry near the iliac end round the arch and back out, beating.
# The meshes are not part of this project: $OSTIUM_MESHES, or shared/geometry beside this checkout.
#   tests/integration/imported_aorta.sh OSTIUM [PICTURE.png]      with a picture: both meshes, and how they went
set -euo pipefail
ostium=$1 picture=${2:-}
meshes=${OSTIUM_MESHES:-$(dirname "$(readlink -f "$0")")/../../../shared/geometry}
names=(iliac-aorta-arch-carotids)
[[ -z $picture ]] || names+=(iliac-aorta-arch-coarse)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for name in "${names[@]}"; do
  if [[ ! -e $meshes/$name.obj ]]; then
    echo "skipped: there is no $meshes/$name.obj"
    exit 77
  fi
  "$ostium" import "$meshes/$name.obj" -o "$work/$name" >"$work/import.txt" 2>&1 || { cat "$work/import.txt"; exit 1; }
  run=$work/$name-run
  # A hand that goes by a script alone may enter a branch of the arch, and here mostly does; whatever comes of it, the
  # wall holds.
  for seed in 0 1 2 3 4 5; do
    rc=0
    "$ostium" run "$work/$name" --script aorta-arch-guide --seed $seed --out "$run" >"$work/run.txt" 2>&1 || rc=$?
    ((rc <= 1)) || { cat "$work/run.txt"; exit 1; }
    echo "$name, seed $seed: $(sed -n '1p' "$work/run.txt"), $(sed -n 2p "$work/run.txt")"
    grep -q ' 0 nodes found outside' "$work/run.txt" || exit 1
    deepest_mm=$(sed -n 's/.*deepest in the wall \([0-9.]*\) mm.*/\1/p' "$work/run.txt")
    awk -v d="$deepest_mm" 'BEGIN { exit !(d <= 0.05) }' || { echo "$deepest_mm mm deep, 0.05 allowed"; exit 1; }
    ((rc)) || break
  done
  ((rc == 0)) || { echo "none of six went round the arch"; exit 1; }
  if [[ -n $picture ]]; then
    length_s=$(sed -n '2s/ s simulated.*//p' "$work/run.txt")
    for part in 0.35 0.5 0.65 0.8; do
      second=$(awk -v l="$length_s" -v p=$part 'BEGIN { printf "%.3f", l * p }')
      "$ostium" replay "$run/run.h5" --from $second --lao 45 --cran 0 --field 300 --table -40 40 -30 --plain \
        --png "$work/$name-$part.png" >/dev/null
    done
  fi
done
[[ -z $picture ]] || montage "$work"/*.png -tile 4x -geometry +2+2 "$picture"
