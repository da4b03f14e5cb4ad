#!/usr/bin/env bash
# A study in parts by GNU parallel, then merged:
#
#   studies/parallel.sh STUDY.json DIR [PARTS [OPTION…]]
#
# PARTS (default: one for each processor) run at once, each in DIR/partI; options such as --quick and --set go to all.
# An interrupted call goes on where it stopped. Parts that share a processor disturb each other's times: trust the
# pictures' errors, and rates only where each part has processors of its own.
set -euo pipefail

if [ $# -lt 2 ]; then
  echo 'usage: studies/parallel.sh STUDY.json DIR [PARTS [OPTION…]]' >&2
  exit 2
fi
study="$1"
folder="$2"
parts="${3:-$(nproc)}"
shift $(($# < 3 ? $# : 3))
slicelens="${SLICELENS:-slicelens}"
# Debian's moreutils has another program of this name.
parallel --version 2>/dev/null | grep -q '^GNU parallel' || {
  echo 'parallel.sh: GNU parallel is missing; apt-get install parallel' >&2
  exit 1
}

status=0
# -q: arguments with spaces or brackets reach the study as they are.
parallel -q --line-buffer --jobs "$parts" \
  "$slicelens" study "$study" "$@" --shard "{}/$parts" -o "$folder/part{}" ::: $(seq "$parts") || status=$?

merge=()
for i in $(seq "$parts"); do merge+=(--merge "$folder/part$i"); done
"$slicelens" study "$study" "$@" "${merge[@]}" -o "$folder" || status=$?
exit "$status"
