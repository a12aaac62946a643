# Sourced by the other scripts: where the repository is, and how they speak. Plain bash and awk; no python, no network.
set -euo pipefail
export LC_ALL=C.UTF-8

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"

say() { printf '\n== %s\n' "$*"; }
complain() { printf '%s: %s\n' "${0##*/}" "$*" >&2; }
usage() { sed -n '2,/^[^#]/{/^#/s/^# \{0,1\}//p}' "$0"; }

# ensure_packages [--sanitizers ...]: installs what is missing; a moment when nothing is.
ensure_packages() {
  scripts/setup --check "$@" 2>/dev/null || scripts/setup "$@"
}

# configure PRESET: quiet when it works. A build folder that was copied from elsewhere is configured afresh.
configure() {
  local build="build/$1" fresh=() log
  if [[ -f $build/CMakeCache.txt ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build/CMakeCache.txt"; then
    fresh=(--fresh)
  fi
  mkdir -p "$build"
  log="$build/configure.log"
  if ! cmake --preset "$1" "${fresh[@]}" >"$log" 2>&1 </dev/null; then
    cat "$log" >&2
    complain "cmake --preset $1 failed"
    return 1
  fi
}

# build PRESET [target...]: ninja's own output; a build with nothing to do says nothing.
build() {
  local preset="$1"
  shift
  local targets=()
  if [[ $# -gt 0 ]]; then targets=(--target "$@"); fi
  NINJA_STATUS='[%f/%t %es] ' cmake --build --preset "$preset" "${targets[@]}" </dev/null |
    { grep --line-buffered -v '^ninja: no work to do' || true; }
}
