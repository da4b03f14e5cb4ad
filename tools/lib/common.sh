# Sourced by the scripts in tools/: how they speak, fail and measure time. Needs bash.

# The scripts are called from anywhere; everything they do happens in the checkout they lie in.
checkout="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)"

# fail MESSAGE [STATUS]: one line on stderr that says what to do, then the end.
fail() {
  printf '%s: %s\n' "${0##*/}" "$1" >&2
  exit "${2:-1}"
}

# step WHAT COMMAND…: runs the command and says how long it took; ends the script when the command fails.
step() {
  local what="$1" start status=0 line
  shift
  printf '==> %s\n' "$what" >&2
  start=$(date +%s)
  "$@" || status=$?
  line="$what: $(($(date +%s) - start)) s"
  if [ "$status" -ne 0 ]; then
    fail "$what failed (status $status); what went wrong stands above" "$status"
  fi
  step_times+=("$line")
}
step_times=()

# One compiler for each processor this process may use, but not more than memory allows: the files that include
# ITK or the JSON library take about a gigabyte each.
build_jobs() {
  local processors memory_kb fitting
  processors=$(nproc)
  memory_kb=$(awk '/^MemAvailable:/ {print $2}' /proc/meminfo 2>/dev/null || true)
  fitting=$((${memory_kb:-4000000} / 1200000))
  [ "$fitting" -ge 1 ] || fitting=1
  echo $((processors < fitting ? processors : fitting))
}
