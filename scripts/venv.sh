# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2154

# Makes $venv with $python: on top of the ROS in $ros, or, where that is empty, with ROS as wheels.

venv_made_of() { # everything that decides what stands in .venv
    cat requirements/*.txt scripts/venv.sh scripts/repair_wheels.py \
        scripts/ament_environment/CMakeLists.txt
    echo "$venv $ros"
    "$python" -c 'import sys; print(sys.version, sys.base_prefix)'
}

pip_install() { # pip_install <text> <requirements file>
    step "$1" "$venv/bin/python" -m pip install --disable-pip-version-check --retries 2 \
        --progress-bar off --no-compile -r "$2" && return
    grep -qE 'NewConnectionError|ConnectTimeout|NameResolutionError|ProxyError|ReadTimeout' \
        "$step_log" && die "no network: pip cannot reach the package index; see $step_log"
    tail -n 5 "$step_log" >&2
    die "pip failed; the whole output is in $step_log"
}

write_environment() { # the setup.bash and setup.zsh of the prefix, which the wheels lack
    cmake -S scripts/ament_environment -B "$venv/ament_environment" \
        -DCMAKE_INSTALL_PREFIX="$venv" -DCMAKE_PREFIX_PATH="$venv" \
        -DPython3_EXECUTABLE="$venv/bin/python" &&
        cmake --install "$venv/ament_environment"
}

make_venv() {
    if [ -n "$ros" ]; then
        must "Python environment on top of $ros" \
            "$python" -m venv --system-site-packages "$venv"
        pip_install 'Libraries that Ubuntu lacks' requirements/with_ros.txt
    else
        must "Python environment ($("$python" --version))" "$python" -m venv "$venv"
        pip_install 'ROS 2 Jazzy and colcon (90 MB)' requirements/ros_wheels.txt
        must 'Repair the include directories of the wheels' \
            "$venv/bin/python" scripts/repair_wheels.py
        must 'Environment scripts of the wheels' write_environment
        head_start build_messages # compilers work while pip unpacks
        pip_install 'Numerical libraries and simulator (150 MB)' requirements/without_ros.txt
    fi
}
