# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Who scores the chunks: processes on this machine, or a Dask cluster; both as futures executors.

A chunk is handed out only when fewer than ``window`` others are on their way, so that memory does
not grow with the dataset. Dask repeats what a lost worker had; processes here end with their
parent, however it ends.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import (
    CancelledError, Executor, FIRST_COMPLETED, Future, ProcessPoolExecutor, ThreadPoolExecutor,
    wait)
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
import ctypes
import logging
import multiprocessing
import os
import signal
from typing import Any, TypeVar

from grasp_quality_cli.study_error import StoppedError, StudyError

Job = TypeVar('Job')
PR_SET_PDEATHSIG = 1  # linux/prctl.h
AHEAD = 2             # chunks on their way for each worker
RETRIES = 3           # of a chunk whose Dask worker was lost
CONNECT_S = 20        # to find the scheduler, and then a worker


@contextmanager
def local_workers(count: int) -> Iterator[tuple[Executor, int]]:
    """Yield an executor on this machine, and its window; one worker is a thread in here."""
    pool: Executor
    if count == 1:
        pool = ThreadPoolExecutor(1)
    else:  # spawned, not forked: this process may have threads
        pool = ProcessPoolExecutor(
            count, multiprocessing.get_context('spawn'), initializer=_end_with_parent,
            initargs=(os.getpid(),))
    try:
        yield pool, AHEAD * count
    except BrokenProcessPool as exc:
        raise StoppedError('a worker process was killed (if it was for memory, give fewer '
                           '--workers or a smaller --chunk-rows)') from exc
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _end_with_parent(parent: int) -> None:
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:  # it ended before the line above took hold
        os._exit(1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # the parent decides


@contextmanager
def dask_workers(scheduler: str) -> Iterator[tuple[Executor, int]]:
    """Yield an executor on a Dask cluster, and its window; ``scheduler`` as in tcp://host:8786."""
    try:
        from distributed import Client
    except ImportError as exc:
        raise StudyError('--scheduler needs Dask: pip install distributed') from exc
    # its loss is told below, once and without tracebacks
    for name in ('distributed.client', 'tornado.application'):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    try:
        client: Any = Client(
            scheduler, timeout=CONNECT_S, set_as_default=False)
    except (OSError, ValueError, TimeoutError) as exc:
        raise StudyError(f'no Dask scheduler answers at {scheduler}: {exc}') from exc
    try:
        try:
            client.wait_for_workers(1, timeout=CONNECT_S)
        except TimeoutError as exc:
            raise StudyError(f'the scheduler at {scheduler} has no workers: start some with '
                             f'dask worker {scheduler}') from exc
        threads = sum(client.nthreads().values())
        yield client.get_executor(retries=RETRIES, pure=False), AHEAD * threads
    except (CancelledError, ImportError) as exc:
        raise _of_dask(exc, scheduler) from exc
    except Exception as exc:
        if type(exc).__module__.partition('.')[0] == 'distributed':  # no common base
            raise _of_dask(exc, scheduler) from exc
        raise
    finally:
        client.close(timeout=CONNECT_S)


def _of_dask(exc: BaseException, scheduler: str) -> StudyError:
    if isinstance(exc, ImportError):
        return StudyError(f'the Dask workers need the same grasp_quality installed: {exc}')
    why = f'{type(exc).__name__}: {exc}'.rstrip(': ')
    return StoppedError(f'the Dask cluster at {scheduler} was lost ({why})')


def work_off(jobs: Iterable[Job], submit: Callable[[Job], Future[Any]], window: int,
             done: Callable[[Job, Any], None]) -> None:
    """
    Run jobs, never more than ``window`` at once, and hand each result on as it comes.

    Parameters
    ----------
    jobs : iterable
        Taken one by one, as there is room.
    submit : callable
        Starts a job and returns its Future.
    window : int
        At least 1.
    done : callable
        Gets each job with its result, in the order of their ends.

    """
    pending: dict[Future[Any], Job] = {}

    def settle() -> None:
        for future in wait(pending, return_when=FIRST_COMPLETED).done:
            done(pending.pop(future), future.result())

    for job in jobs:
        pending[submit(job)] = job
        while len(pending) >= window:
            settle()
    while pending:
        settle()
