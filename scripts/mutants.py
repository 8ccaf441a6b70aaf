# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Mutation tests: whether the tests notice when a line of the code is changed (docs/reliability.md).

mutmut changes one operator, number, string, argument or assignment after the other in a copy of
the code in build/mutants/ and runs the tests that pass through it. mutmut leaves decorated
functions out, so that the copy has its properties spelt as plain functions first.

"""

import argparse
import ast
import os
from pathlib import Path
import shutil
import subprocess
import sys

Result = tuple[str, Path, str]  # name, file, outcome of a mutant
ROOT = Path(__file__).resolve().parents[1]
BUILD = ROOT / 'build' / 'mutants'
TOOL, WORK = BUILD / 'tool', BUILD / 'work'
PINS = ROOT / 'requirements' / 'mutants' / 'tool.txt'
GOAL = 85.0  # percent of the mutants of each module
MODULES = ('grasp_quality/friction_cone.py', 'grasp_quality/bounds.py',
           'grasp_quality/problem.py', 'msg_adapters/')
TESTS = ('test/adapters', *(f'test/core/test_{name}.py' for name in (
    'bounds', 'edges', 'friction_cone', 'joint_limits', 'known_answers', 'layout', 'problem',
    'solve')))
COPIED = ('benchmarks', 'config', 'grasp_quality', 'grasp_quality_cli', 'msg_adapters', 'test',
          'setup.cfg')
CONFIG = f"""
[tool.mutmut]
source_paths = ['grasp_quality', 'msg_adapters']
only_mutate = {[m + '*' if m.endswith('/') else m for m in MODULES]}
also_copy = ['benchmarks', 'config', 'grasp_quality_cli']
pytest_add_cli_args = ['-p', 'no:cacheprovider', '--hypothesis-seed=0']
pytest_add_cli_args_test_selection = {list(TESTS)}
use_setproctitle = false
use_git_change_detection = false
"""


def main() -> None:
    """Run the mutants, or those that survived the last run, and print what is left."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--survivors', action='store_true',
                        help='only what survived the last run, with the tests of today')
    parser.add_argument('--report', action='store_true', help='only print the last run')
    asked = parser.parse_args()
    install()
    if not asked.report:
        names = [name for name, _, _ in survivors()] if asked.survivors else []
        prepare(anew=not asked.survivors)
        code = 'from mutmut.__main__ import cli; cli()'
        subprocess.run([sys.executable, '-c', code, 'run', '--max-children', '1', *names],
                       cwd=WORK, env=environment(), check=True)
    sys.exit(report())


def install() -> None:
    """Bring mutmut, pinned, to where it changes nothing else."""
    stamp = TOOL / 'stamp'
    if not stamp.exists() or stamp.read_text() != PINS.read_text():
        shutil.rmtree(TOOL, ignore_errors=True)
        subprocess.run([sys.executable, '-m', 'pip', 'install', '--quiet', '--no-deps',
                        '--disable-pip-version-check', '--target', str(TOOL), '-r', str(PINS)],
                       check=True)
        stamp.write_text(PINS.read_text())
    sys.path.append(str(TOOL))


def environment() -> dict[str, str]:
    """Let the copy of the code see mutmut; nothing that another run has left."""
    paths = [os.environ.get('PYTHONPATH', ''), str(TOOL)]
    return {**os.environ, 'PYTHONPATH': os.pathsep.join(filter(None, paths))}


def prepare(anew: bool) -> None:
    """Copy code and tests; of an old run keep the mutants and renew the tests alone."""
    if anew:
        shutil.rmtree(WORK, ignore_errors=True)
    elif not WORK.exists():
        sys.exit('no run to go on from: leave out --survivors')
    for name in COPIED if anew else ('test',):
        source = ROOT / name
        if source.is_file():
            shutil.copy2(source, WORK / name)
        else:
            shutil.copytree(source, WORK / name, dirs_exist_ok=True)
    if anew:
        (WORK / 'pyproject.toml').write_text(CONFIG)
        for path in WORK.glob('*/*.py'):
            if is_mutated(path.relative_to(WORK).as_posix()):
                path.write_text(without_decorators(path.read_text()))


def is_mutated(name: str) -> bool:
    """Tell whether a file, by its path in the repository, is one of the modules."""
    return name.startswith(MODULES)


def without_decorators(source: str) -> str:
    """Spell `@property def x(self): ...` as `def x(self): ...; x = property(x)`."""
    lines = source.splitlines()
    functions = [node for parent in ast.parse(source).body if isinstance(parent, ast.ClassDef)
                 for node in parent.body if isinstance(node, ast.FunctionDef)]
    for node in reversed(functions):
        for decorator in node.decorator_list:
            name = ast.unparse(decorator)
            lines.insert(int(node.end_lineno or 0), f'    {node.name} = {name}({node.name})')
            lines[decorator.lineno - 1] = ''
    return '\n'.join(lines) + '\n'


def results() -> list[Result]:
    """List every mutant of the last run."""
    if not WORK.exists():
        sys.exit('there is no run to report: leave out --report')
    os.chdir(WORK)
    from mutmut.mutation.data import SourceFileMutationData  # type: ignore[import-not-found]
    from mutmut.stats import status_by_exit_code  # type: ignore[import-not-found]
    from mutmut.utils.file_utils import walk_mutatable_files  # type: ignore[import-not-found]
    found: list[Result] = []
    for path in sorted(walk_mutatable_files()):
        data = SourceFileMutationData(path=path)
        data.load()
        found += [(name, path, status_by_exit_code[code])
                  for name, code in data.exit_code_by_key.items()]
    return found


def survivors() -> list[Result]:
    """List what no test has killed; a mutant that runs for ever is as good as dead."""
    return [r for r in results() if r[2] not in ('killed', 'timeout', 'segfault')]


def report() -> int:
    """Print a table, write the survivors as differences, return the exit code."""
    everything, left = results(), survivors()
    from mutmut.mutation.diff_apply import get_diff_for_mutant  # type: ignore[import-not-found]
    with (BUILD / 'survivors.txt').open('w') as file:
        for name, path, outcome in left:
            file.write(f'# {name}: {outcome}\n{get_diff_for_mutant(name, path=path)}\n')
    print(f'{"module":32} mutants  killed  survived  share killed')
    code = 0
    for module in MODULES:
        total = sum(path.as_posix().startswith(module) for _, path, _ in everything)
        alive = sum(path.as_posix().startswith(module) for _, path, _ in left)
        share = 100.0 * (total - alive) / total
        print(f'{module:32} {total:7} {total - alive:7} {alive:9}  {share:.1f} %')
        code |= share < GOAL
    print(f'survivors: {BUILD / "survivors.txt"}')
    return int(code)


if __name__ == '__main__':
    main()
