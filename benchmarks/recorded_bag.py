# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Bags as a hand would record them, made without a hand: for tests and for measuring."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from grasp_quality.frames import frames_of_normals
import numpy as np
from numpy.typing import NDArray
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import get_typestore, Stores

STORE = get_typestore(Stores.ROS2_JAZZY)
TYPES: dict[str, Any] = dict(STORE.types)
START_NS = 1_700_000_000_000_000_000
PERIOD_NS = 5_000_000
STORAGE = {'mcap': StoragePlugin.MCAP, 'db3': StoragePlugin.SQLITE3}


def header(time_ns: int, frame: str = 'object') -> Any:
    """Make a std_msgs/Header."""
    stamp = TYPES['builtin_interfaces/msg/Time'](*divmod(time_ns, 1_000_000_000))
    return TYPES['std_msgs/msg/Header'](stamp, frame)


def pose_array(time_ns: int, positions: NDArray[np.float64], normals: NDArray[np.float64],
               frame: str = 'object') -> Any:
    """Make a geometry_msgs/PoseArray of contacts; positions [m] and inward normals (k, 3)."""
    point, turn, pose = (TYPES[f'geometry_msgs/msg/{name}']
                         for name in ('Point', 'Quaternion', 'Pose'))
    return TYPES['geometry_msgs/msg/PoseArray'](header(time_ns, frame), [
        pose(point(*map(float, p)), turn(*map(float, quaternion(R))))
        for p, R in zip(positions, frames_of_normals(normals))])


def wrench_stamped(time_ns: int, wrench: Any, frame: str) -> Any:
    """Make a geometry_msgs/WrenchStamped of fx fy fz [N] tx ty tz [N m]."""
    vector = TYPES['geometry_msgs/msg/Vector3']
    numbers = [float(v) for v in wrench]
    return TYPES['geometry_msgs/msg/WrenchStamped'](
        header(time_ns, frame), TYPES['geometry_msgs/msg/Wrench'](
            vector(*numbers[:3]), vector(*numbers[3:])))


def quaternion(R: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return x y z w of a rotation: an eigenvector, whatever the angle."""
    K = np.array([
        [R[0, 0] - R[1, 1] - R[2, 2], 0.0, 0.0, 0.0],
        [R[1, 0] + R[0, 1], R[1, 1] - R[0, 0] - R[2, 2], 0.0, 0.0],
        [R[2, 0] + R[0, 2], R[2, 1] + R[1, 2], R[2, 2] - R[0, 0] - R[1, 1], 0.0],
        [R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1], np.trace(R)]])
    return np.linalg.eigh(K)[1][:, -1]


def pinch(reach: float = 0.02) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Two contacts that face each other along x: positions [m] and inward normals."""
    return (np.array([[-reach, 0.0, 0.0], [reach, 0.0, 0.0]]),
            np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]]))


class BagWriter:
    """Writes messages of known types to topics of a bag; a context manager."""

    def __init__(self, path: Path, storage: str = 'mcap') -> None:
        self._writer = Writer(path, version=9, storage_plugin=STORAGE[storage])
        self._connections: dict[str, Any] = {}

    def __enter__(self) -> BagWriter:
        """Open the bag."""
        self._writer.open()
        return self

    def __exit__(self, *exc: object) -> None:
        """Close the bag."""
        self._writer.close()

    def add(self, topic: str, msgtype: str) -> None:
        """Add a topic, if it is not there, which may stay without messages."""
        if topic not in self._connections:
            self._connections[topic] = self._writer.add_connection(
                topic, msgtype, typestore=STORE)

    def write(self, topic: str, time_ns: int, message: Any) -> None:
        """Write a message."""
        self.write_raw(topic, time_ns, message.__msgtype__, STORE.serialize_cdr(
            message, message.__msgtype__))

    def write_raw(self, topic: str, time_ns: int, msgtype: str, data: Any) -> None:
        """Write bytes as if they were a message of a type."""
        self.add(topic, msgtype)
        self._writer.write(self._connections[topic], time_ns, data)


def random_grasps(seed: int, contacts: int) -> Iterator[tuple[Any, Any]]:
    """Contacts that wander over a ball of 3 cm radius, without end."""
    random = np.random.default_rng(seed)
    normals = random.normal(size=(contacts, 3))
    while True:
        normals = normals + 0.02 * random.normal(size=normals.shape)
        normals /= np.linalg.norm(normals, axis=1, keepdims=True)
        yield -0.03 * normals, normals


def write_hand(path: Path, samples: int, contacts: int, storage: str = 'mcap',
               measured: bool = False, filler: int = 0,
               advance: Callable[[int], object] = lambda i: None) -> None:
    """
    Record a hand at 200 Hz.

    Parameters
    ----------
    path : Path
        Of the bag's folder.
    samples, contacts : int
        Number of contact messages, and of contacts in each.
    storage : str
        'mcap' or 'db3'.
    measured : bool
        Whether a measured wrench comes with each contact.
    filler : int
        Bytes of another topic beside each sample, as a camera records.
    advance : function of int
        Told the number of every sample that was written.

    """
    other = TYPES['std_msgs/msg/UInt8MultiArray'](
        TYPES['std_msgs/msg/MultiArrayLayout']([], 0),
        np.random.default_rng(0).integers(0, 256, filler, dtype=np.uint8))
    with BagWriter(path, storage) as bag:
        for i, (positions, normals) in zip(range(samples), random_grasps(1, contacts)):
            time_ns = START_NS + i * PERIOD_NS
            for k in range(contacts if measured else 0):
                name = f'contact_{k}'
                bag.write(f'/grasp_quality/contact_wrenches/{name}', time_ns, wrench_stamped(
                    time_ns, [0.2, 0.1, 2.0, 0.0, 0.0, 0.0], name))
            bag.write('/grasp_quality/contact_poses', time_ns + 1000, pose_array(
                time_ns, positions, normals))
            if filler:
                bag.write('/camera', time_ns + 2000, other)
            advance(i)
