# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Closed loop at 200 Hz through ROS topics: does the hand hold, and what if a node dies.

    python -m benchmarks.closed_loop ball       one object, or several; all when left out

Prints, and writes the object's section of docs/closed_loop.md; with --dry it only prints.

Ends non-zero when a bound is broken.
"""

from pathlib import Path
import sys
from typing import NamedTuple

from benchmarks import document
from benchmarks.closed_loop_rig import drift, RATE_HZ, Rig
from grasp_quality_hand.demo_processes import claim_domain
import rclpy

DOCUMENT = Path(__file__).parents[1] / 'docs' / 'closed_loop.md'
FOLDER = Path('build') / 'closed_loop'
HOLD_S, AFTER_S = 30.0, 10.0
OBJECTS = ('ball', 'cube')
CASES: dict[str, dict[str, float]] = {
    'undisturbed': {},
    '5 % of messages lost, 10 ms late, both ways': {'drop_rate': 0.05, 'delay': 0.01},
    'contacts uncertain by 0.2 mm and 0.02 rad': {'position_noise': 2e-4, 'normal_noise': 0.02}}
LARGEST_DRIFT_M = 0.5e-3           # in 30 s, with a good network
DROPPED_M = 5e-3                   # a way down that counts as dropped
STATED_S = 0.1 + 0.2 + 1.0 / RATE_HZ   # max_force_age, ramp_time, a period
LOOK_S = 0.05                      # by which this process may notice a diagnosis late


class Row(NamedTuple):
    """Figures of one case."""

    case: str
    contact_rate: float
    command_rate: float
    way_mm: float
    turn_mrad: float
    hold_s: float
    after_mm: float
    broken: str


def measure(name: str, case: str) -> Row:
    """Hold an object, then kill the quality node."""
    rig = Rig(FOLDER / f'{name}_{list(CASES).index(case)}', name, **CASES[case])
    try:
        rig.grasp()
        rig.poses.clear()
        rig.commands.clear()
        rig.contacts = 0
        rig.spin(HOLD_S)
        way, turn = drift(rig.poses)
        rates = rig.contacts / HOLD_S, len(rig.commands) / HOLD_S
        rig.poses.clear()
        rig.phases.clear()
        killed = rig.kill_quality()
        rig.until(lambda: any(phase == 'HOLDING' for _, phase in rig.phases), 'a hold')
        held = next(at for at, phase in rig.phases if phase == 'HOLDING') - killed
        rig.spin(AFTER_S)
        after, _ = drift(rig.poses)
    finally:
        rig.close()
    limit = DROPPED_M if CASES[case] else LARGEST_DRIFT_M
    broken = [text for text, bad in (
        (f'drift above {1e3 * limit:g} mm', way > limit),
        (f'hold later than {STATED_S:g} s', held > STATED_S + LOOK_S),
        ('dropped', after > DROPPED_M)) if bad]
    return Row(case, *rates, 1e3 * way, 1e3 * turn, held, 1e3 * after,
               '; '.join(broken))


def table(rows: list[Row]) -> str:
    """Lay the figures out."""
    lines = ['| case | contacts [1/s] | commands [1/s] | largest way in 30 s [mm] | '
             'largest turn [mrad] | kill -9 of the quality node to hold [s] | largest way in 10 s '
             'after it [mm] |', '|---|---|---|---|---|---|---|']
    lines += [f'| {r.case} | {r.contact_rate:.0f} | {r.command_rate:.0f} | {r.way_mm:.3f} | '
              f'{r.turn_mrad:.2f} | {r.hold_s:.3f} | {r.after_mm:.3f} |' for r in rows]
    return '\n'.join(lines)


def main() -> int:
    """Measure the objects that the command line names."""
    names = [word for word in sys.argv[1:] if word != '--dry'] or list(OBJECTS)
    claim = claim_domain()
    rclpy.init()
    broken = False
    for name in names:
        rows = []
        for case in CASES:
            rows.append(measure(name, case))
            print(f'{name}: {table(rows[-1:]).splitlines()[-1]} {rows[-1].broken or "kept"}',
                  flush=True)
        broken = broken or any(row.broken for row in rows)
        if '--dry' not in sys.argv:
            text = f'{document.machine()}\n\n{table(rows)}'
            document.write(f'closed_loop {name}', text, DOCUMENT)
    rclpy.shutdown()
    claim.close()
    return int(broken)


if __name__ == '__main__':
    sys.exit(main())
