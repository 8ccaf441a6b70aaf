# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
Command line ``grasp-quality``: grasp files, figures and recorded bags, without ROS.

One command a file, put together in ``main``. What is read from files is in ``grasp_file`` and
``yaml_source``; what is printed in ``answer_rows`` (JSON) and ``answer_table`` (for people).
"""
