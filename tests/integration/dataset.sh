#!/usr/bin/env bash
# Labelled pictures: what their labels say agrees with one another, parts give the same bytes, and what is done is not
# done again.
#   tests/integration/dataset.sh OSTIUM
set -euo pipefail
ostium=$1
here=$(dirname "$(readlink -f "$0")")
. "$here/expect.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

dataset() {
  "$ostium" dataset rca-mid-focal --script rca-from-the-ostium --set begin=RCA --seconds 2 --pixels 128 --every 0.8 \
    --vary person=0,1,2,3 --seeds 1 "$@"
}
expect 0 "one: 8 pictures" dataset -o one
"$here/../tools/comparison/check_dataset.py" one
# In parts, one of which was ended before its last run was written.
expect 0 "2 runs are not done" dataset -o two --part 1/2
mv two/runs "two/before" && mkdir two/runs && find two/before -name '1-*' -exec mv {} two/runs \;
expect 0 "1 runs are not done" dataset -o two --part 2/2
touch -d 2000-01-01 two/runs/1-*
expect 0 "two: 8 pictures" dataset -o two
[[ -n $(find two/runs -name '1-*' ! -newermt 2001-01-01) ]] || { echo "a run that was done was made again"; exit 1; }
rm -r two/before
# A picture that has gone is no picture of the set: its run is made again.
ls two/images/1-* | head -1 | xargs rm
expect 0 "two: 8 pictures" dataset -o two
diff -r one two
# Nor is one that was cut short, as by a machine that lost its power.
for kind in images masks depth; do
  cut=$(ls two/$kind/2-* | head -1)
  truncate -s $([[ $kind == masks ]] && echo -20 || echo 0) "$cut"
  expect 0 "$cut: is gone, or was cut short; its run is made again" dataset -o two
done
diff -r one two
expect 3 "--seconds 2 is over before the first picture is due, at 3 s" "$ostium" dataset rca-mid-focal \
  --script rca-from-the-ostium --set begin=RCA --seconds 2 --every 3 -o none
expect 3 "another set of pictures" dataset -o two --set hand_speed=2
# One program at a time makes a run; others may make the others. The lock ends with the program, however that ends.
"$ostium" dataset rca-mid-focal --script rca-from-the-ostium --set begin=RCA --seconds 2 --pixels 128 --every 0.8 \
  --vary person=0,1,2,3 --seeds 1 -o three --part 1/2 >/dev/null 2>&1 &
first=$!
trap 'kill -9 $first 2>/dev/null || true; rm -rf "$work"' EXIT
until [[ -s three/set.txt ]]; do sleep 0.05; done
sleep 0.2
kill -STOP $first
expect 3 "three: another ostium makes these pictures" dataset -o three
expect 3 "three: another ostium makes these pictures" dataset -o three --part 1/2
expect 3 "another set of pictures" dataset -o three --part 2/2 --set hand_speed=2
expect 0 "2 runs are not done" dataset -o three --part 2/2
kill -9 $first
wait $first || true
expect 0 "three: 8 pictures" dataset -o three
diff -r one three
# As DICOM: a film of each run, and what is where in it.
expect 0 "films: 2 pictures" "$ostium" dataset rca-mid-focal --script rca-from-the-ostium --set begin=RCA --seconds 1.5 \
  --pixels 128 --every 0.6 --seeds 1 --dicom -o films
film=$(echo films/dicom/*-1.dcm) segmentation=$(echo films/dicom/*-1-seg.dcm)
if command -v dcmdump >/dev/null; then
  expect 0 "0008,0016.*XRayAngiographicImageStorage" dcmdump "$film"
  expect 0 "0062,0005.*guide" dcmdump "$segmentation"
  uid=$(dcmdump +P 0008,0018 "$film" | grep -o '\[.*\]')
  expect 0 "0008,1155.*${uid//[\[\]]/}" dcmdump "$segmentation"
fi
truncate -s -20 "$segmentation"
expect 0 "$segmentation: is gone, or was cut short" "$ostium" dataset rca-mid-focal --script rca-from-the-ostium \
  --set begin=RCA --seconds 1.5 --pixels 128 --every 0.6 --seeds 1 --dicom -o films
if command -v dciodvfy >/dev/null; then
  dciodvfy "$film" 2>&1 | (! grep Error) && dciodvfy "$segmentation" 2>&1 | (! grep Error)
fi
# A case whose vessel has no room for the lesion is a run without pictures.
expect 3 "there is no case" "$ostium" dataset no-such-case -o none
