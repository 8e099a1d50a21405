#!/usr/bin/env bash
# The examples of app/clusters give the table of one process: a Slurm array on this host alone, Dask, Snakemake.
#   tests/integration/clusters.sh OSTIUM slurm|dask|snakemake
# What is not installed is skipped, with a word.
set -euo pipefail
ostium=$1
here=$(dirname "$(readlink -f "$0")")
examples=$here/../../app/clusters
. "$here/expect.sh"
skip() { echo "skipped: $1 is not installed"; exit 77; }
work=$(mktemp -d)
daemons=()
clean_up() {
  for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do kill "${daemons[i]}" 2>/dev/null && wait "${daemons[i]}" 2>/dev/null; done
  rm -rf "$work"
}
trap clean_up EXIT
unset "${!SLURM_@}" "${!OMPI_@}" "${!PMI_@}"
export OSTIUM=$ostium
python=/usr/bin/python3  # the system's, which has Debian's packages
sweep=(a.stl b.stl --units mm --entry 5,0,0 --towards 20,0.2,0 --script iliac-wire --seconds 0.3 --seeds 1..2)

make_reference() {
  cd "$work"
  python3 -B "$here/../tools/comparison/made_up_tube.py" a.stl 3 100
  python3 -B "$here/../tools/comparison/made_up_tube.py" b.stl 3.5 100
  expect 0 "4 runs" "$ostium" sweep "${sweep[@]}" --jobs 1 -o one.csv
}

# A controller and a node of Slurm as this user, without munge, on ports of their own.
start_slurm() {
  local host port=$((20000 + $$ % 20000))
  host=$(hostname -s)
  mkdir state spool
  cat >slurm.conf <<END
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldPort=$port
SlurmdPort=$((port + 1))
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
END
  export SLURM_CONF=$work/slurm.conf
  slurmctld -D -i >slurmctld.txt 2>&1 & daemons+=($!)
  slurmd -D >slurmd.txt 2>&1 & daemons+=($!)
  for _ in $(seq 100); do
    if sinfo -h -o %T 2>/dev/null | grep -q idle; then return; fi
    sleep 0.2
  done
  tail -n 20 slurmctld.txt slurmd.txt
  exit 1
}

case $2 in
  slurm)
    PATH=$PATH:/usr/sbin
    for program in slurmctld slurmd sbatch; do command -v $program >/dev/null || skip "slurm-wlm ($program)"; done
    make_reference
    start_slurm
    expect 0 "" timeout 100 sbatch --wait --array=2-4 --cpus-per-task=1 "$examples/slurm.sh" "${sweep[@]}" -o table.csv
    grep -l "2-of-3" slurm-*_3.out >/dev/null
    # Two processes in each of two tasks.
    expect 0 "" timeout 100 sbatch --wait --array=1-2 --ntasks=2 --overcommit --wrap \
      "srun --overcommit '$ostium' sweep ${sweep[*]} -o four.csv --part auto --jobs 1"
    expect 0 "4 runs of 4 parts" "$ostium" sweep --merge four.csv
    cmp one.csv four.csv
    expect 0 "4 runs of 3 parts" "$ostium" sweep --merge table.csv
    ;;
  dask)
    "$python" -c "import distributed" 2>/dev/null || skip "python3-distributed"
    make_reference
    expect 0 "4 runs of 2 parts" "$python" -B "$examples/sweep_dask.py" --parts 2 -o table.csv "${sweep[@]}"
    ;;
  snakemake)
    command -v snakemake >/dev/null || skip "snakemake"
    make_reference
    expect 0 "4 runs of 2 parts" snakemake --snakefile "$examples/Snakefile" --cores 1 --config parts=2 table=table.csv \
      sweep="${sweep[*]}"
    ;;
esac
cmp one.csv table.csv
