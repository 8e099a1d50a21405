#!/usr/bin/env bash
# A sweep in parts: put together they are the table of one process to the byte, whoever did which part, one was killed,
# runs threw, or their recordings were kept; what is missing is named, and nothing is written.
#   tests/integration/sweep_parts.sh OSTIUM
set -euo pipefail
ostium=$1
here=$(dirname "$(readlink -f "$0")")
. "$here/expect.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
python3 -B "$here/../tools/comparison/made_up_tube.py" a.stl 3 100
python3 -B "$here/../tools/comparison/made_up_tube.py" b.stl 3.5 100
unset "${!SLURM_@}" "${!OMPI_@}" "${!PMI_@}"

# Two vessels; of the two entries only one can be made in a mesh, so that half of the runs throw. 8 runs.
sweep() {
  "$ostium" sweep a.stl b.stl --units mm --entry 5,0,0 --towards 20,0.2,0 --script iliac-wire --seconds 0.3 --jobs 1 \
    --vary begin=,RCA --seeds 1..2 "$@"
}
export -f sweep
export ostium

expect 0 "no ostium that is known" sweep -o one.csv
[[ $(wc -l <one.csv) == 9 && $(grep -c ',RCA,aborted,.*no ostium that is known,0.000,,' one.csv) == 4 ]]

for parts in 1 2 5; do  # more parts than vessels share them; a part may have nothing to do
  for ((k = parts; k >= 1; --k)); do expect 0 "of-$parts" sweep -o "in-$parts.csv" --part "$k/$parts"; done
  expect 0 "8 runs of $parts parts" "$ostium" sweep --merge "in-$parts.csv"
  cmp one.csv "in-$parts.csv"
done

# What is missing: a part that never began, and one that was killed.
expect 3 "has no parts beside it" "$ostium" sweep --merge none.csv
rm in-2.csv in-2.csv.part-2-of-2
expect 1 "4 of 8 runs are missing" "$ostium" sweep --merge in-2.csv
expect 1 "part 2/2 was not begun" "$ostium" sweep --merge in-2.csv
expect 1 "b.stl begin=RCA: seeds 1 to 2" "$ostium" sweep --merge in-2.csv
[[ ! -e in-2.csv ]]
sweep -o in-2.csv --part 2/2 2>/dev/null >&2 & child=$!
for _ in $(seq 400); do
  if [[ -e in-2.csv.part-2-of-2 ]] && (($(wc -l <in-2.csv.part-2-of-2) > 1)); then break; fi
  sleep 0.02
done
pkill -KILL -P "$child" 2>/dev/null || kill -KILL "$child" 2>/dev/null || true
wait "$child" 2>/dev/null || true
head -n 3 in-2.csv.part-2-of-2 >killed && mv killed in-2.csv.part-2-of-2  # however far it had come
printf '7 b.stl,iliac-wire,2,RCA,torn' >>in-2.csv.part-2-of-2
expect 3 "not finished" sweep -o in-2.csv --part 2/2
expect 3 "another sweep" sweep -o in-2.csv --part 2/2 --resume --set hand_speed=2
expect 3 "another sweep" "$ostium" sweep a.stl b.stl --units mm --entry 5,0,0 --towards 20,0.2,0 --script iliac-wire \
  --seconds 0.2 --vary begin=,RCA --seeds 1..2 -o in-2.csv --part 2/2 --resume
mv b.stl kept.stl
python3 -B "$here/../tools/comparison/made_up_tube.py" b.stl 3.6 100
expect 3 "another sweep" sweep -o in-2.csv --part 2/2 --resume
mv kept.stl b.stl
expect 0 "4 runs" sweep -o in-2.csv --part 2/2 --resume
expect 0 "8 runs" "$ostium" sweep --merge in-2.csv
cmp one.csv in-2.csv
cp in-5.csv.part-1-of-5 in-2.csv.part-1-of-5
expect 3 "not of one sweep in" "$ostium" sweep --merge in-2.csv
echo "{}" >in-5.csv.part-1-of-5
expect 3 "is no unfinished table" "$ostium" sweep --merge in-5.csv

# Who has which part.
expect 3 "expected K/N" sweep -o auto.csv --part 3/2
expect 3 "expected K/N" sweep -o auto.csv --part 0/2
expect 3 "no task of a Slurm array" sweep -o auto.csv --part auto
expect 3 "are no range" env SLURM_ARRAY_TASK_ID=9 SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_COUNT=3 \
  bash -c 'sweep -o auto.csv --part auto'
rank() { expect 0 "part-$1-of-$2:" env "${@:3}" bash -c 'sweep -o auto.csv --part auto'; }
rank 2 4 SLURM_ARRAY_TASK_ID=7 SLURM_ARRAY_TASK_MIN=5 SLURM_ARRAY_TASK_COUNT=4 SLURM_ARRAY_TASK_STEP=2
rank 4 4 SLURM_ARRAY_TASK_ID=1 SLURM_ARRAY_TASK_MIN=0 SLURM_ARRAY_TASK_COUNT=2 SLURM_PROCID=1 SLURM_NTASKS=2 SLURM_STEP_ID=0
rank 1 4 OMPI_COMM_WORLD_RANK=0 OMPI_COMM_WORLD_SIZE=4 SLURM_PROCID=3 SLURM_NTASKS=8 SLURM_STEP_ID=0
rank 3 4 PMI_RANK=2 PMI_SIZE=4
expect 0 "8 runs of 4 parts" "$ostium" sweep --merge auto.csv
cmp one.csv auto.csv
# A line says itself what it is of; line ends of another editor are none of it.
for part in 1 2 3 4; do cp auto.csv.part-$part-of-4 edited.csv.part-$part-of-4; done
sed -i 's/$/\r/' edited.csv.part-1-of-4
expect 0 "8 runs of 4 parts" "$ostium" sweep --merge edited.csv
cmp one.csv edited.csv
sed -i '2s/iliac-wire,/iliac-wire,9/' edited.csv.part-1-of-4
expect 3 "edited.csv.part-1-of-4: the line of run .* is of another" "$ostium" sweep --merge edited.csv
cp auto.csv.part-1-of-4 edited.csv.part-1-of-4
sed -i '2s/$/,9/' edited.csv.part-1-of-4
expect 3 "has another number of columns" "$ostium" sweep --merge edited.csv
# A batch script is one process, whatever its steps will have.
rank 1 1 SLURM_ARRAY_TASK_ID=0 SLURM_ARRAY_TASK_MIN=0 SLURM_ARRAY_TASK_COUNT=1 SLURM_PROCID=0 SLURM_NTASKS=8
if command -v mpirun >/dev/null; then
  mpirun --allow-run-as-root --oversubscribe -n 3 bash -c 'sweep -o mpi.csv --part auto' >mpi.txt 2>&1 || { cat mpi.txt; exit 1; }
  expect 0 "8 runs of 3 parts" "$ostium" sweep --merge mpi.csv
  cmp one.csv mpi.csv
else
  echo "mpirun was not tried: it is not here"
fi

# What was recorded is kept, and a run of the table replays to its state.
expect 3 "has no place" sweep -o kept.csv --record full
expect 0 "8 runs" sweep -o kept.csv --record full --keep kept
cmp one.csv kept.csv
[[ $(find kept -name metrics.json | wc -l) == 4 && $(find kept -name run.h5 | wc -l) == 4 ]]
expect 0 "bit for bit" "$ostium" replay kept/5-b.stl--1/run.h5 --verify
expect 0 '"outcome": "aborted"' cat kept/2-a.stl--2/metrics.json
expect 0 "8 runs" sweep -o events.csv --keep events
(($(stat -c %s events/1-*/run.h5) < $(stat -c %s kept/1-*/run.h5)))
# Runs of before that have none are made again.
expect 0 "part-2-of-2:" sweep -o later.csv --part 2/2
expect 0 "part-2-of-2:" sweep -o later.csv --part 2/2 --resume --keep later
(($(find later -name run.h5 | wc -l) > 0))
ln -s /proc/nowhere nowhere
expect 1 "cannot be made" sweep -o lost.csv --keep nowhere/kept

# Where no run can be made it is told at once, and nothing stays behind.
expect 3 "no run of the sweep can be made.*no ostium" "$ostium" sweep a.stl --units mm --entry 5,0,0 --towards 20,0.2,0 \
  --script iliac-wire --set begin=RCA -o empty.csv
[[ ! -e empty.csv && ! -e empty.csv.part ]]
