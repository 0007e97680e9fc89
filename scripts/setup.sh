#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
# Makes the workspace ready: a virtual environment in .venv and the packages built into install/.
#   scripts/setup.sh run   what signs, and the demo
#   scripts/setup.sh view  that, the console, and what sees and captures, which it teaches with
#   scripts/setup.sh all   that, the studio (studio/: writes signs, trains, renders people), and what tests and documents
#   scripts/setup.sh wheelhouse  fetches all of it into wheelhouse/, from which each of these then installs
# Does only what is missing; a second call takes well under a second.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# pip and colcon are loaded many times: compiled once, whatever the shell says (env.sh does so too).
unset PYTHONDONTWRITEBYTECODE

level="${1:-all}"
case "$level" in
    run) stamps=(.ready-run .ready-view .ready) ;;
    view) stamps=(.ready-view .ready) ;;
    all | wheelhouse) stamps=(.ready) ;;
    *) echo "setup: expected 'run', 'view', 'all' or 'wheelhouse', got '$level'" >&2 && exit 2 ;;
esac

# The Python asked for, else the one that .venv was made with, else the system's.
python="${PYTHON:-$(readlink -e .venv/bin/python || echo python3)}"

fail() {
    echo "setup: $1" >&2
    exit 1
}

ros_is_sourced() { # a Jazzy that is not the wheels of this checkout
    [ "${ROS_DISTRO:-}" = jazzy ] || return 1
    local prefix
    while IFS= read -r prefix; do
        [ -f "$prefix/share/rclpy/package.xml" ] && [ "$prefix" != "$PWD/.venv" ] && return 0
    done < <(tr ':' '\n' <<<"${AMENT_PREFIX_PATH:-}")
    return 1
}

check_tools() {
    command -v "$python" >/dev/null || fail "expected Python 3.11 or 3.12 as '$python'; install it, or name one: make setup PYTHON=python3.12"
    "$python" -c 'import sys; sys.exit(sys.version_info[:2] not in ((3, 11), (3, 12)))' ||
        fail "expected Python 3.11 or 3.12, got $("$python" --version); name another: make setup PYTHON=python3.12"
    "$python" -c 'import ensurepip, venv' 2>/dev/null ||
        fail "Python has no venv module; install it (Debian, Ubuntu: apt install python3-venv)"
    "$python" -c 'import pathlib, sysconfig, sys; sys.exit(not (pathlib.Path(sysconfig.get_path("include")) / "Python.h").exists())' ||
        fail "Python's headers are missing; messages cannot be built; install them (Debian, Ubuntu: apt install python3-dev)"
    command -v cc >/dev/null && command -v c++ >/dev/null ||
        fail "expected a C and a C++ compiler; install them (Debian, Ubuntu: apt install build-essential)"
}

# The wheels' CMake exports name the include paths of the machine that built them; CMake refuses paths that do not exist.
repair_wheel_exports() {
    local python_include numpy_include
    python_include="$(.venv/bin/python -c 'import sysconfig; print(sysconfig.get_path("include"))')"
    numpy_include="$(.venv/bin/python -c 'import numpy; print(numpy.get_include())')"
    { grep -rlE '/opt/python/cp' .venv --include='*.cmake' || true; } | xargs -r sed -i -E \
        -e "s#/opt/python/cp[0-9]+-cp[0-9]+/lib/python3\.[0-9]+/site-packages/numpy/_core/include#$numpy_include#g" \
        -e "s#/opt/python/cp[0-9]+-cp[0-9]+/include/python3\.[0-9]+#$python_include#g"
}

# A stamp for each level, its own before those that hold more.
is_ready() { # FOLDER WANT
    local stamp
    for stamp in "${stamps[@]}"; do
        [ "$(cat "$1/$stamp" 2>/dev/null)" = "$2" ] && return
    done
    return 1
}

# What pip installs: `building` first; then `wanted`; then `alone`, without what they declare; all by `options`.
list_requirements() { # LEVEL
    building=(-r requirements/build.txt)
    wanted=(-r requirements/run.txt)
    alone=()
    # A sourced ROS 2 Jazzy is built against NumPy 1; its messages do not load beside NumPy 2.
    if [ "$ros" = sourced ]; then
        options=('numpy<2')
    else
        options=(-c requirements/constraints.txt)
        building+=(-r requirements/ros.txt numpy)
    fi
    if [ "$1" != run ]; then
        wanted+=(-r requirements/console.txt -r requirements/retriever.txt -r requirements/capture.txt)
        alone+=(-r requirements/retriever-alone.txt)
    fi
    if [ "$1" = all ]; then
        wanted+=(-r requirements/authoring.txt -r requirements/train.txt -r requirements/test.txt
            -r requirements/docs.txt -r requirements/physics.txt)
        alone+=(-r requirements/people-alone.txt)
    fi
}

# What wheels are for: they suit no other Python, machine, ROS or version of what is required.
machine() {
    "$python" -c 'import platform; print("Python", ".".join(platform.python_version_tuple()[:2]), "on", platform.machine(), end=", ")'
    echo "ROS from $ros, requirements $(cat requirements/*.txt | sha256sum | cut -c1-8)"
}

install_requirements() {
    local made_for want site=()
    made_for="$PWD $("$python" --version) $ros"
    want="$made_for $(cat requirements/*.txt scripts/setup.sh | sha256sum | cut -d' ' -f1)"
    is_ready .venv "$want" && return
    check_tools
    list_requirements "$level"
    # Python compiles a module when it first loads it: most of what is installed is never loaded.
    local pip=(.venv/bin/python -m pip install --disable-pip-version-check --quiet --no-compile)
    if [ -d wheelhouse ]; then
        [ "$(cat wheelhouse/made-for)" = "$(machine)" ] ||
            fail "wheelhouse/ was made for $(cat wheelhouse/made-for), this is $(machine); make it anew with \`make wheelhouse\`, or remove it"
    fi
    if [ "$(cat .venv/.made-for 2>/dev/null)" != "$made_for" ]; then # paths and versions are all over an environment
        rm -rf .venv build install log
        [ "$ros" = sourced ] && site=(--system-site-packages)
        "$python" -m venv "${site[@]}" .venv
        echo "$made_for" >.venv/.made-for
    fi
    case "$level" in
        run) echo "setup: installing what signs and building it (about a minute and 1.2 GB the first time)" ;;
        view) echo "setup: installing what signs, the page and what it teaches with, and building it (two minutes and 1.6 GB the first time)" ;;
        *) echo "setup: installing Python packages (a few minutes and 3 GB the first time)" ;;
    esac
    if [ -d wheelhouse ]; then # all of it: a wheel does not tell which level wants it
        "${pip[@]}" --no-deps wheelhouse/*.whl
        repair_wheel_exports
        echo "$want" >".venv/${stamps[0]}"
        return
    fi
    "${pip[@]}" "${building[@]}" "${options[@]}"
    repair_wheel_exports
    # The messages take longest to build and need nothing more: they are built while the rest is fetched.
    build --packages-select control_msgs teo_sign_msgs &
    "${pip[@]}" "${wanted[@]}" "${options[@]}"
    if [ ${#alone[@]} -gt 0 ]; then # last: pip would complain of what these ask for and do without
        "${pip[@]}" --no-deps "${alone[@]}"
    fi
    wait $!
    echo "$want" >".venv/${stamps[0]}"
}

make_wheelhouse() {
    check_tools
    list_requirements all
    rm -rf wheelhouse.part
    "$python" -m venv wheelhouse.part/python
    echo "setup: fetching Python packages into wheelhouse/ (a few minutes and 1.2 GB)"
    local pip=(wheelhouse.part/python/bin/python -m pip wheel --disable-pip-version-check --quiet --wheel-dir wheelhouse.part/wheels)
    "${pip[@]}" "${building[@]}" "${wanted[@]}" "${options[@]}"
    "${pip[@]}" --no-deps "${alone[@]}"
    machine >wheelhouse.part/wheels/made-for
    rm -rf wheelhouse
    mv wheelhouse.part/wheels wheelhouse
    rm -rf wheelhouse.part
}

build() { # OPTION...: builds what colcon's options select
    if [ "$ros" = wheels ]; then
        local -x AMENT_PREFIX_PATH="$PWD/.venv" CMAKE_PREFIX_PATH="$PWD/.venv"
        local -x LD_LIBRARY_PATH="$PWD/.venv/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
    fi
    local -x PATH="$PWD/.venv/bin:$PATH"
    .venv/bin/python .venv/bin/colcon --log-level error build --merge-install --symlink-install "$@" \
        --event-handlers console_direct- console_start_end- parallel_status- summary- --cmake-args -DPython3_EXECUTABLE="$PWD/.venv/bin/python" ||
        fail "the build failed; its log is in log/latest_build"
}

build_workspace() {
    local want selection=() shelves=(src tools)
    if [ -d studio ]; then shelves+=(studio); fi # an image for a robot has none
    # Python files are linked, not copied: only a new or renamed file, or one that is generated from, needs a build.
    want="$(
        {
            find "${shelves[@]}" -type f -not -path '*/__pycache__/*' -not -path '*/test/*' -not -path '*.egg-info/*' | sort
            find "${shelves[@]}" -type f \( -name '*.msg' -o -name '*.srv' -o -name '*.action' -o -name CMakeLists.txt \
                -o -name package.xml -o -name 'setup.*' \) -print0 | sort -z | xargs -0 cat
        } | sha256sum | cut -d' ' -f1
    )"
    is_ready install "$want" && return
    case "$level" in
        run) selection=(--packages-up-to teo_bringup teo_ros2cli) ;;
        view) selection=(--packages-up-to teo_bringup teo_ros2cli teo_console teo_sign_capture) ;;
    esac
    echo "setup: building the workspace"
    # Links to files that are gone would stop the build.
    { find build install -xtype l -delete 2>/dev/null || true; }
    build "${selection[@]}"
    echo "$want" >"install/${stamps[0]}"
}

ros=wheels
if ros_is_sourced; then ros=sourced; fi
if [ "$level" = wheelhouse ]; then
    make_wheelhouse
    exit
fi
install_requirements
build_workspace
