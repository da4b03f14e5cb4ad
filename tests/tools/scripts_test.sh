#!/usr/bin/env bash
# The scripts of tools/ as far as they can be seen without installing or building: help, refusals, and the lists of
# packages. Run as: scripts_test.sh CHECKOUT
set -uo pipefail
checkout="$1"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

# expect STATUS PATTERN COMMAND…: the exit status, and a line of what is printed.
expect() {
  local status="$1" pattern="$2" actual=0 output
  shift 2
  output=$(cd "$work" && "$@" 2>&1 </dev/null) || actual=$?
  if [ "$actual" -ne "$status" ] || ! grep -q -- "$pattern" <<<"$output"; then
    printf 'FAILED: %s\n  status %s, expected %s; output, expected /%s/:\n%s\n' "$*" "$actual" "$status" "$pattern" "$output"
    failures=$((failures + 1))
  fi
  if [ "$actual" -ne 0 ] && [ "$(wc -l <<<"$output")" -ne 1 ]; then
    printf 'FAILED: %s: more than one line:\n%s\n' "$*" "$output"
    failures=$((failures + 1))
  fi
}

expect 0 'usage: tools/demo' "$checkout/tools/demo" --help
expect 0 '--no-install' "$checkout/tools/demo" --no-install -h
expect 0 'usage: tools/test' "$checkout/tools/test" --help
expect 0 '--preset' "$checkout/tools/test" -h
expect 0 'usage: tools/setup-debian' "$checkout/tools/setup-debian" --help
expect 2 "demo: unknown option '--frob'" "$checkout/tools/demo" --frob
expect 2 "demo: one VOLUME at a time" "$checkout/tools/demo" a b
expect 1 'demo: nowhere.nrrd: no such file or folder' "$checkout/tools/demo" nowhere.nrrd
expect 1 'demo: no_\*.png: no file matches' "$checkout/tools/demo" 'no_*.png'
expect 2 "test: there is no preset 'debug'" "$checkout/tools/test" --preset debug
expect 2 'test: --preset needs a name' "$checkout/tools/test" --preset
if command -v python3 >/dev/null; then
  vtk="$checkout/tools/render_with_vtk"
  expect 0 '--warm-up' "$vtk" --help
  expect 2 'render_with_vtk: unrecognized arguments: --frob' "$vtk" --frob
  expect 2 'render_with_vtk: a SCENE is missing' "$vtk"
  expect 2 "render_with_vtk: argument --mapper: invalid choice: 'best'" "$vtk" a.json --mapper best
  expect 2 'render_with_vtk: x.jpg: give a name that ends in .png' "$vtk" a.json -o x.jpg
  expect 2 'render_with_vtk: --serve takes its scenes from stdin' "$vtk" a.json --serve
  # Without the folders of installed modules there is no VTK.
  expect 1 "render_with_vtk: Python's module vtk is missing; apt-get install python3-vtk9 xvfb" \
    env SLICELENS_VTK_SYSTEM_PYTHON=1 PYTHONPATH= python3 -I -S "$vtk" a.json
  if /usr/bin/python3 -c 'import vtk' 2>/dev/null; then
    mkdir "$work/folder"
    echo '{}' >"$work/folder/scene.json"
    expect 1 'folder/scene.json: was not written by slicelens export' "$vtk" folder
    expect 2 "render_with_vtk: --set changes a scene" "$vtk" folder --set render.spacing=2
    expect 1 'and Xvfb, which makes one, is not installed; apt-get install xvfb' \
      env -u DISPLAY PATH=/nowhere /usr/bin/python3 "$vtk" --serve
    expect 1 'the display :98765 cannot be opened; unset DISPLAY' env DISPLAY=:98765 "$vtk" --serve
  fi
fi
expect 0 'usage: tools/studies' "$checkout/tools/studies" --help
expect 2 "studies: unknown option '--quick'" "$checkout/tools/studies" --quick
expect 2 "studies: there is no study 'nope'; there are .*scaling" "$checkout/tools/studies" nope
expect 2 'studies: -o needs a folder' "$checkout/tools/studies" -o
expect 2 "setup-debian: unknown option 'x'" "$checkout/tools/setup-debian" x

# Not root and no sudo: one line that names what to run. dpkg-query is a stand-in that knows of no package.
mkdir "$work/bin"
for name in bash dirname sort head cat env; do ln -s "$(command -v "$name")" "$work/bin/$name"; done
printf '#!/bin/sh\nexit 1\n' >"$work/bin/dpkg-query"
printf '#!/bin/sh\necho apt-get was called; exit 1\n' >"$work/bin/apt-get"
printf '#!/bin/sh\necho 1000\n' >"$work/bin/id"
chmod +x "$work/bin/dpkg-query" "$work/bin/apt-get" "$work/bin/id"
expect 1 'as root run: apt-get install g++ cmake' env PATH="$work/bin" "$checkout/tools/setup-debian"
expect 0 'missing packages.*catch2' env PATH="$work/bin" "$checkout/tools/setup-debian" --tests --no-install
expect 0 'missing packages.*python3-vtk9' env PATH="$work/bin" "$checkout/tools/setup-debian" --vtk --no-install

# Every package that is installed is explained, and every one that is explained is installed.
listed=$(tr '\n' ' ' <"$checkout/tools/setup-debian" | grep -oE '(build|test|vtk)_packages=\([^)"]*\)' |
  sed 's/^[a-z_]*=(//; s/)$//' | tr -s ' ' '\n' | grep . | sort)
explained=$(grep -E '^\| `' "$checkout/docs/dependencies.md" | cut -d'|' -f2 | grep -o '`[^`]*`' | tr -d '`' | sort)
if [ "$listed" != "$explained" ]; then
  echo 'FAILED: tools/setup-debian (<) and docs/dependencies.md (>) differ:'
  diff <(printf '%s\n' "$listed") <(printf '%s\n' "$explained")
  failures=$((failures + 1))
fi
[ "$(wc -l <<<"$listed")" -gt 15 ] || { echo 'FAILED: the lists were not found'; failures=$((failures + 1)); }

exit $((failures > 0))
