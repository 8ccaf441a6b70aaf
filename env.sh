# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC1090,SC1091,SC2296

# Puts .venv and install/ into a bash or zsh:  . ./env.sh
# Discovery and transport stay as they are: a hand on the network must be found. The demo and the
# tests keep to this machine by themselves.

if [ -z "${BASH_VERSION:-}${ZSH_VERSION:-}" ]; then
    echo 'error: env.sh needs bash or zsh' >&2
    return 1
fi
grasp_quality_root=$(builtin cd "$(dirname "${BASH_SOURCE[0]:-${(%):-%x}}")" && pwd)
if [ -f "$grasp_quality_root/install/setup.bash" ] && [ ! -f "$grasp_quality_root/.venv/compiled" ]; then
    echo "error: the set-up of $grasp_quality_root is not complete: wait for make setup, or run it again" >&2
    unset grasp_quality_root
    return 1
elif [ -f "$grasp_quality_root/install/setup.bash" ]; then
    . "$grasp_quality_root/.venv/bin/activate"
    . "$grasp_quality_root/install/setup.${ZSH_VERSION:+z}${BASH_VERSION:+ba}sh"
    export GRASP_QUALITY_DCLAW_DIR="$grasp_quality_root/.venv/share/dclaw"
    export PATH="$grasp_quality_root/install/grasp_quality/lib/grasp_quality:$PATH"
    # behind all others: the hand's programs have names that others may have too (demo, viewer)
    export PATH="$PATH:$grasp_quality_root/install/grasp_quality_hand/lib/grasp_quality_hand"
    unset grasp_quality_root
else
    echo "error: nothing is built in $grasp_quality_root: run make setup first" >&2
    unset grasp_quality_root
    return 1
fi
