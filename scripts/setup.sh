#!/usr/bin/env bash
# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0

# Makes .venv (Python packages, and ROS where there is none) and install/ (the built packages).
# PYTHON names the interpreter. A second run only looks whether something changed.

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
venv=$PWD/.venv
dclaw=$venv/share/dclaw
step_log=$PWD/log/setup.log
. scripts/steps.sh
. scripts/checks.sh
. scripts/venv.sh

mkdir -p log || die "cannot write to $PWD"
exec 9>log/setup.lock
flock 9 # two runs at once would write into the same .venv
: >"$step_log"
started=$SECONDS

unset _ROS_WHEELS_BOOTSTRAP_COMPLETE VIRTUAL_ENV # left over from a shell with env.sh
if [ -n "${ROS_DISTRO:-}" ] || [ -d /opt/ros/jazzy ]; then
    ros=/opt/ros/${ROS_DISTRO:-jazzy}
    [ -n "${AMENT_PREFIX_PATH:-}" ] || . "$ros/setup.bash" || die "$ros/setup.bash failed"
    python=$(choose_python) || exit 1
    check_ros_libraries "$python"
else
    ros=
    unset AMENT_PREFIX_PATH CMAKE_PREFIX_PATH COLCON_PREFIX_PATH LD_LIBRARY_PATH PYTHONPATH
    python=$(choose_python) || exit 1
    check_wheels "$python"
fi
check_python "$python"
check_compilers

build() { # colcon runs setup.py with its own interpreter, which the executables then start with
    "$venv/bin/python" "$(command -v colcon)" build --symlink-install "$@" \
        --cmake-args -DPython3_EXECUTABLE="$venv/bin/python" -DBUILD_TESTING=OFF
}

build_messages() { # where the wheels are; in a shell of its own
    . "$venv/bin/activate"
    . "$venv/setup.bash"
    build --packages-select grasp_quality_msgs
}

build_all() {
    catch_up
    head_start compile
    build
}

compile() {
    "$venv/bin/python" -m grasp_quality.warm_up
}

compile_all() {
    catch_up
    compile
}

wanted=$(venv_made_of | sha256sum)
if [ "$wanted" != "$(cat "$venv/stamp" 2>/dev/null)" ]; then
    rm -rf "$venv" install build/grasp_quality build/grasp_quality_{msgs,hand}
    make_venv
    echo "$wanted" >"$venv/stamp"
fi

PYTHONPATH=grasp_quality_hand${PYTHONPATH:+:$PYTHONPATH} must "D'Claw hand model" \
    "$venv/bin/python" -m grasp_quality_hand.fetch_dclaw "$dclaw"

built_of() { # everything that decides what stands in install/; Python modules are symlinks there
    cat "$venv/stamp"
    find colcon_defaults.yaml grasp_quality_msgs config launch {.,grasp_quality_hand}/resource \
        {.,grasp_quality_hand}/{package.xml,setup.py,setup.cfg} -type f \
        -exec sha256sum {} + 2>/dev/null | sort
}

wanted=$(built_of | sha256sum)
if [ "$wanted" != "$(cat install/stamp 2>/dev/null)" ]; then
    . "$venv/bin/activate"
    [ -n "$ros" ] || . "$venv/setup.bash"
    must 'Build the packages with colcon' build_all
    echo "$wanted" >install/stamp
fi

compiled_of() { # numba caches machine code beside the source; see grasp_quality/kernel.py
    cat "$venv/stamp" grasp_quality/kernel.py
}

wanted=$(compiled_of | sha256sum)
if [ "$wanted" != "$(cat "$venv/compiled" 2>/dev/null)" ]; then
    must 'Compile the kernel' compile_all
    echo "$wanted" >"$venv/compiled"
fi
catch_up
printf 'ready after %d s: enter with  . ./env.sh\n' $((SECONDS - started))
