#!/usr/bin/env bash
# A small study in one piece, and in parts by studies/parallel.sh or studies/slurm.sh: the same table.
# Run as: studies_test.sh CHECKOUT PROGRAM parallel|slurm
set -euo pipefail
checkout="$1"
export SLICELENS="$2"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [ "$3" = parallel ] && ! parallel --version 2>/dev/null | grep -q '^GNU parallel'; then
  echo 'SKIPPED: GNU parallel is not installed (tools/setup-debian --tests)'
  exit 0
fi
cd "$work"
cat >small.json <<'JSON'
{ "scene": { "volume": { "phantom": "ball", "size": [16, 16, 16] }, "render": { "size": [24, 24] } },
  "vary": { "camera.azimuth": [0, 20, 40], "render.pipeline": ["slices", "rays"] },
  "reference": { "set": { "render.pipeline": "reference" } },
  "timing": false }
JSON
# An option with brackets and a space in it must arrive in one piece.
options=(--set 'render.size=[24, 20]')
"$SLICELENS" study small.json "${options[@]}" -o whole >/dev/null 2>&1
if [ "$3" = parallel ]; then
  "$checkout/studies/parallel.sh" small.json parts 3 "${options[@]}" >log 2>&1 || { cat log; exit 1; }
else
  for task in 1 2 3; do
    SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_MAX=3 "$checkout/studies/slurm.sh" small.json parts "${options[@]}" >log 2>&1 ||
      { cat log; exit 1; }
    [ "$(grep -c ',done,' "parts/part$task/results.csv")" -eq 2 ] || { echo "part $task has not two of the six rows"; exit 1; }
  done
  SLURM_ARRAY_TASK_ID=0 "$checkout/studies/slurm.sh" small.json parts "${options[@]}" >log 2>&1 || { cat log; exit 1; }
fi

# Memory is that of whoever drew the picture.
without_memory() {
  awk -F, -v OFS=, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "peak_bytes") at = i } { $at = ""; print }' "$1"
}
[ "$(grep -c ',done,' whole/results.csv)" -eq 6 ] || { cat whole/results.csv; exit 1; }
diff <(without_memory whole/results.csv) <(without_memory parts/results.csv)
