# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What a quality node received and published, put together again by stamp and judged.

Topics arrive in any order, one stamp may be evaluated more than once (a new task), and parameters
change between a sample and its answer. So a force set is judged ``GRACE_S`` after it came: it must
pass with one combination of contacts and quality of its own stamp and parameters of the moment at
which it was sent: on a busy machine it may be read long after they were replaced.
What cannot be judged because a part never came (best effort topics may lose one) is counted apart,
and judged by what must hold whatever that part was.
So is an objection that rests on a quality not seen, near (``GRACE_S``) qualities known to be lost,
or with none heard that was sent later: it may be on its way, or not read yet. For a later one a
part waits ``LATE_S``.
"""

from collections import Counter, deque
from dataclasses import dataclass, field
import itertools
from typing import TypeVar

from grasp_quality_hand.audit_parts import (
    Contacts, Forces, joints_of, limits_alone, limits_of, LocalWrench, Quality, Settings)
from grasp_quality_hand.audit_sequence import Gaps
from grasp_quality_hand.force_rules import (
    broken_alone, broken_balance, broken_forces, broken_joints, SMALL)
import numpy as np

Part = TypeVar('Part')
STAMPED = (Contacts, Forces, LocalWrench, Quality)

GRACE_S = 1.0    # after which all that belongs to a message has come
PATIENCE_S = 20.0  # for the first parameters
LATE_S = 5.0     # after which no later quality will come
MEMORY_S = 8.0   # parts older than this are forgotten
SETTINGS_MEMORY_S = 60.0  # and parameters that were replaced so long ago
MOST_TRIED = 200  # combinations of parts of one stamp
OWN_CAPS = 1e3  # largest cap of a contact's own over the node's, or over any force beside it
MOST = 20_000    # parts of one kind that are kept, whatever their age


@dataclass
class Count:
    """Force sets judged, and those that a missing part kept from being judged."""

    judged: int = 0
    unjudged: dict[str, int] = field(default_factory=dict)
    violations: int = 0


class ForceRecords:
    """Collects parts with ``store`` and gives the violations that are certain by ``judge``."""

    def __init__(self, allowance_s: float = 0.05) -> None:
        self._allowance_s = allowance_s
        self._patience_s = np.inf
        self._known_s = np.inf  # when the first parameters came; nobody tells those before them
        self._own_limits = False  # contacts came that may bring limits of their own
        self._kept: dict[type, deque[tuple[float, object]]] = {}
        self._stamped: dict[tuple[type, int], list[object]] = {}  # the same by kind and stamp
        self._alphas: Counter[float] = Counter()  # of the OPTIMAL qualities among them
        self._qualities = Gaps()
        self._waiting: deque[tuple[float, float, object]] = deque()  # came, sent, what
        self.count = Count()

    def store(self, part: object, now_s: float, sent_s: float | None = None,
              lost_since_s: float | None = None) -> None:
        """
        Keep a part (a class of audit_parts, or a float for alpha).

        ``now_s`` is the time of its arrival, ``sent_s`` that of its sending by the same clock, and
        from ``lost_since_s`` on others of its kind were sent and did not come.

        """
        sent_s = now_s if sent_s is None else sent_s
        self._own_limits |= isinstance(part, Contacts) and not part.are_poses
        kept = self._kept.setdefault(type(part), deque())
        if isinstance(part, Settings):
            self._known_s = min(self._known_s, sent_s)
            if not kept or kept[-1][1] != part:
                kept.append((sent_s, part))
        else:
            kept.append((now_s, part))
        if isinstance(part, STAMPED):
            self._stamped.setdefault((type(part), part.stamp), []).append(part)
        if isinstance(part, Quality) and part.optimal:
            self._alphas[part.alpha] += 1
        if isinstance(part, Quality):
            self._qualities.note(sent_s, lost_since_s)
        if len(kept) > MOST:
            self._forget(kept)
        self._patience_s = min(self._patience_s, now_s + PATIENCE_S)
        if isinstance(part, (Forces, Quality, LocalWrench, float)):
            self._waiting.append((now_s, sent_s, part))

    def judge(self, now_s: float) -> list[str]:
        """Judge all that has waited long enough, and for the parameters; return what is wrong."""
        said: list[str] = []
        if not self._kept.get(Settings) and now_s < self._patience_s:
            return said
        while self._waiting and self._is_due(now_s, *self._waiting[0][:2]):
            said += self._judge(*self._waiting.popleft())
        for kind, kept in self._kept.items():
            ended, memory = (1, SETTINGS_MEMORY_S) if kind is Settings else (0, MEMORY_S)
            while len(kept) > 1 and kept[ended][0] < now_s - memory:  # the newest holds on
                self._forget(kept)
        self._qualities.forget(now_s - SETTINGS_MEMORY_S)
        self.count.violations += len(said)
        return said

    def _is_due(self, now_s: float, arrived_s: float, sent_s: float) -> bool:
        grace_s = GRACE_S if self._qualities.heard_after(sent_s) else LATE_S
        return arrived_s <= now_s - grace_s

    def _forget(self, kept: deque[tuple[float, object]]) -> None:
        _, part = kept.popleft()
        if isinstance(part, STAMPED):
            same = self._stamped[type(part), part.stamp]
            del same[0]  # the oldest of them came first
            if not same:
                del self._stamped[type(part), part.stamp]
        if isinstance(part, Quality) and part.optimal:
            self._alphas -= Counter([part.alpha])

    def _judge(self, arrived_s: float, sent_s: float, part: object) -> list[str]:
        if isinstance(part, Quality):
            numbers = (part.alpha, *part.others)
            if not np.isfinite(numbers).all():
                return [f'quality is not finite: {numbers}']
            if not part.optimal and any(numbers):
                return [f'quality is not OPTIMAL and yet holds {numbers}']
        elif isinstance(part, float):
            if part == 0.0 or part in self._alphas:
                return []
            if self._qualities.may_come(sent_s, GRACE_S) or not any(
                    abs(since_s - arrived_s) <= GRACE_S
                    for since_s, _ in self._kept.get(Quality, ())):
                return self._leave('quality')  # not listening to it yet, or on its way, or lost
            return [f'alpha {part:.9g} stands in no OPTIMAL quality']
        elif isinstance(part, Forces):
            return self._judge_forces(sent_s, part) if part.forces else []
        elif isinstance(part, LocalWrench) and part.wrench.any():
            return self._judge_local(sent_s, part)
        return []

    def _parts(self, kind: type[Part]) -> list[Part]:
        return [part for _, part in self._kept.get(kind, ()) if isinstance(part, kind)]

    def _of_stamp(self, kind: type[Part], stamp: int) -> list[Part]:
        return [p for p in self._stamped.get((kind, stamp), ()) if isinstance(p, kind)]

    def _settings(self, sent_s: float) -> list[Settings]:
        """Return those in force at some time from two grace times before on."""
        ends = [since_s for since_s, _ in self._kept.get(Settings, ())][1:] + [np.inf]
        return list({settings: None for end_s, settings in zip(ends, self._parts(Settings))
                     if end_s >= sent_s - 2 * GRACE_S})

    def _judge_forces(self, sent_s: float, part: Forces) -> list[str]:
        settings = self._settings(sent_s)
        contacts = list({  # a frozen sensor says the same again and again
            c.content: c for c in self._of_stamp(Contacts, part.stamp)}.values())
        qualities = list({
            q.content: q for q in self._of_stamp(Quality, part.stamp)}.values())
        in_frame = [c for c in contacts if c.frame in ('', part.frame)]
        if not all(np.isfinite(force.wrench).all() for force in part.forces):
            return [f'forces of stamp {part.stamp} are not finite']
        if qualities and not any(quality.optimal for quality in qualities) \
                and not self._qualities.may_come(sent_s, GRACE_S):
            return [f'forces of stamp {part.stamp}: the quality beside them is not OPTIMAL']
        for name, found in (('parameters', settings), ('contacts', contacts),
                            ('quality', qualities), ('transform', in_frame)):
            if not found:
                self._leave(name)
                known = settings if sent_s >= self._known_s else []
                return [f'forces of stamp {part.stamp}, judged without {name}: {text}'
                        for text in self._wrong_alone(part, known)]
        best: list[str] | None = None
        tried = itertools.product(in_frame[::-1], qualities[::-1], settings[::-1])
        for parts in itertools.islice(tried, MOST_TRIED):
            said = _wrong(part, *parts, self._allowance_s)
            if best is None or len(said) < len(best):
                best = said
            if not best:
                break
        if best and next(tried, None):  # one stamp for everything, as when nothing is stamped
            return self._leave('stamp of its own')
        if best and self._qualities.may_come(sent_s, GRACE_S) and not all(
                _wrong(part, received, None, own, self._allowance_s)
                for received, own in itertools.product(in_frame, settings)):
            return self._leave('quality')
        if best and sent_s < self._known_s:
            return self._leave('settings of its time')
        self.count.judged += 1
        return [f'forces of stamp {part.stamp}: {text}' for text in best or ()]

    def _wrong_alone(self, part: Forces, settings: list[Settings]) -> list[str]:
        """Tell what is wrong with forces whatever the contacts and the quality were."""
        if self._own_limits or not settings or any(
                own.contact_source != 'pose_array' for own in settings):
            sizes = [np.abs(force.wrench[:3]).max() for force in part.forces]
            return broken_alone(part.forces, OWN_CAPS * max(
                [*sizes, *(own.max_normal_force for own in settings)]))
        return min((broken_alone(part.forces, own.max_normal_force) or broken_forces(
            part.forces, limits_alone(part.forces, own), own.force_bound)
            for own in settings), key=len)

    def _leave(self, missing: str) -> list[str]:
        self.count.unjudged[missing] = self.count.unjudged.get(missing, 0) + 1
        return []

    def _judge_local(self, sent_s: float, part: LocalWrench) -> list[str]:
        sets = [forces for forces in self._of_stamp(Forces, part.stamp) if not forces.are_holding]
        contacts = self._of_stamp(Contacts, part.stamp)
        settings = self._settings(sent_s)
        for name, found in (('forces', sets), ('contacts', contacts), ('parameters', settings)):
            if not found:
                return self._leave(name)
        for forces, received, own in itertools.product(sets, contacts, settings):
            limits = limits_of(received, own)
            for force in forces.forces:
                if force.name == part.name and force.name in limits:
                    R, cap = limits[force.name].R, limits[force.name].cap
                    local = np.concatenate([R.T @ force.wrench[:3], R.T @ force.wrench[3:]])
                    if np.abs(local - part.wrench).max() <= SMALL * cap:
                        return []
        return [f'optimal_wrenches/{part.name} of stamp {part.stamp} is not the force beside it']


def _wrong(part: Forces, contacts: Contacts, quality: Quality | None, settings: Settings,
           allowance_s: float) -> list[str]:
    """Tell what is wrong with forces that belong to these parts; None: any quality will do."""
    said = []
    if quality is not None and not quality.optimal:
        said.append('the quality beside them is not OPTIMAL')
    if part.age_s is not None and part.age_s > settings.max_contact_age + allowance_s:
        said.append(f'sent {part.age_s:.4f} s after their contacts, max_contact_age is '
                    f'{settings.max_contact_age:g} s')
    limits = limits_of(contacts, settings)
    said += broken_forces(part.forces, limits, settings.force_bound)
    if said:
        return said
    said = broken_joints(part.forces, joints_of(contacts, list(limits)))
    if quality is None:
        return said
    alpha = 0.0 if part.are_holding else quality.alpha
    return said + broken_balance(part.forces, limits, alpha * quality.task - quality.load)
