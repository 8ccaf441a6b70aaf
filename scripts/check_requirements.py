# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Check that every requirement is pinned, and that exactly the pinned versions are installed.

Where the ROS wheels are, every package of .venv has to be named in requirements/: nothing comes in
by another's wish alone. Beside an ordinary ROS most packages are those of apt, and only the direct
requirements are compared.
"""

from importlib.metadata import distributions
from pathlib import Path
import re
import sys

REQUIREMENTS = Path(__file__).parents[1] / 'requirements'
PINNED = re.compile(r'([A-Za-z0-9][A-Za-z0-9._-]*)==([A-Za-z0-9.!+]+)')
UNPINNED = {'pip'}  # makes the environment itself


def plain(name: str) -> str:
    """Return a package's name as it is compared (PEP 503)."""
    return re.sub(r'[-_.]+', '-', name).lower()


def pins(name: str, complaints: list[str]) -> dict[str, str]:
    """Read the pins of a file and of those that it includes; complain about what is no pin."""
    found: dict[str, str] = {}
    for number, raw in enumerate((REQUIREMENTS / name).read_text().splitlines(), 1):
        line = raw.split('#')[0].strip()
        if line.startswith(('-r ', '-c ')):
            found |= pins(line[3:].strip(), complaints)
        elif match := PINNED.fullmatch(line):
            found[plain(match[1])] = match[2]
        elif line:
            complaints.append(f'{name}:{number}: {line!r} is not pinned: write name==version')
    return found


def main() -> int:
    """Print what is wrong; return 1 where something is."""
    complaints: list[str] = []
    files = {path.name: pins(path.name, complaints) for path in REQUIREMENTS.glob('*.txt')}
    installed = {plain(d.metadata['Name']): d.version for d in distributions()
                 if (d.read_text('INSTALLER') or '').strip() == 'pip'}
    wheels = 'ros-jazzy-rclpy' in installed
    wanted = {**files['ros_wheels.txt'], **files['without_ros.txt']} if wheels else (
        files['with_ros.txt'])
    direct = {k: v for k, v in wanted.items() if k not in files['constraints.txt']}
    for name, version in sorted(direct.items()):
        if name not in installed:
            complaints.append(f'{name}=={version} is not installed: run make setup')
    for name, version in sorted(installed.items()):
        if name in wanted and version != wanted[name]:
            complaints.append(f'{name} {version} is installed, {wanted[name]} is pinned: run '
                              'make setup')
        elif wheels and name not in wanted and name not in UNPINNED:
            complaints.append(f'{name} {version} is installed and pinned nowhere: add '
                              f'{name}=={version} to requirements/constraints.txt')
    print('\n'.join(dict.fromkeys(complaints)), end='\n' if complaints else '')
    return int(bool(complaints))


if __name__ == '__main__':
    sys.exit(main())
