#!/usr/bin/env bash
# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0

# A browser for the tests of the viewer's page: Chromium and its driver, where they are missing.

has_browser() {
    { command -v chromium || command -v chromium-browser || command -v google-chrome; } &&
        command -v chromedriver
}

has_browser >/dev/null && exit 0
if [ "$(id -u)" -eq 0 ] && command -v apt-get >/dev/null; then
    apt-get update -q &&
        DEBIAN_FRONTEND=noninteractive apt-get install -yq --no-install-recommends \
            chromium chromium-driver
fi >/dev/null
has_browser >/dev/null && exit 0
echo 'error: no Chromium with ChromeDriver, which the page is tested in; on Debian:' \
    'sudo apt install chromium chromium-driver' >&2
exit 1
