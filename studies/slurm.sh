#!/usr/bin/env bash
#SBATCH --job-name=slicelens
#SBATCH --array=1-8
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
# A study as a Slurm job array, one part for each task, then merged:
#
#   job=$(sbatch --parsable --array=1-8 --exclusive studies/slurm.sh STUDY.json DIR [OPTION…])
#   sbatch --array=0 --dependency=afterany:$job studies/slurm.sh STUDY.json DIR [OPTION…]
#
# DIR must be seen by all nodes. Arrays count from 1, the merging task is 0. --exclusive keeps other jobs from the
# processors that are timed; use nodes of one kind, since every part compares with a baseline measured by itself.
# A job that was cut off goes on where it stopped when it is submitted again.
set -euo pipefail

if [ $# -lt 2 ] || [ -z "${SLURM_ARRAY_TASK_ID:-}" ]; then
  echo 'usage: sbatch --array=1-N studies/slurm.sh STUDY.json DIR [OPTION…], then the same with --array=0' >&2
  exit 2
fi
study="$1"
folder="$2"
shift 2
slicelens="${SLICELENS:-slicelens}"

if [ "$SLURM_ARRAY_TASK_ID" -gt 0 ]; then
  exec "$slicelens" study "$study" "$@" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_MAX" \
    -o "$folder/part$SLURM_ARRAY_TASK_ID"
fi
merge=()
for part in "$folder"/part*/; do merge+=(--merge "$part"); done
exec "$slicelens" study "$study" "$@" "${merge[@]}" -o "$folder"
