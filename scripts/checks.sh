# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash

# What the set-up needs from the machine, and what to do where it is missing.

right_python() { # right_python <interpreter>: is it there, and 3.11 to 3.13?
    "$1" -c 'import sys; sys.exit(not (3, 11) <= sys.version_info[:2] <= (3, 13))' 2>/dev/null
}

choose_python() { # print $PYTHON, or the first interpreter with a right version
    local candidate
    for candidate in ${PYTHON:-python3 python3.13 python3.12 python3.11}; do
        # in a venv the interpreter below it: the venv may be the one that is made anew
        right_python "$candidate" &&
            { "$candidate" -c 'import sys; print(sys._base_executable)'; return; }
    done
    die "Python 3.11, 3.12 or 3.13 is needed, but ${PYTHON:-python3} is" \
        "$("${PYTHON:-python3}" --version 2>/dev/null || echo 'missing');" \
        'name another one with: make setup PYTHON=/path/to/python3.12'
}

check_python() { # check_python <interpreter>: has it venv, pip and headers?
    local version
    version=$("$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
    "$1" -c 'import venv, ensurepip' 2>/dev/null ||
        die "$1 has no venv module; on Debian or Ubuntu: sudo apt install python$version-venv"
    "$1" -c 'import os, sysconfig as s
os.stat(os.path.join(s.get_path("include"), "Python.h"))' 2>/dev/null ||
        die "$1 has no C headers; on Debian or Ubuntu: sudo apt install python$version-dev"
}

check_wheels() { # check_wheels <interpreter>: do the ROS wheels exist for this machine?
    [ "$(uname -sm)" = 'Linux x86_64' ] ||
        die "the ROS wheels exist for Linux x86_64 only, this is $(uname -sm);" \
            'install ROS 2 Jazzy and run make setup again'
    "$1" -c 'import platform, sys
sys.exit(tuple(map(int, platform.libc_ver()[1].split("."))) < (2, 28))' 2>/dev/null ||
        die 'the ROS wheels need glibc 2.28 or newer; install ROS 2 Jazzy and run make setup again'
}

check_ros_libraries() { # check_ros_libraries <interpreter>: has the ROS what apt gives beside it?
    command -v colcon >/dev/null ||
        die 'colcon is missing: sudo apt install python3-colcon-common-extensions'
    local module packages=()
    for module in numpy scipy matplotlib pytest; do # pip would bring a NumPy that ROS cannot load
        "$1" -c "import $module" 2>/dev/null || packages+=("python3-$module")
    done
    [ "${#packages[@]}" -eq 0 ] ||
        die "$1 lacks what the ROS needs beside it: sudo apt install ${packages[*]}"
}

check_compilers() {
    local tool
    for tool in cmake make; do
        command -v "$tool" >/dev/null ||
            die "$tool is missing; on Debian or Ubuntu: sudo apt install $tool"
    done
    for tool in "${CC:-cc}" "${CXX:-c++}"; do
        command -v "${tool%% *}" >/dev/null ||
            die "no C/C++ compiler ($tool); on Debian or Ubuntu: sudo apt install build-essential"
    done
}
