# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""The viewer's process and its page, as tests and benchmarks look at them."""

import io
from pathlib import Path
import re
import time

from ament_index_python.packages import get_package_prefix
from harness import Process
import numpy as np
from PIL import Image
from selenium import webdriver
from selenium.common.exceptions import TimeoutException
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

FLAGS = ('--headless=new', '--no-sandbox', '--disable-quic', '--no-first-run',
         '--disable-background-networking', '--disable-component-update', '--disable-sync',
         '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader')
SHARPNESS = 0.5   # pixels drawn for each of the screen: a quarter of the work without a card
HZ = 1.0          # of that screen, where what is drawn matters and not how often
SCRIPT_S = 120.0  # that one look at the page may take where it is drawn without a graphics card
SLOW_SCREEN = f"""
window.requestAnimationFrame = draw => setTimeout(() => draw(performance.now()), {1000.0 / HZ});
window.cancelAnimationFrame = clearTimeout;"""
PORTS = range(18080, 18980)


def open_browser(chromium, driver, profile, size='900,640', slow_screen=False):
    """Start a headless Chromium that draws in software: all the time, or HZ times a second."""
    options = webdriver.ChromeOptions()
    options.binary_location = chromium
    for flag in (*FLAGS, f'--window-size={size}', f'--user-data-dir={profile}'):
        options.add_argument(flag)
    browser = webdriver.Chrome(options=options, service=Service(driver))
    if slow_screen:
        browser.execute_cdp_cmd(
            'Page.addScriptToEvaluateOnNewDocument', {'source': SLOW_SCREEN})
    browser.set_page_load_timeout(SCRIPT_S)
    browser.set_script_timeout(SCRIPT_S)
    browser.command_executor.client_config.timeout = 2.0 * SCRIPT_S
    return browser


def start_viewer(log, **parameters):
    """Start the viewer; return its process and the address that it tells."""
    prefix = Path(get_package_prefix('grasp_quality_hand'))
    command = [prefix / 'lib' / 'grasp_quality_hand' / 'viewer', '--ros-args',
               '-p', 'controls:=true', '-p', f'port:={PORTS[hash(str(log)) % len(PORTS)]}']
    for name, value in parameters.items():
        command += ['-p', f'{name}:={value}']
    process = Process(command, log)
    process.until_it_says(' in a browser')
    return process, re.search(r'open (http://\S+) in', process.log())[1]


class Page:
    """What a reader of the page sees and does."""

    def __init__(self, browser, address):
        self.browser = browser
        browser.get(f'{address}/?fixedDpr={SHARPNESS}')

    def text(self, name):
        """Return the text of one of the page's readings, which are replaced at every update."""
        return self.browser.execute_script(
            f'const e = document.getElementById("{name}"); return e ? e.innerText : ""')

    def kind(self):
        """Return answer, failure or stale."""
        return self._attribute('data-kind')

    def updates(self):
        """Return the count of the newest update on the page."""
        return int(self._attribute('data-count') or -1)

    def _attribute(self, name):
        return self.browser.execute_script(
            'const e = document.getElementById("gq-status"); '
            f'return e && e.getAttribute("{name}")')

    def alpha(self):
        """Return the alpha that the page shows, or None."""
        match = re.search(r'alpha (\d+\.\d+)', self.text('gq-status'))
        return float(match[1]) if match else None

    def slider(self, label):
        """Return the thumb of a slider."""
        return self.browser.find_element(
            By.XPATH, f'//body//label[contains(., "{label} [")]/following::*[@role="slider"][1]')

    def look_away(self):
        """Let the page believe that another window is in front."""
        self.browser.execute_script(
            'document.hasFocus = () => false; window.dispatchEvent(new Event("blur"))')

    def look_back(self):
        """Bring the page to the front again."""
        self.browser.execute_script(
            'delete document.hasFocus; window.dispatchEvent(new Event("focus"))')

    def push(self, label, key, count):
        """Press an arrow key on a slider."""
        self.slider(label).send_keys(*[key] * count)

    def canvas(self):
        """Return the pixels of the scene, height x width x 3; None when a busy machine is late."""
        try:
            png = self.browser.find_element(By.TAG_NAME, 'canvas').screenshot_as_png
        except TimeoutException:
            return None
        return np.asarray(Image.open(io.BytesIO(png)).convert('RGB')).astype(int)


def until(condition, what, deadline_s=SCRIPT_S):
    """Wait for a condition to give something true, and return it."""
    deadline = time.monotonic() + deadline_s
    while not (result := condition()):
        assert time.monotonic() < deadline, f'waited {deadline_s} s for {what}'
    return result


LEFT, RIGHT = Keys.ARROW_LEFT, Keys.ARROW_RIGHT
