#!/usr/bin/env bash
# Makes this folder ready: installs what is missing, builds Release into build/, links ./raytracer to the program.
# Run it again whenever you like; it does only what is still to do.
set -euo pipefail
export PATH="$PATH:/usr/local/sbin:/usr/sbin:/sbin"  # apt needs them, and "su" without "-" leaves them out

root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
build=$root/build
log=$build/setup.log
megabytes_per_job=1536  # what the compiler may want for the largest file, with room for the linker

# All that is needed, a row each. "set": build, tests or bench. Where "command" is found nothing need be installed; "-"
# asks the package manager. "-" instead of a package: it comes with another one, or is not to be had there.
#
# set   | command   | apt           | dnf          | pacman    | brew      | why
packages='
build   | c++       | g++           | gcc-c++      | gcc       | gcc       | C++20 compiler
build   | cmake     | cmake         | cmake        | cmake     | cmake     | describes the build
build   | make      | make          | make         | make      | make      | runs the build
build   | -         | libembree-dev | embree-devel | embree    | embree    | finds what a ray hits first
build   | -         | libtbb-dev    | tbb-devel    | onetbb    | tbb       | works on all processor cores
build   | -         | libpng-dev    | libpng-devel | libpng    | libpng    | writes PNG
build   | -         | zlib1g-dev    | zlib-devel   | zlib      | zlib      | compresses PNG
build   | -         | libopenexr-dev | openexr-devel | openexr | openexr | reads and writes EXR
build   | -         | libjpeg-dev   | libjpeg-turbo-devel | libjpeg-turbo | jpeg-turbo | reads JPEG
build   | -         | libglm-dev    | glm-devel    | glm       | glm       | vectors and matrices
build   | -         | libcli11-dev  | cli11-devel  | cli11     | cli11     | command line options
build   | -         | libfmt-dev    | fmt-devel    | fmt       | fmt       | text, whatever the locale
tests   | -         | catch2        | catch-devel  | catch2    | catch2    | unit tests
tests   | python3   | python3       | python3      | python    | python3   | tests of the program from outside
bench   | python3   | python3       | python3      | python    | python3   | gathers the measurements
bench   | hyperfine | hyperfine     | hyperfine    | hyperfine | hyperfine | measures whole runs
bench   | povray    | povray        | povray       | povray    | povray    | to compare with
bench   | tachyon   | tachyon       | -            | -         | -         | to compare with
'

usage() {
  cat <<'END'
Usage: ./setup.sh [--tests] [--bench]
Installs what is missing, builds into build/ and links ./raytracer to the program.
  --tests   and the tests; then: ctest --test-dir build --output-on-failure
  --bench   and the benchmarks
END
}

say() { printf '%s\n' "$*"; }

die() {
  printf 'setup.sh: %s\n' "$*" >&2
  exit 1
}

# logged <what it does> <command>...: quiet, unless the command fails.
logged() {
  local what=$1
  shift
  "$@" >"$log" 2>&1 </dev/null && return
  tail -n 30 "$log" >&2
  die "$what failed; the whole story is in $log"
}

find_package_manager() {
  local name
  for name in apt-get dnf pacman brew; do
    if command -v "$name" >/dev/null; then
      say "$name"
      return
    fi
  done
}

# is_installed <package manager> <package>
is_installed() {
  case $1 in
    apt-get) dpkg-query -W -f='${db:Status-Status}\n' "$2" 2>/dev/null | grep -qx installed ;;
    dnf) rpm -q "$2" >/dev/null 2>&1 ;;
    pacman) pacman -Q "$2" >/dev/null 2>&1 ;;
    brew) brew list --versions "$2" >/dev/null 2>&1 ;;
  esac
}

# missing_packages <package manager> <set>...: names of packages, with a space before each.
missing_packages() {
  local manager=$1 column row fields package
  shift
  case $manager in
    apt-get) column=2 ;;
    dnf) column=3 ;;
    pacman) column=4 ;;
    brew) column=5 ;;
  esac
  while read -r row; do
    read -ra fields <<<"${row//|/ }"
    [[ ${#fields[@]} -gt 0 && " $* " == *" ${fields[0]} "* ]] || continue
    package=${fields[column]}
    [[ $package != - ]] || continue
    [[ ${fields[1]} == - ]] || ! command -v "${fields[1]}" >/dev/null || continue
    is_installed "$manager" "$package" || printf ' %s' "$package"
  done <<<"$packages"
}

# install_command <package manager>: without the packages' names.
install_command() {
  case $1 in
    apt-get) say "apt-get install -y --no-install-recommends" ;;
    dnf) say "dnf install -y" ;;                         # untested
    pacman) say "pacman -Syu --needed --noconfirm" ;;    # untested
    brew) say "brew install" ;;                          # untested
  esac
}

# How to become root without being asked anything, or with a password where someone sits at a terminal.
root_command() {
  if [[ $(id -u) == 0 ]]; then
    return 0
  elif ! command -v sudo >/dev/null; then
    return 1
  elif sudo -n true 2>/dev/null; then
    say "sudo -n"
  elif [[ -t 0 && -z ${CI:-} ]]; then
    say "sudo"
  else
    return 1
  fi
}

# install <package manager> <packages>
install() {
  local manager=$1 packages=$2 command as_root=
  command="$(install_command "$manager")$packages"
  if [[ $manager != brew ]] && ! as_root=$(root_command); then
    [[ $manager != apt-get ]] || command="apt-get update && $command"
    if command -v sudo >/dev/null; then
      command="sudo sh -c '$command'"
    else
      command="su -l -c '$command'"
    fi
    die "packages are missing, and it takes root to install them. Please run this line, then try again:
$command"
  fi

  say "Installing with $manager:$packages"
  [[ $manager == apt-get ]] || say "(Only apt is tested; with $manager a name may be wrong.)"
  if [[ $manager == apt-get ]]; then
    # A source that can't be read need not be the one that is asked; the lock is somebody's daily update.
    command="export DEBIAN_FRONTEND=noninteractive; apt-get update; ${command/ -y/ -y -o DPkg::Lock::Timeout=300}"
  fi
  # as_root is split into words: it is one to two of them, or none.
  # shellcheck disable=SC2086
  logged "installing$packages" $as_root sh -c "$command"
}

# is_configured <-D options>: whether build/ is configured, and remembers these options.
is_configured() {
  local option cache=$build/CMakeCache.txt
  [[ -f $cache ]] && [[ -f $build/Makefile || -f $build/build.ninja ]] || return 1
  for option in "$@"; do
    option=${option#-D}
    grep -q "^${option%%=*}:[A-Z]*=${option#*=}\$" "$cache" || return 1
  done
}

# A folder that was moved or copied brings along a build/ that points to its old place.
forget_foreign_build() {
  local home
  [[ -f $build/CMakeCache.txt ]] || return 0
  home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")
  [[ ! $home -ef $root ]] || return 0
  say "build/ was made for $home: starting afresh"
  rm -f "$build/CMakeCache.txt" "$build/Makefile" "$build/build.ninja"
  find "$build" -type d -name CMakeFiles -prune -exec rm -rf {} +
}

# One job for each core, fewer where memory is short.
job_count() {
  local jobs memory limit
  jobs=$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN)
  memory=$(awk '/^MemAvailable:/ { print int($2 / 1024) }' /proc/meminfo 2>/dev/null || true)
  limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null || true)
  if [[ $limit =~ ^[0-9]{1,18}$ && $((limit / 1048576)) -lt ${memory:-999999999} ]]; then
    memory=$((limit / 1048576))
  fi
  if [[ -n $memory && $((memory / megabytes_per_job)) -lt $jobs ]]; then
    jobs=$((memory / megabytes_per_job))
  fi
  say $((jobs > 0 ? jobs : 1))
}

# Passes on nothing but the percentage, and that only to a terminal.
show_progress() {
  local line
  while IFS= read -r line; do
    [[ ! -t 1 || $line != "["*%"]"* ]] || printf '\r%s' "${line%%]*}]"
  done
  [[ ! -t 1 ]] || printf '\r      \r'
}

compile() {
  cmake --build "$build" -j "$(job_count)" 2>&1 </dev/null | tee "$log" | show_progress && return
  grep -E -m 3 -A 8 'error|Error' "$log" >&2 || tail -n 30 "$log" >&2
  die "building failed; the whole story is in $log"
}

link_program() {
  if [[ -e $root/raytracer && ! -L $root/raytracer ]]; then
    die "$root/raytracer is in the way of the link to the program; please move it"
  fi
  ln -sfn build/raytracer "$root/raytracer"
}

main() {
  local sets=(build) options=(-DCMAKE_BUILD_TYPE=Release -DRAYTRACER_NATIVE=ON) manager missing='' has_worked=false
  while [[ $# -gt 0 ]]; do
    case $1 in
      --tests) sets+=(tests) options+=(-DRAYTRACER_TESTS=ON) ;;
      --bench) sets+=(bench) options+=(-DRAYTRACER_BENCH=ON) ;;
      -h | --help) usage; exit ;;
      *) usage >&2; exit 2 ;;
    esac
    shift
  done
  { mkdir -p "$build" && : >"$log"; } 2>/dev/null || die "can't write to $build: does it belong to somebody else?"

  manager=$(find_package_manager)
  if [[ -n $manager ]]; then
    missing=$(missing_packages "$manager" "${sets[@]}")
  else
    say "No package manager that I know (apt, dnf, pacman, brew): going on with what is there."
  fi
  if [[ -n $missing ]]; then
    install "$manager" "$missing"
    has_worked=true
  fi

  forget_foreign_build
  if ! is_configured "${options[@]}"; then
    say "Building into build/: a few minutes the first time"
    logged "configuring" cmake -S "$root" -B "$build" "${options[@]}"
    has_worked=true
  fi
  compile
  ! grep -qE 'Building|Linking' "$log" || has_worked=true
  link_program

  if $has_worked; then
    say "Ready: ./raytracer"
  else
    say "Nothing to do: all is installed and built. Ready: ./raytracer"
  fi
}

main "$@"
