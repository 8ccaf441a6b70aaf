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
So is an objection that rests on a quality not seen, near (``NEAR_S``) qualities known to be lost,
or with none heard that was sent later: it may be on its way, or not read yet; and one to what was
sent when the parameters may have been others already. For both a part waits ``LATE_S``. So is one
to what was read ``UNREAD_S`` after it was sent: what it belongs to may be forgotten.
"""

from collections import Counter, deque
from collections.abc import Hashable
from dataclasses import dataclass, field
import itertools
from typing import TypeVar

from grasp_quality_hand.audit_parts import Contacts, Forces, LocalWrench, Quality, Settings
from grasp_quality_hand.audit_rules import is_among, that_count, wrong, wrong_alone
from grasp_quality_hand.audit_sequence import Gaps
from grasp_quality_hand.audit_settings import SettingsInForce
import numpy as np

Part = TypeVar('Part')
STAMPED = (Contacts, Forces, Quality)  # what others are looked up in by their stamp

GRACE_S = 1.0    # after which all that belongs to a message has come
NEAR_S = 1.0     # between the sending of what belongs together
PATIENCE_S = 20.0  # for the first parameters
LATE_S = 5.0     # after which no later quality will come, and no answer about parameters
MEMORY_S = 8.0   # parts that came longer ago are forgotten: longer than any waits
UNREAD_S = MEMORY_S - LATE_S  # what a part belongs to is there if this had not waited longer
LOSSES_S = 60.0  # and losses older than this
MOST_TRIED = 200  # combinations of parts of one stamp
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
        self._settings = SettingsInForce()
        self._sure_s = np.inf  # until when these are known to be all
        self._kept: dict[type, deque[tuple[float, object]]] = {}
        # The same by kind and stamp, then by content, the newest last, with how often it is kept:
        # a frozen sensor says the same again and again.
        self._stamped: dict[tuple[type, int], dict[Hashable, tuple[int, object]]] = {}
        self._alphas: Counter[float] = Counter()  # of the OPTIMAL qualities among them
        self._qualities = Gaps()
        self._waiting: deque[tuple[float, float, object]] = deque()  # came, sent, what
        self.count = Count()

    def store(self, part: object, now_s: float, sent_s: float | None = None,
              lost_since_s: float | None = None) -> None:
        """
        Keep a part (a class of audit_parts, or a float for alpha).

        ``now_s`` is the time of its arrival, ``sent_s`` that of its sending by the same clock, and
        from ``lost_since_s`` on others of its kind were sent and did not come. Settings may be in
        force from ``sent_s`` on, and those before them until ``now_s``.

        """
        sent_s = now_s if sent_s is None else sent_s
        self._patience_s = min(self._patience_s, now_s + PATIENCE_S)
        if isinstance(part, Settings):
            self._settings.note(part, sent_s, now_s)
            return
        kept = self._kept.setdefault(type(part), deque())
        kept.append((now_s, part))
        if isinstance(part, STAMPED):
            same = self._stamped.setdefault((type(part), part.stamp), {})
            times, _ = same.pop(part.content, (0, None))
            same[part.content] = times + 1, part
        if isinstance(part, Quality) and part.optimal:
            self._alphas[part.alpha] += 1
        if isinstance(part, Quality):
            self._qualities.note(sent_s, lost_since_s)
        if len(kept) > MOST:
            self._forget(kept)
        if isinstance(part, (Forces, Quality, LocalWrench, float)):
            self._waiting.append((now_s, sent_s, part))

    def judge(self, now_s: float, sure_s: float = np.inf) -> list[str]:
        """
        Judge all that has waited long enough, and for the parameters; return what is wrong.

        What was sent after ``sure_s`` may be of parameters that nobody has told of yet.

        """
        said: list[str] = []
        self._sure_s = sure_s
        if self._settings.known_s == np.inf and now_s < self._patience_s:
            return said
        while self._waiting and self._is_due(now_s, *self._waiting[0][:2]):
            said += self._judge(*self._waiting.popleft())
        for kept in self._kept.values():
            while len(kept) > 1 and kept[0][0] < now_s - MEMORY_S:  # the newest holds on
                self._forget(kept)
        self._settings.forget(now_s)
        self._qualities.forget(now_s - LOSSES_S)
        self.count.violations += len(said)
        return said

    def _is_due(self, now_s: float, arrived_s: float, sent_s: float) -> bool:
        is_told = self._qualities.heard_after(sent_s) and sent_s <= self._sure_s
        return arrived_s <= now_s - (GRACE_S if is_told else LATE_S)

    def _forget(self, kept: deque[tuple[float, object]]) -> None:
        _, part = kept.popleft()
        if isinstance(part, STAMPED):
            same = self._stamped[type(part), part.stamp]
            times, newest = same[part.content]
            same[part.content] = times - 1, newest
            if times == 1:
                del same[part.content]
            if not same:
                del self._stamped[type(part), part.stamp]
        if isinstance(part, Quality) and part.optimal:
            self._alphas[part.alpha] -= 1
            if not self._alphas[part.alpha]:
                del self._alphas[part.alpha]

    def _judge(self, arrived_s: float, sent_s: float, part: object) -> list[str]:
        if isinstance(part, Quality):
            numbers = (part.alpha, *part.others)
            if not np.isfinite(numbers).all():
                return [f'quality is not finite: {numbers}']
            if not part.optimal and any(numbers):
                return [f'quality is not OPTIMAL and yet holds {numbers}']
            if part.alpha < 0.0:
                return [f'quality: alpha is {part.alpha:.9g}']
        elif isinstance(part, float):
            return self._judge_alpha(arrived_s, sent_s, part)
        elif isinstance(part, Forces):
            return self._judge_forces(arrived_s, sent_s, part) if part.forces else []
        elif isinstance(part, LocalWrench):
            return self._judge_local(arrived_s, sent_s, part)
        return []

    def _judge_alpha(self, arrived_s: float, sent_s: float, alpha: float) -> list[str]:
        if not (np.isfinite(alpha) and alpha >= 0.0):
            return [f'alpha is {alpha:.9g}']
        if alpha == 0.0 or alpha in self._alphas:
            return []
        if arrived_s > sent_s + UNREAD_S:
            return self._leave('parts of its time')
        if self._qualities.may_come(sent_s, NEAR_S) or not any(
                abs(since_s - arrived_s) <= NEAR_S for since_s, _ in self._kept.get(Quality, ())):
            return self._leave('quality')  # not listening to it yet, or on its way, or lost
        return [f'alpha {alpha:.9g} stands in no OPTIMAL quality']

    def _of_stamp(self, kind: type[Part], stamp: int) -> list[Part]:
        """Return those of a stamp that differ, the newest first."""
        same = self._stamped.get((kind, stamp), {})
        return [part for _, part in reversed(same.values()) if isinstance(part, kind)]

    def _doubt(self, arrived_s: float, sent_s: float) -> str:
        """Say what of that time may be missing, if so."""
        return ('parts of its time' if arrived_s > sent_s + UNREAD_S else
                'settings of its time' if sent_s < self._settings.known_s else
                'parameters' if sent_s > self._sure_s else '')

    def _judge_forces(self, arrived_s: float, sent_s: float, part: Forces) -> list[str]:
        if not all(np.isfinite(force.wrench).all() for force in part.forces):
            return [f'forces of stamp {part.stamp} are not finite']
        settings = self._settings.at(sent_s)
        contacts = that_count(settings, self._of_stamp(Contacts, part.stamp))
        qualities = self._of_stamp(Quality, part.stamp)
        in_frame = [c for c in contacts if c.frame in ('', part.frame)]
        doubt = self._doubt(arrived_s, sent_s)
        is_one_unseen = arrived_s > sent_s + UNREAD_S or self._qualities.may_come(sent_s, NEAR_S)
        if qualities and not any(q.optimal for q in qualities) and not is_one_unseen:
            return [f'forces of stamp {part.stamp}: the quality beside them is not OPTIMAL']
        known = [] if doubt else settings
        for name, found in (('parameters', settings), ('contacts', contacts),
                            ('quality', qualities), ('transform', in_frame)):
            if not found:
                return self._leave_forces(name, part, known)
        best: list[str] | None = None
        pairs = [(c, own) for c in in_frame[:MOST_TRIED + 1] for own in settings[:MOST_TRIED + 1]
                 if c.may_be_of(own)]
        tried = itertools.product(pairs, qualities)
        for pair, quality in itertools.islice(tried, MOST_TRIED):
            said = wrong(part, pair[0], quality, pair[1], self._allowance_s)
            if best is None or len(said) < len(best):
                best = said
            if not best:
                break
        if best and next(tried, None):  # one stamp for everything, as when nothing is stamped
            return self._leave_forces('stamp of its own', part, known)
        if best and doubt:
            return self._leave_forces(doubt, part, known)
        if best and is_one_unseen and not all(
                wrong(part, received, None, own, self._allowance_s) for received, own in pairs):
            return self._leave('quality')
        self.count.judged += 1
        return [f'forces of stamp {part.stamp}: {text}' for text in best or ()]

    def _leave(self, missing: str) -> list[str]:
        self.count.unjudged[missing] = self.count.unjudged.get(missing, 0) + 1
        return []

    def _leave_forces(self, missing: str, part: Forces, settings: list[Settings]) -> list[str]:
        self._leave(missing)
        return [f'forces of stamp {part.stamp}, judged without {missing}: {text}'
                for text in wrong_alone(part, settings)]

    def _judge_local(self, arrived_s: float, sent_s: float, part: LocalWrench) -> list[str]:
        topic = f'optimal_wrenches/{part.name}'
        if part.frame != part.name:
            return [f'{topic} of stamp {part.stamp} is in the frame {part.frame!r}']
        if not np.isfinite(part.wrench).all():
            return [f'{topic} of stamp {part.stamp} is not finite: {part.wrench.tolist()}']
        if not part.wrench.any():
            return []
        sets = [forces for forces in self._of_stamp(Forces, part.stamp) if not forces.are_holding]
        settings = self._settings.at(sent_s)
        contacts = that_count(settings, self._of_stamp(Contacts, part.stamp))
        for name, found in (('forces', sets), ('contacts', contacts), ('parameters', settings)):
            if not found:
                return self._leave(name)
        wrenches = np.array([force.wrench for forces in sets[:MOST_TRIED]
                             for force in forces.forces if force.name == part.name])
        tried = itertools.product(contacts, settings)
        if any(is_among(part, wrenches, received, own)
               for received, own in itertools.islice(tried, MOST_TRIED)):
            return []
        if len(sets) > MOST_TRIED or next(tried, None):
            return self._leave('stamp of its own')
        doubt = self._doubt(arrived_s, sent_s)
        return self._leave(doubt) if doubt else [
            f'{topic} of stamp {part.stamp} is not the force beside it']
