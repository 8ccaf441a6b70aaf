#!/usr/bin/env bash
# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0

# Branch coverage of the tests, with that of the processes they start (.coveragerc): of the core
# alone and of all. Arguments go to pytest.

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
export GRASP_QUALITY_ROOT=$PWD COVERAGE_RCFILE=$PWD/.coveragerc
core_least=95 all_least=85
nodes='grasp_quality/node*.py,grasp_quality/lifecycle_node.py'

rm -rf build/coverage
mkdir -p build/coverage
coverage run -m pytest test grasp_quality_hand/test "$@" || exit 1
coverage combine --quiet || exit 1
code=0
printf '\nall: core, adapters, nodes, command line, hand\n'
coverage report --fail-under="$all_least" || code=1
printf '\ncore: grasp_quality/ without its nodes\n'
coverage report --include='grasp_quality/*' --omit="$nodes" --fail-under="$core_least" || code=1
exit "$code"
