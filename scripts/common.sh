# Shared by the scripts in this folder; sourced, never run. Needs bash.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# Not named `build`: rosrun does not look for programs in a package's folder of that name.
build=${FACET_MAPPING_BUILD:-$root/workspace}
step_number=0

# Debian's own python3 and cmake first: the ROS packages are built for them.
export PATH=/usr/bin:/bin:$PATH
# A host name that does not resolve costs every ROS call seconds.
export ROS_HOSTNAME=localhost
export ROSCONSOLE_STDOUT_LINE_BUFFERED=1
export CCACHE_SLOPPINESS=pch_defines,time_macros

step() {
  step_number=$((step_number + 1))
  printf '\n[%s] %d. %s\n' "$(date +%H:%M:%S)" "$step_number" "$*"
}

fail() {
  printf 'error: %s\n' "$*" >&2
  exit 1
}

# configure_and_build TARGET...: builds with two jobs and a line of progress per file.
configure_and_build() {
  # catkin freezes PYTHONPATH for ctest at configure time: the folder has to be there by then.
  mkdir -p "$build/devel/lib/python3/dist-packages" "$build/devel/lib/pkgconfig"
  local launcher=()
  command -v ccache >/dev/null && launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  cmake -S "$root" -B "$build" -G Ninja -DPYTHON_EXECUTABLE=/usr/bin/python3 \
    -DPython3_EXECUTABLE=/usr/bin/python3 "${launcher[@]}" ${cmake_options:-} >"$build/configure.log" 2>&1 ||
    { tail -n 20 "$build/configure.log"; fail "cmake failed; the whole output is in $build/configure.log"; }
  NINJA_STATUS='  [%f/%t, %es] ' cmake --build "$build" -j2 --target "$@"
}

source_workspace() {
  set +u
  # shellcheck disable=SC1091
  . "$build/devel/setup.bash"
  set -u
}
