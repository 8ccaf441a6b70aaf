#!/usr/bin/env bash
# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0

# The ament linters, ruff (ruff.toml), mypy (mypy.ini), the pins of requirements/, package.xml, the
# licence headers and the length of the files.

cd "$(dirname "${BASH_SOURCE[0]}")/.." || exit 1
code=0
types=$(mktemp)
trap 'rm -f "$types"' EXIT
folders=()
for folder in grasp_quality grasp_quality_cli msg_adapters launch test examples benchmarks scripts \
    grasp_quality_msgs grasp_quality_hand; do
    [ -d "$folder" ] && folders+=("$folder")
done

# an ordinary ROS brings packages of apt, whose older NumPy has other types
pinned=
python -c 'import numpy; raise SystemExit(int(numpy.__version__.split(".")[0]) < 2)' && pinned=yes
if [ -n "$pinned" ]; then # beside the others, on another core
    mypy >"$types" 2>&1 &
    typing=$!
fi

ament_flake8 setup.py "${folders[@]}" || code=1
ament_pep257 setup.py "${folders[@]}" 2> >(grep -v '^checking ' >&2) || code=1

ruff check --quiet . || code=1
python scripts/check_requirements.py || code=1
python -c 'import sys
from catkin_pkg.package import parse_package
for path in sys.argv[1:]:
    parse_package(path)' package.xml ./*/package.xml || code=1
if [ -n "$pinned" ]; then
    python -m pip check --disable-pip-version-check --quiet || code=1
    wait "$typing" || { cat "$types"; code=1; }
fi

mapfile -t sources < <(find setup.py env.sh Makefile .ci "${folders[@]}" -type f \
    \( -name '*.py' -o -name '*.sh' -o -name '*.msg' -o -name '*.srv' -o -name 'CMakeLists.txt' \
    -o -name Makefile -o -name run \))
headless=$(grep -L -e '^# SPDX-License-Identifier: Apache-2.0$' "${sources[@]}")
[ -z "$headless" ] || { printf 'no licence header:\n%s\n' "$headless"; code=1; }
# compiled files alone may be longer: numba's cache sees only changes of the file a function stands
# in, so that compiled code has to stand in the file of what it calls
long=$(wc -l "${sources[@]}" | awk '$2 != "total" && $2 !~ /^grasp_quality\/(kernel|judge)\.py$/ \
    && $2 != "grasp_quality/ball_search.py" && $1 > 250 {print $2 ": " $1 " lines"}')
[ -z "$long" ] || { printf 'over 250 lines:\n%s\n' "$long"; code=1; }

[ $code -eq 0 ] && echo "lint: ${#sources[@]} files clean"
exit $code
