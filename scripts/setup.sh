#!/usr/bin/env bash
# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0

# Makes .venv (Python packages, and ROS where there is none) and install/ (the built packages).
# PYTHON names the interpreter. A second run only looks whether something changed.

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
root=$PWD
venv=$root/.venv
dclaw=$venv/share/dclaw
step_log=$root/log/setup.log
. scripts/steps.sh
. scripts/checks.sh

mkdir -p log
exec 9>log/setup.lock
flock 9 # two runs at once would write into the same .venv
: >"$step_log"
started=$SECONDS

unset _ROS_WHEELS_BOOTSTRAP_COMPLETE VIRTUAL_ENV # left over from a shell with env.sh
if [ -n "${ROS_DISTRO:-}" ] || [ -d /opt/ros/jazzy ]; then
    ros=/opt/ros/${ROS_DISTRO:-jazzy}
    [ -n "${AMENT_PREFIX_PATH:-}" ] || . "$ros/setup.bash" || die "$ros/setup.bash failed"
    command -v colcon >/dev/null ||
        die 'colcon is missing: sudo apt install python3-colcon-common-extensions'
    python=$(choose_python) || exit 1
else
    ros=
    unset AMENT_PREFIX_PATH CMAKE_PREFIX_PATH COLCON_PREFIX_PATH LD_LIBRARY_PATH PYTHONPATH
    python=$(choose_python) || exit 1
    check_wheels "$python"
fi
check_python "$python"
check_compilers

stamp() { # what .venv is made of
    cat requirements/*.txt scripts/setup.sh scripts/repair_wheels.py \
        scripts/ament_environment/CMakeLists.txt
    echo "$root $ros"
    "$python" -c 'import sys; print(sys.version, sys.base_prefix)'
}

pip_install() { # pip_install <text> <argument of pip install>...
    local text=$1
    shift
    step "$text" "$venv/bin/python" -m pip install --disable-pip-version-check --retries 2 \
        --progress-bar off "$@" && return
    tail -n 5 "$step_log" >&2
    grep -qE 'NewConnectionError|ConnectTimeout|NameResolutionError|ProxyError|ReadTimeout' \
        "$step_log" && die "no network: pip cannot reach the package index; see $step_log"
    die "pip failed; the whole output is in $step_log"
}

make_environment() { # a prefix-level setup.bash for the wheels
    cmake -S scripts/ament_environment -B "$venv/ament_environment" \
        -DCMAKE_INSTALL_PREFIX="$venv" -DCMAKE_PREFIX_PATH="$venv" \
        -DPython3_EXECUTABLE="$venv/bin/python" &&
        cmake --install "$venv/ament_environment"
}

build() {
    # colcon runs setup.py with its own interpreter, whose path the executables then start with
    COLCON_DEFAULTS_FILE=$root/colcon_defaults.yaml \
        "$venv/bin/python" "$(command -v colcon)" build --symlink-install \
        --cmake-args -DPython3_EXECUTABLE="$venv/bin/python" -DBUILD_TESTING=OFF
}

wanted=$(stamp | sha256sum)
if [ "$wanted" != "$(cat "$venv/stamp" 2>/dev/null)" ]; then
    rm -rf "$venv" install build/grasp_quality build/grasp_quality_{msgs,hand}
    if [ -n "$ros" ]; then
        must "Python environment on top of $ros" \
            "$python" -m venv --system-site-packages "$venv"
        pip_install 'Libraries that Ubuntu lacks' -r requirements/with_ros.txt
    else
        must "Python environment ($("$python" --version))" "$python" -m venv "$venv"
        pip_install 'ROS 2 Jazzy and colcon (70 MB)' -r requirements/ros_wheels.txt
        pip_install 'Numerical libraries and simulator (170 MB)' -r requirements/without_ros.txt
        must 'Repair the include directories of the wheels' \
            "$venv/bin/python" scripts/repair_wheels.py
        must 'Environment scripts of the wheels' make_environment
    fi
    echo "$wanted" >"$venv/stamp"
fi

PYTHONPATH=grasp_quality_hand${PYTHONPATH:+:$PYTHONPATH} must "D'Claw hand model" \
    "$venv/bin/python" -m grasp_quality_hand.fetch_dclaw "$dclaw"

built() { # what install/ is made of; Python modules are symlinks, so that they do not count
    cat "$venv/stamp"
    find colcon_defaults.yaml grasp_quality_msgs config launch {.,grasp_quality_hand}/resource \
        {.,grasp_quality_hand}/{package.xml,setup.py,setup.cfg} -type f \
        -exec sha256sum {} + 2>/dev/null | sort
}

wanted=$(built | sha256sum)
if [ "$wanted" != "$(cat install/stamp 2>/dev/null)" ]; then
    . "$venv/bin/activate"
    [ -n "$ros" ] || . "$venv/setup.bash"
    must 'Build the packages with colcon' build
    echo "$wanted" >install/stamp
fi
printf 'ready after %d s: enter with  . ./env.sh\n' $((SECONDS - started))
