#!/usr/bin/env bash
# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0

# All tests; arguments go to pytest. Three files at a time first, because most tests of nodes wait;
# then, one after the other, those that need the machine for themselves (marker "alone"), and those
# that run as on a robot (marker "robot"): with shared memory beside UDP (test/node/transports.py).
# PYTEST may say how to start pytest (scripts/coverage.sh).

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
nothing=5 # pytest's exit code where arguments leave no test

run() {
    ${PYTEST:-python -m pytest} "$@"
    local code=$?
    [ $code -eq $nothing ] || chosen=yes
    [ $code -eq 0 ] || [ $code -eq $nothing ] || failed=$code
}

chosen= failed=0
run -n 3 --dist loadfile --no-loadscope-reorder -m 'not alone and not robot' grasp_quality_hand/test test "$@"
run -m alone test grasp_quality_hand/test "$@"
mapfile -t robot < <(grep -rl --include='test_*.py' 'mark\.robot' test)
TEST_TRANSPORTS=default run -m robot "${robot[@]}" "$@"
[ -n "$chosen" ] || { echo 'error: no test was chosen' >&2; exit $nothing; }
exit $failed
