# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What keeps nodes of tests and benchmarks on this machine.

Usually that is a profile of Fast DDS, ``loopback.xml``: UDP on the loopback device only, so that
every lost datagram is counted by Linux and a killed process leaves nothing behind. With
TEST_TRANSPORTS=default in the environment it is the discovery range LOCALHOST, as of the demo:
there rmw_fastrtps puts shared memory beside UDP by itself, whatever else it is told.
"""

from contextlib import suppress
import os
from pathlib import Path

CHOICE = 'TEST_TRANSPORTS'
RANGE = 'ROS_AUTOMATIC_DISCOVERY_RANGE'
FILE = 'FASTRTPS_DEFAULT_PROFILES_FILE'
PROFILE = Path(__file__).with_name('loopback.xml')


def are_default():
    """Whether nodes talk as they do without a profile, by shared memory and UDP."""
    choice = os.environ.get(CHOICE, 'loopback')
    if choice not in ('loopback', 'default'):
        raise ValueError(f'{CHOICE} is {choice!r}; it may be loopback or default')
    return choice == 'default'


def words():
    """Return how nodes talk, for the reports of benchmarks."""
    return f'Fast DDS over {"shared memory and UDP" if are_default() else "UDP"}'


def keep_to_this_machine():
    """
    Set the environment of this process and its children; before it has made a ROS node.

    A profile that is not there must not pass: Fast DDS says little and talks to the whole subnet.
    """
    if are_default():
        os.environ[RANGE] = 'LOCALHOST'
        os.environ.pop(FILE, None)
        return
    if not PROFILE.is_file():
        raise FileNotFoundError(f'{PROFILE} keeps nodes on this machine and is not there')
    os.environ.update({RANGE: 'SYSTEM_DEFAULT', FILE: str(PROFILE)})


def udp_sockets(pid):
    """Return the UDP sockets of a process: each line of /proc/net/udp as its fields."""
    own = set()
    for link in Path(f'/proc/{pid}/fd').iterdir():
        with suppress(OSError):  # closed meanwhile
            own.add(os.readlink(link))
    rows = [row.split() for row in Path(f'/proc/{pid}/net/udp').read_text().splitlines()[1:]]
    return [row for row in rows if f'socket:[{row[9]}]' in own]


def lost_words(count):
    """Return what ``dropped`` found, for a table: of shared memory it knows nothing."""
    return 'not counted: shared memory' if are_default() else str(count)


def dropped(pid):
    """Return how many datagrams the sockets of a process had no room for."""
    return sum(int(row[12]) for row in udp_sockets(pid))
