# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The program ``grasp-quality``: its commands, and errors as one line and an exit code."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Annotated

from grasp_quality import __version__, GraspQualityError, SolverError
from grasp_quality_cli.bag import evaluate_bag
from grasp_quality_cli.evaluate import evaluate_grasp
from grasp_quality_cli.figures import paper_figures
from grasp_quality_cli.map import map_grasp
from grasp_quality_cli.output import EPILOG, NOT_SOLVED, STOPPED, WRONG_INPUT
from grasp_quality_cli.study import study
from grasp_quality_cli.study_error import StoppedError
import typer

HELP = """
How large a task wrench can a grasp apply, and with which contact forces?

Grasps stand in YAML files (docs/grasp_files.md). To begin:

grasp-quality evaluate examples/pinch.yaml --task "0 0 2 0 0 0"
"""

app = typer.Typer(
    name='grasp-quality', no_args_is_help=True, pretty_exceptions_enable=False,
    add_completion=False, help=HELP, epilog=EPILOG,
    context_settings={'help_option_names': ['-h', '--help']})
app.command('evaluate', epilog=EPILOG)(evaluate_grasp)
app.command('map', epilog=EPILOG)(map_grasp)
app.command('bag', epilog=EPILOG)(evaluate_bag)
app.command('figures', epilog=EPILOG)(paper_figures)
app.command('study', epilog=EPILOG)(study)


def _tell_version(wanted: bool) -> None:
    if wanted:
        print(f'grasp-quality {__version__}')
        raise typer.Exit


@app.callback()
def options(
        version: Annotated[bool, typer.Option(
            '--version', callback=_tell_version, is_eager=True,
            help='Tell the version and end.')] = False) -> None:
    """Take the options before the command; that there is this makes all commands named."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program; return its exit code."""
    try:
        app(args=arguments)
    except SystemExit as exc:  # how Typer ends
        return exc.code if isinstance(exc.code, int) else int(exc.code is not None)
    except SolverError as exc:
        return _failed(exc, NOT_SOLVED)
    except StoppedError as exc:
        return _failed(exc, STOPPED)
    except (GraspQualityError, OSError) as exc:
        return _failed(exc, WRONG_INPUT)
    return 0


def _failed(exc: Exception, code: int) -> int:
    print(f'error: {exc}', file=sys.stderr)
    return code


if __name__ == '__main__':
    sys.exit(main())
