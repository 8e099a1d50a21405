#!/usr/bin/env bash
#SBATCH --job-name=ostium-sweep
#SBATCH --array=1-8
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=4
#SBATCH --requeue
# A sweep in the tasks of a Slurm array, one part a task. Each argument goes to `ostium sweep`:
#   sbatch --array=1-8 slurm.sh rca-mid-focal --seeds 1..100 --vary person=0,1,2,3,4,5,6,7 -o table.csv
# and when all have ended, on any machine:
#   ostium sweep --merge table.csv
# A task that was killed goes on where it was (--resume) when it is queued again.
set -euo pipefail
exec "${OSTIUM:-ostium}" sweep "$@" --part auto --jobs "${SLURM_CPUS_PER_TASK:-1}" --resume
