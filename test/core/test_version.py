# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""One version: package.xml's is what all other places say."""

from pathlib import Path
import re
from xml.etree import ElementTree

import grasp_quality

ROOT = Path(__file__).parents[2]


def test_all_say_the_version_of_package_xml():
    version = ElementTree.parse(ROOT / 'package.xml').findtext('version')
    assert grasp_quality.__version__ == version
    for path in ROOT.glob('*/package.xml'):
        assert ElementTree.parse(path).findtext('version') == version, path
    for path in (ROOT / 'setup.py', ROOT / 'grasp_quality_hand' / 'setup.py'):
        assert re.findall(r"version='(.*)'", path.read_text()) == [version], path
