# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Make the CMake exports of the ROS message wheels name this machine's include directories.

Each wheel names the Python and NumPy headers of the machine it was built on, which CMake refuses
because they do not exist here.

"""

import pathlib
import re
import sys
import sysconfig

import numpy as np

EXPORTS = 'share/*/cmake/*__rosidl_generator_pyExport.cmake'
INCLUDES = re.compile(r'(INTERFACE_INCLUDE_DIRECTORIES )"/opt/python/[^"]*"')


def main():
    """Rewrite the exports below this interpreter's prefix."""
    here = f'{sysconfig.get_path("include")};{np.get_include()}'
    for path in pathlib.Path(sys.prefix).glob(EXPORTS):
        text = path.read_text()
        path.write_text(INCLUDES.sub(lambda match: f'{match[1]}"{here}"', text))
        print(f'repaired {path}')


if __name__ == '__main__':
    main()
