# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2154

# Long steps: one line each with the time it took; what they print goes to the file $step_log.

die() { # die <text>...: one line on stderr, and out
    printf 'error: %s\n' "$*" >&2
    exit 1
}

step() { # step <text> <command>...: run it quietly; returns its exit code
    local text=$1 begin=$SECONDS code=0 dots
    shift
    printf '%-52s ' "$text"
    { while sleep 5 >/dev/null 2>&1; do printf '.'; done } 9>&- & # 9 is the lock of setup.sh
    dots=$!
    # shellcheck disable=SC2064
    trap "kill $dots 2>/dev/null" EXIT
    printf '\n== %s\n' "$text" >>"$step_log"
    "$@" >>"$step_log" 2>&1 </dev/null || code=$?
    kill "$dots" 2>/dev/null
    wait "$dots" 2>/dev/null
    trap - EXIT
    if [ "$code" -eq 0 ]; then
        printf ' %d s\n' $((SECONDS - begin))
    else
        printf ' failed after %d s\n' $((SECONDS - begin))
    fi
    return "$code"
}

must() { # must <text> <command>...: a step whose failure ends the set-up
    step "$@" && return
    tail -n 15 "$step_log" >&2
    die "'$1' failed; the whole output is in $step_log"
}

begun=()

head_start() { # head_start <function>: begin what a later step does again, should this fail
    "$1" >"$step_log.$1" 2>&1 </dev/null & # with the lock: who comes next waits for it
    begun+=($!)
}

catch_up() { # wait for what has a head start
    [ ${#begun[@]} -eq 0 ] || wait "${begun[@]}"
    begun=()
}
