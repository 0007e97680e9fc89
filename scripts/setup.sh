#!/usr/bin/env bash
# Makes the workspace ready: a virtual environment in .venv and the packages built into install/.
# Does only what is missing; a second call takes well under a second.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

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

install_requirements() {
    local made_for want options=()
    made_for="$PWD $("$python" --version) $ros"
    want="$made_for $(cat requirements/*.txt scripts/setup.sh | sha256sum | cut -d' ' -f1)"
    [ "$(cat .venv/.ready 2>/dev/null)" = "$want" ] && return
    check_tools
    if [ "$(cat .venv/.made-for 2>/dev/null)" != "$made_for" ]; then # paths and versions are all over an environment
        rm -rf .venv build install log
        [ "$ros" = sourced ] && options=(--system-site-packages)
        "$python" -m venv "${options[@]}" .venv
        echo "$made_for" >.venv/.made-for
    fi
    options=(-r requirements/build.txt -r requirements/run.txt -r requirements/train.txt -r requirements/capture.txt
        -r requirements/retriever.txt -r requirements/test.txt)
    # A sourced ROS 2 Jazzy is built against NumPy 1; its messages do not load beside NumPy 2.
    if [ "$ros" = sourced ]; then options+=('numpy<2'); else options+=(-r requirements/ros.txt -c requirements/constraints.txt); fi
    echo "setup: installing Python packages (a few minutes and 3 GB the first time)"
    .venv/bin/pip install --disable-pip-version-check --quiet "${options[@]}"
    .venv/bin/pip install --disable-pip-version-check --quiet --no-deps -r requirements/retriever-alone.txt
    repair_wheel_exports
    echo "$want" >.venv/.ready
}

build_workspace() {
    local want
    # Python files are linked, not copied: only a new or renamed file, or one that is generated from, needs a build.
    want="$(
        {
            find src -type f -not -path '*/__pycache__/*' -not -path '*/test/*' -not -path '*.egg-info/*' | sort
            find src -type f \( -name '*.msg' -o -name '*.srv' -o -name '*.action' -o -name CMakeLists.txt \
                -o -name package.xml -o -name 'setup.*' \) -print0 | sort -z | xargs -0 cat
        } | sha256sum | cut -d' ' -f1
    )"
    [ "$(cat install/.ready 2>/dev/null)" = "$want" ] && return
    if [ "$ros" = wheels ]; then
        export AMENT_PREFIX_PATH="$PWD/.venv" CMAKE_PREFIX_PATH="$PWD/.venv"
        export LD_LIBRARY_PATH="$PWD/.venv/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"
    fi
    echo "setup: building the workspace (about half a minute the first time)"
    # Links to files that are gone would stop the build.
    { find build install -xtype l -delete 2>/dev/null || true; }
    PATH="$PWD/.venv/bin:$PATH" .venv/bin/colcon --log-level error build --merge-install --symlink-install \
        --event-handlers console_direct- console_start_end- status- summary- --cmake-args -DPython3_EXECUTABLE="$PWD/.venv/bin/python" ||
        fail "the build failed; its log is in log/latest_build"
    echo "$want" >install/.ready
}

ros=wheels
if ros_is_sourced; then ros=sourced; fi
install_requirements
build_workspace
