# SPDX-FileCopyrightText: 2026 TEO signing project
# SPDX-License-Identifier: Apache-2.0
# Source me: `. ./env.sh`, in bash or zsh, after `make setup`. Puts the workspace, its Python and `ros2` on the path.
# Names only what this checkout holds, so sourcing it twice changes nothing.

if [ -n "${ZSH_VERSION:-}" ]; then
    _teo_shell=zsh
    eval '_teo_root="${${(%):-%x}:A:h}"'
else
    _teo_shell=bash
    _teo_root="$(builtin cd "$(dirname "${BASH_SOURCE[0]}")" >/dev/null && pwd)"
fi

if [ ! -f "$_teo_root/install/setup.$_teo_shell" ]; then
    echo "env.sh: the workspace is not built: run 'make setup' in $_teo_root first" >&2
    unset _teo_root _teo_shell
    return 1
fi

_teo_prepend() { # VARIABLE DIRECTORY: puts the directory first, once
    eval "_teo_old=\"\${$1:-}\""
    case ":$_teo_old:" in
        *":$2:"*) ;;
        *) eval "export $1=\"$2\${_teo_old:+:\$_teo_old}\"" ;;
    esac
    unset _teo_old
}

# What is installed is compiled when it is first loaded (setup.sh); unwritten, each process would do that again: 2 s.
unset PYTHONDONTWRITEBYTECODE
export VIRTUAL_ENV="$_teo_root/.venv"
_teo_prepend PATH "$_teo_root/.venv/bin"
if [ -f "$_teo_root/.venv/lib/librcl.so" ]; then # ROS 2 from the PyPI wheels, not from a sourced installation
    export ROS_DISTRO=jazzy ROS_VERSION=2 ROS_PYTHON_VERSION=3
    export RMW_IMPLEMENTATION="${RMW_IMPLEMENTATION:-rmw_fastrtps_cpp}"
    _teo_prepend AMENT_PREFIX_PATH "$_teo_root/.venv"
    # Set here so that the wheels' bootstrapper has no need to start Python a second time.
    _teo_prepend LD_LIBRARY_PATH "$_teo_root/.venv/lib"
fi
. "$_teo_root/install/setup.$_teo_shell"
# Participants find each other within a quarter of a second instead of up to three (see the file).
export FASTRTPS_DEFAULT_PROFILES_FILE="${FASTRTPS_DEFAULT_PROFILES_FILE:-$_teo_root/install/share/teo_ros2cli/config/fastdds.xml}"
# Last on the path: a genuine ros2 command, where there is one, is found first.
case ":$PATH:" in
    *":$_teo_root/install/lib/teo_ros2cli:"*) ;;
    *) export PATH="$PATH:$_teo_root/install/lib/teo_ros2cli" ;;
esac
# Completes its words with TAB, as the genuine one's own setup does; zsh once it has its completion loaded.
case "$-:$(command -v ros2)" in
    *i*:"$_teo_root"/*)
        if [ "$_teo_shell" = bash ] || whence compdef >/dev/null; then
            eval "$(register-python-argcomplete --shell "$_teo_shell" ros2)"
        fi
        ;;
esac
unset -f _teo_prepend
unset _teo_root _teo_shell
