#!/usr/bin/env bash
# ostium predict and ostium explain: files, exit codes, and the same numbers from one rank, two and three.
set -euo pipefail
ostium=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

. "$(dirname "$(readlink -f "$0")")/expect.sh"

# A level wire, its tip photographed at four insertions.
experiment() { # ID INSERTED_MM TIP_MM
  printf '{"id": "%s", "base": {"position_mm": [0, 0, 0], "tangent": [1, 0, 0], "up": [0, 0, 1]},
    "set": [{"inserted_length_mm": %s, "roll_deg": 0}], "tip_mm": [%s]}' "$@"
}
mkdir "$folder/wire"
cat >"$folder/wire/measurement.json" <<END
{ "schema": "ostium-measurement/1", "title": "level wire", "source": "made up",
  "instruments": [{"name": "wire", "total_length_mm": 300, "outer_radius_mm": 0.2, "inner_radius_mm": 0,
    "sections": [{"from_tip_mm": [0, 300], "EI_Nmm2": 30, "GJ_Nmm2": 23, "kg_per_mm": 8e-7}]}],
  "environment": {"gravity_m_s2": [0, 0, -9.81], "vessel": null},
  "imaging": {"noise_sigma_mm": 0.2, "registration": "given", "tip_offset": "none"},
  "experiments": [$(experiment a 100 "99.9, 0, -3.2"), $(experiment b 150 "148.6, 0, -16.1"),
    $(experiment c 200 "191, 0, -48"), $(experiment d 250 "220, 0, -95")] }
END

expect 0 "Examples" "$ostium" predict --help
expect 0 "Examples" "$ostium" explain --help
expect 0 "root mean square" "$ostium" predict "$folder/wire" -o "$folder/predicted"
expect 0 "ostium-prediction/1" "$ostium" predict "$folder/wire/measurement.json" --json -o "$folder/predicted"
grep -q "experiment,s_mm" "$folder/predicted/prediction.csv"
cp -r "$(dirname "$0")/../../data/templates/push_pull" "$folder/cut"
for table in "$folder"/cut/*.csv; do truncate -s -2 "$table"; done
expect 0 "the last line has no end" "$ostium" predict "$folder/cut" -o "$folder/predicted-cut"
expect 3 "no-such-set" "$ostium" predict "$folder/no-such-set"
expect 1 "cannot be written" "$ostium" predict "$folder/wire" -o /proc/nowhere
expect 2 "SET is required\|set is required" "$ostium" predict

expect 0 "verdict: " "$ostium" explain "$folder/wire" --try self_weight -o "$folder/one" --threads 1
expect 0 '"ostium-explanation/1"' "$ostium" explain "$folder/wire" --try self_weight -o "$folder/one" --json
grep -q "<svg" "$folder/one/explanation.html"
expect 0 "root mean square" "$ostium" predict "$folder/one/amended" -o "$folder/amended"
expect 3 "there is no effect" "$ostium" explain "$folder/wire" --try no_such_effect -o "$folder/one"
expect 3 "cannot show in this set" "$ostium" explain "$folder/wire" --try shaft_torsion -o "$folder/one"

sed 's/"inserted_length_mm": 150/"inserted_length_mm": 350/' "$folder/wire/measurement.json" >"$folder/long.json"
expect 3 'experiments\[1\].set\[0\].inserted_length_mm is 350' "$ostium" explain "$folder/long.json" -o "$folder/one"
sed 's/"tangent": \[1, 0, 0\]/"tangent": [0, 0, 0]/' "$folder/wire/measurement.json" >"$folder/still.json"
expect 3 'experiments\[0\].base.tangent is \[0, 0, 0\]' "$ostium" predict "$folder/still.json" -o "$folder/one"

# A wire seen by two views: the template is a set, and is explained as it is.
expect 0 "clicks.csv" "$ostium" explain --template projections -o "$folder/seen"
expect 3 "is there already" "$ostium" explain --template projections -o "$folder/seen"
expect 3 'there is no template of "views"; there are .*projections' "$ostium" explain --template views -o "$folder/seen"
expect 0 "verdict: explained" "$ostium" explain "$folder/seen" -o "$folder/found" --threads 1
expect 0 '"noise_sigma_px"' "$ostium" explain "$folder/seen/measurement.json" -o "$folder/found" --threads 1 --json
expect 0 "experiments: .* px" "$ostium" predict "$folder/seen" -o "$folder/found"
grep -q "View B" "$folder/found/explanation.html"
expect 2 "SET is required" "$ostium" explain

# Curves: so is each of theirs, with its samples in tables, which the amended set has written out.
for kind in three_point_bend torque_response push_pull density pressure_diameter; do
  expect 0 "measurement.json" "$ostium" explain --template "$kind" -o "$folder/$kind"
  expect 0 "verdict: explained" "$ostium" explain "$folder/$kind" -o "$folder/found-$kind"
  expect 0 "off by" "$ostium" predict "$folder/found-$kind/amended" -o "$folder/found-$kind"
done

# Two ranks and three, bit for bit what one says. (As root, and with fewer cores than ranks, Open MPI wants to be asked
# nicely.)
if command -v mpirun >/dev/null; then
  for n in 2 3; do
    ranks=(env OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_vader_single_copy_mechanism=none
      mpirun --oversubscribe -n "$n")
    expect 0 "verdict: " "${ranks[@]}" "$ostium" explain "$folder/wire" --try self_weight -o "$folder/ranks$n" --threads 1
    cmp "$folder/one/explanation.json" "$folder/ranks$n/explanation.json"
    cmp "$folder/one/explanation.html" "$folder/ranks$n/explanation.html"
  done
fi
