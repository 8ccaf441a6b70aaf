# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""One question after the other: asked, judged, every so often cross-checked, and counted."""

from collections import Counter
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any
import warnings

from benchmarks.fuzz.asking import Asker
from benchmarks.fuzz.cases import Case, case_of, read, write
from benchmarks.fuzz.crosschecks import crosscheck, Verdict
from benchmarks.fuzz.judging import ANSWERED, CODES, judge, result_of, UNSOLVED
from grasp_quality.node_settings import Settings

EVERYTHING = 16  # one in so many live questions is asked for margin and holding forces too


@dataclass
class Tally:
    """
    What came of many questions.

    Attributes
    ----------
    questions, messages, on_wire, solved : int
        ``solved``: passed the adapters and reached a solver.
    codes, kinds : Counter
        Questions by result code, and by kind.
    checks : Counter
        Cross-checks by Verdict.
    violations : list of (seed, text)

    """

    questions: int = 0
    messages: int = 0
    on_wire: int = 0
    solved: int = 0
    codes: Counter[str] = field(default_factory=Counter)
    kinds: Counter[str] = field(default_factory=Counter)
    checks: Counter[str] = field(default_factory=Counter)
    violations: list[tuple[int, str]] = field(default_factory=list)

    def add(self, other: 'Tally') -> None:
        """Take another tally in."""
        for name in ('questions', 'messages', 'on_wire', 'solved'):
            setattr(self, name, getattr(self, name) + getattr(other, name))
        for name in ('codes', 'kinds', 'checks'):
            getattr(self, name).update(getattr(other, name))
        self.violations += other.violations


@lru_cache(4096)
def _settings(items: tuple[tuple[str, Any], ...]) -> Settings:
    return Settings(**dict(items))


def settings_of(case: Case) -> Settings:
    """Return the node's parameters of a case."""
    return _settings(tuple(sorted(case.settings.items())))


def run(seeds: range, check_every: int, folder: Path | None = None) -> Tally:
    """
    Ask the questions of these seeds.

    Parameters
    ----------
    seeds : range
        Of ``case_of``.
    check_every : int
        One answered question in so many is cross-checked; 0: none.
    folder : Path, optional
        Where questions with a wrong answer are written to.

    """
    tally, asker, answered = Tally(), Asker(), 0
    for seed in seeds:
        case = case_of(seed)
        texts, code = _asked(case, asker, seed % EVERYTHING == 0, tally)
        if code in ANSWERED and not texts:
            answered += 1
            if check_every and answered >= check_every:
                checked = _checked(case, asker, tally)
                texts = checked or []
                answered = answered if checked is None else 0
        if texts:
            tally.violations.append((seed, '; '.join(texts)))
            if folder is not None:
                case.rule = texts[0]
                write(case, folder / f'{case.kind}_{seed}.json')
    return tally


def _asked(case: Case, asker: Asker, everything: bool, tally: Tally) -> tuple[list[str], int]:
    settings = settings_of(case)
    tally.questions += 1
    tally.messages += len(case.messages)
    tally.on_wire += case.on_wire * len(case.messages)
    tally.kinds[case.kind] += 1
    try:
        with warnings.catch_warnings():
            warnings.simplefilter('error', RuntimeWarning)  # as where numbers overflow
            answer = asker.ask(case, settings, everything)
    except Exception as exc:
        return [f'crashed: {type(exc).__name__}: {exc}'], 0
    code = result_of(case, answer).code
    tally.codes[CODES.get(code, str(code))] += 1
    tally.solved += code in (*ANSWERED, *UNSOLVED)
    return judge(case, settings, answer), code


def _checked(case: Case, asker: Asker, tally: Tally) -> list[str] | None:
    settings = settings_of(case)
    found = crosscheck(case, settings, asker.ask(case, settings, False))
    if found is None:
        return None
    verdict, text = found
    tally.checks[verdict.value] += 1
    return [f'cross-check: {text}'] if verdict is Verdict.DIFFERS else []


def replay(path: Path) -> list[str]:
    """Ask a kept question once more, with everything that can be checked; say what is wrong."""
    case, asker, tally = read(path), Asker(), Tally()
    texts, code = _asked(case, asker, True, tally)
    if not texts and code in ANSWERED:
        texts = _checked(case, asker, tally) or []
    return texts
