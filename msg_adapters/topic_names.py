# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""Which contact names can name a topic."""

import re

TOPIC_RULE = ('names must be letters, digits and single underscores, begin with a letter, and '
              'have at most 64 characters')
TOPIC_NAME = re.compile('[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*_?')


def names_a_topic(name: str) -> bool:
    """Tell whether a contact's name can stand in a topic."""
    return len(name) <= 64 and TOPIC_NAME.fullmatch(name) is not None
