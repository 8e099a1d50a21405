# shellcheck shell=bash
# Read by app/run and tests/run: `prepare TARGET...` installs the missing packages,
# configures the build folder where that is needed and builds the targets there.
# It is silent where there is nothing to do, and writes to stderr only.

root=$(readlink -f "${BASH_SOURCE[0]}")
root=${root%/*/*}
build=$root/build # build_in FOLDER OPTION... takes another
options=()
stamp=$build/.configured-with # written last, so present only after a whole configure
libraries=(Eigen3 nlohmann_json CLI11 fmt assimp GTest PNG DCMTK PkgConfig GSL Ceres MPI Boost JPEG ZLIB TBB Imath pugixml) # those of packages.txt, as CMake calls them
headers=(xxhash.h GL/osmesa.h EGL/egl.h xraylib/xraylib.h cairo/cairo.h boost/version.hpp openvdb/openvdb.h CGAL/config.h gmp.h mpfr.h hdf5/serial/hdf5.h libusb-1.0/libusb.h pybind11/pybind11.h) # and those that CMake has no name for
step='^\[ *[0-9]+(/[0-9]+|%)\] ' # how ninja and make begin their lines of progress

# A child that catches Ctrl-C would otherwise let the script go on.
trap 'say "stopped; call again to go on from here"; exit 130' INT

say() { printf 'ostium: %s\n' "$*" >&2; }

# die WHAT CURE
die() {
  say "$1"
  say "cure: $2"
  exit 1
}

# build_in FOLDER OPTION...: builds there, configured with options of CMake.
build_in() {
  build=$root/$1 stamp=$root/$1/.configured-with
  shift
  options=("$@")
}

# lock DESCRIPTOR FOLDER WHY: waits for its turn. The lock lives as long as any
# process has the descriptor open. Compilers inherit it, so those that outlive a
# killed build still keep the next call away from the files they are writing.
lock() {
  local rc=0
  eval "exec $1<\"\$2\""
  flock --nonblock --conflict-exit-code 75 "$1" 2>/dev/null || rc=$?
  if ((rc == 75)); then
    say "$3; waiting for its end"
    flock "$1"
  fi # any other code: no flock on this system or this file system; go on without
}

# quietly LOG COMMAND...: keeps the output in LOG; a terminal shows the latest
# line in place, anything else is told once when files are being built.
# Returns the command's own code.
quietly() {
  local log=$1 rc=0 line
  shift
  if [[ -t 2 && ${TERM:-dumb} != dumb ]]; then
    "$@" </dev/null 2>&1 | tee "$log" | while IFS= read -r line; do
      printf '\r\033[K%.*s' "$((${COLUMNS:-80} - 1))" "$line" >&2
    done || rc=$?
    printf '\r\033[K' >&2
  else
    "$@" </dev/null 2>&1 | tee "$log" | {
      if grep -qE "$step(Building|Linking) "; then say "building"; fi
      cat >/dev/null
    } || rc=$?
  fi
  return "$rc"
}

# Shows a log without the lines that only tell the progress.
show() { grep -vE "$step" "$1" >&2 || true; }

# ---- packages ---------------------------------------------------------------

# Debian 12 or Ubuntu 24.04, or newer: where the names of packages.txt hold.
knows_packages() (
  command -v apt-get && command -v dpkg-query && [[ -r /etc/os-release ]] || exit 1
  . /etc/os-release
  version=${VERSION_ID:-99} # Debian testing and unstable have no number
  case ${ID:-} in
    debian) ((${version%%.*} >= 12)) ;;
    ubuntu) ((${version%%.*} >= 24)) ;;
    *) exit 1 ;;
  esac
) >/dev/null

apt_get() {
  # Closing 9: a service that an installation starts must not keep our lock.
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -y -o DPkg::Lock::Timeout=600 "$@" 9<&-
}

apt_install() {
  apt_get install --no-install-recommends "${missing[@]}" && return
  # The usual reasons: an installation that was interrupted, no package lists
  # yet, or old ones. Lists that cannot be renewed may still do.
  echo "--- once more, after dpkg --configure -a and apt-get update"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive dpkg --configure -a 9<&- || true
  apt_get update || true
  apt_get install --no-install-recommends "${missing[@]}"
}

install_packages() {
  local packages=() installed missing=() as_root=() package log
  read -ra packages -d '' < <(sed 's/#.*//' "$root/app/packages.txt") || true
  # dpkg-query fails when it does not know one of them; the others count all the same
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null) || true
  for package in "${packages[@]}"; do
    grep -qxF "installed $package" <<<"$installed" || missing+=("$package")
  done
  ((${#missing[@]})) || return 0

  install_command="apt-get update; apt-get install ${missing[*]}"
  if ((EUID != 0)); then
    as_root=(sudo)
    # Without root rights go on: check_tools decides whether it works without them.
    command -v sudo >/dev/null || return 0
    say "asking sudo for the right to install by apt: ${missing[*]}"
    sudo env true </dev/null 9<&- || return 0
  fi
  say "installing by apt (this can take a few minutes): ${missing[*]}"
  log=$(mktemp "${TMPDIR:-/tmp}/ostium-apt.XXXXXX")
  if ! quietly "$log" apt_install; then
    tail -n 20 "$log" >&2
    die "apt could not install ${missing[*]} (its last words are above, all of them in $log)" \
      "as root: dpkg --configure -a; apt-get --fix-broken install; $install_command"
  fi
  rm -f "$log"
  install_command=
}

# ---- configuring ------------------------------------------------------------

# What the build folder depends on: when any of this changes it starts afresh.
describe_tools() {
  local compiler=() tool
  read -ra compiler <<<"${CXX:-}" || true # may be two words, such as "ccache g++"
  if ((${#compiler[@]} == 0)); then
    for tool in c++ g++ clang++; do
      if command -v "$tool" >/dev/null; then compiler=("$tool") && break; fi
    done
  fi
  compiler_version=none cmake_version=none generator=none
  if ((${#compiler[@]})) && command -v "${compiler[0]}" >/dev/null; then
    read -r compiler_version < <("${compiler[@]}" --version 2>&1) || true
    compiler_version="$(command -v "${compiler[0]}"): $compiler_version"
  fi
  if command -v cmake >/dev/null; then
    read -r _ _ cmake_version < <(cmake --version 2>&1) || true
  fi
  if command -v ninja || command -v ninja-build; then
    generator=Ninja
  elif command -v make; then
    generator="Unix Makefiles"
  fi >/dev/null
  tools="$root
$generator
cmake $(command -v cmake || true) $cmake_version
$compiler_version${options[*]:+
${options[*]}}"
}

# The stamp tells of a moved folder and of changed tools; the cache tells of
# someone who configured the folder by hand in the meantime.
configured() {
  [[ -f $stamp && $(<"$stamp") == "$tools" ]] || return 1
  [[ -f $build/build.ninja || -f $build/Makefile ]] || return 1
  [[ $(grep -cxF -e "CMAKE_GENERATOR:INTERNAL=$generator" -e CMAKE_BUILD_TYPE:STRING=Release \
    -e "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build/CMakeCache.txt" 2>/dev/null) == 3 ]]
}

# Stops with the list of what is missing, which a failing configure would tell
# one by one. On the systems of packages.txt this finds e.g. an old cmake in
# /usr/local or a CXX that is too old.
check_tools() {
  local lacking=() line probe
  if [[ $cmake_version == none ]]; then
    lacking+=("cmake, 3.25 or newer")
  elif ! printf '3.25\n%s\n' "$cmake_version" | sort -V -C; then
    lacking+=("cmake 3.25 or newer: $(command -v cmake) is $cmake_version")
  fi
  [[ $generator != none ]] || lacking+=("ninja (or make)")
  [[ $compiler_version != none ]] || lacking+=("a C++20 compiler: ${CXX:-c++, g++ or clang++}")

  if ((${#lacking[@]} == 0)); then
    probe=$(mktemp -d "${TMPDIR:-/tmp}/ostium-probe.XXXXXX")
    cat >"$probe/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(probe LANGUAGES CXX)
set(CMAKE_CXX_STANDARD 20)
include(CheckCXXSourceCompiles)
check_cxx_source_compiles("
  #include <concepts>
  #include <numbers>
  #include <span>
  template <std::floating_point T> T half(std::span<const T> s) { return s[0] / 2; }
  int main() { const double x[]{std::numbers::pi}; return half<double>(x) > 2; }" CXX20)
if(NOT CXX20)
  message("LACKING a C++20 compiler: \${CMAKE_CXX_COMPILER} is \${CMAKE_CXX_COMPILER_ID} \${CMAKE_CXX_COMPILER_VERSION}")
endif()
foreach(library ${libraries[*]})
  find_package(\${library} QUIET)
  if(NOT \${library}_FOUND)
    message("LACKING the library \${library}, with its CMake files")
  endif()
endforeach()
foreach(header ${headers[*]})
  find_path(folder_of_\${header} \${header})
  if(NOT folder_of_\${header})
    message("LACKING the header \${header}")
  endif()
endforeach()
END
    if ! quietly "$probe/log" cmake -S "$probe" -B "$probe" -G "$generator"; then
      show "$probe/log"
      rm -rf "$probe"
      die "cmake cannot build with $compiler_version" \
        "see its words above; CXX=<compiler> before the command names another compiler"
    fi
    while IFS= read -r line; do lacking+=("$line"); done < <(sed -n 's/^LACKING //p' "$probe/log")
    rm -rf "$probe"
  fi
  ((${#lacking[@]})) || return 0
  say "this system lacks:"
  printf '  - %s\n' "${lacking[@]}" >&2
  if [[ $install_command ]]; then
    die "installing needs root rights, and there are none here" "as root: $install_command"
  fi
  if knows_packages; then
    die "the packages are there, but PATH, CXX or CMAKE_PREFIX_PATH lead past them" \
      "set these right, then call this again"
  fi
  die "only Debian 12 and Ubuntu 24.04, or newer, get missing packages by themselves" \
    "install these by this system's own means, then call this again"
}

configure() {
  check_tools # first: a mistaken CXX or PATH must not cost a good build
  if [[ -e $build && -n $(ls -A "$build" 2>/dev/null) ]]; then
    say "starting ${build##*/}/ afresh: it was not finished, was moved, or was made with other tools"
  fi
  # The stamp goes first: a removal that is killed half way must not look whole.
  if ! { rm -f "$stamp" && rm -rf "$build" && mkdir "$build"; }; then
    die "$build cannot be made anew (by $(id -un))" \
      "make this folder yours (chown -R), or remove ${build##*/}/ as the user who made it"
  fi
  # g++ looks for memory to free so often that a tenth of a build goes there: later, and when it has grown twofold.
  local flags=${CXXFLAGS:-}
  if [[ $compiler_version != *clang* ]]; then
    flags+=" --param=ggc-min-expand=100 --param=ggc-min-heapsize=400000"
  fi
  say "configuring (Release${options[*]:+ ${options[*]}}, $generator, $compiler_version)"
  if ! CXXFLAGS=$flags quietly "$build/configure.log" cmake -S "$root" -B "$build" -G "$generator" \
    -DCMAKE_BUILD_TYPE:STRING=Release -DCMAKE_UNITY_BUILD:BOOL=ON "${options[@]}"; then
    show "$build/configure.log"
    die "cmake could not configure the build (its words are above)" \
      "mend what they name and call this again; it starts from an empty ${build##*/}/"
  fi
  printf '%s\n' "$tools" >"$stamp"
}

# ---- building ---------------------------------------------------------------

build_target() {
  local command=(cmake --build "$build" --target "$@") log=$build/build.log
  [[ -w $build ]] || die "$build belongs to another user, and $(id -un) cannot write there" \
    "make this folder yours (chown -R), or remove ${build##*/}/ as the user who made it"

  # Ninja knows after a kill which files are unfinished; make does not.
  local unfinished=$build/.unfinished
  if [[ $generator != Ninja && -e $unfinished ]]; then command+=(--clean-first); fi
  touch "$unfinished"
  if ! quietly "$log" "${command[@]}" \
    --parallel "${CMAKE_BUILD_PARALLEL_LEVEL:-$(getconf _NPROCESSORS_ONLN)}"; then
    show "$log"
    die "the build failed (its words are above, all of them in $log)" \
      "mend what they name and call this again; if memory ran out (\"Killed\"), \
put CMAKE_BUILD_PARALLEL_LEVEL=1 before the command"
  fi
  rm -f "$unfinished"
}

prepare() {
  install_command= # what root would have to run, where we cannot
  lock 9 "$root" "another call is installing or building here"
  if knows_packages; then install_packages; fi
  hash -r # programs may just have been installed
  describe_tools
  configured || configure
  build_target "$@"
}
