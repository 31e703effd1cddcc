#!/usr/bin/python3
"""The page in a real browser: Chromium without a window, by chromedriver, in three sizes, light and dark. It shows each
system, fits its window, and its buttons and sliders command the twin.

usage: in_private_network browser_test.py TWIN [FOLDER]

FOLDER: the screenshots are kept there. Exit status 77, of a test that is skipped, without chromium, chromedriver or
python3-selenium (scripts/setup --browser).
"""
import itertools
import os
import shutil
import sys
import time
import unittest
import urllib.parse

from foxglove_client import Client
from serve_test import Server

try:
    from selenium import webdriver
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    webdriver = None

PATIENCE = 60.0  # s
PROGRAMS = [shutil.which(name) for name in ('chromium', 'chromedriver')]
FOLDER = sys.argv[2] if len(sys.argv) > 2 else None
SIZES = {'phone': (390, 844), 'tablet': (820, 1180), 'desktop': (1600, 1000)}
SCHEMES = ('light', 'dark')
SCENES = ('demo', 'compressor', 'double_pendulum', 'swing_up', 'levitation')
# A canvas is blank where all of its pixels are the same.
COLOURS = '''return [...document.querySelectorAll("canvas")].map(canvas => {
  const pixels = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer);
  return new Set(pixels).size;
});'''


def chromium():
    options = webdriver.ChromeOptions()
    options.binary_location = PROGRAMS[0]
    for argument in ('--headless=new', '--no-sandbox', '--disable-gpu', '--disable-dev-shm-usage', '--hide-scrollbars',
                     '--no-first-run', '--disable-background-networking', '--disable-component-update'):
        options.add_argument(argument)
    options.set_capability('goog:loggingPrefs', {'browser': 'ALL'})
    return webdriver.Chrome(service=webdriver.ChromeService(PROGRAMS[1]) if hasattr(webdriver, 'ChromeService') else
                            webdriver.chrome.service.Service(PROGRAMS[1]), options=options)


class Browser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.driver = chromium()

    @classmethod
    def tearDownClass(cls):
        cls.driver.quit()

    def wait(self, condition, why):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if condition():
                return
            time.sleep(0.05)
        self.fail(f'{why}: {self.driver.find_element(By.TAG_NAME, "body").text[:500]}')

    def one(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def show(self, size, scheme):
        width, height = SIZES[size]
        self.driver.execute_cdp_cmd('Emulation.setDeviceMetricsOverride', {
            'width': width, 'height': height, 'deviceScaleFactor': 2 if size == 'phone' else 1, 'mobile': size == 'phone'})
        self.driver.execute_cdp_cmd('Emulation.setEmulatedMedia',
                                    {'features': [{'name': 'prefers-color-scheme', 'value': scheme}]})

    def open(self, server):
        self.driver.get(server.url)
        self.wait(lambda: self.one('#systems').text, 'no system is shown')

    def blank(self):
        """Whether a canvas shows nothing but its background."""
        return any(count < 3 for count in self.driver.execute_script(COLOURS))

    def errors(self, port):
        """Of the page on this port: that of an earlier server may still have tried to connect again."""
        return [entry['message'] for entry in self.driver.get_log('browser')
                if entry['level'] == 'SEVERE' and ':%d/' % port in entry['message']]

    def test_pages(self):
        for scene in SCENES:
            with self.subTest(scene), Server(scene=scene) as server:
                self.open(server)
                for size, scheme in itertools.product(SIZES, SCHEMES):
                    self.show(size, scheme)
                    for canvas in self.driver.find_elements(By.CSS_SELECTOR, 'canvas'):  # those out of sight are not drawn
                        self.driver.execute_script('arguments[0].scrollIntoView({block: "center"})', canvas)
                        self.wait(lambda shown=canvas: self.driver.execute_script(
                            'const b = arguments[0].getBoundingClientRect(); return b.width > 100 && b.right <= innerWidth', shown),
                            f'{scene}, {size}: a canvas does not fit')
                        time.sleep(0.15)
                    self.assertFalse(self.blank(), (scene, size, scheme))
                    self.assertLessEqual(self.driver.execute_script('return document.documentElement.scrollWidth'),
                                         SIZES[size][0], f'{scene}, {size}: wider than its window')
                    self.driver.execute_script('scrollTo(0, 0)')
                    if FOLDER:
                        time.sleep(1.0)
                        self.driver.save_screenshot(os.path.join(FOLDER, f'{scene}_{size}_{scheme}.png'))
                self.assertEqual(self.errors(urllib.parse.urlsplit(server.url).port), [])

    def test_it_moves_and_pauses(self):
        with Server() as server:
            self.open(server)
            before = self.one('#time').text
            self.wait(lambda: self.one('#time').text != before, 'time does not go')
            self.one('#pause').click()
            self.wait(lambda: self.one('#state').text == 'paused' and self.one('#pause').text == 'Resume', 'no pause')
            before = self.one('canvas.sketch').get_attribute('aria-label')
            self.one('#step').click()
            self.wait(lambda: self.one('canvas.sketch').get_attribute('aria-label') != before, 'no step')
            self.one('#pause').click()
            self.wait(lambda: self.one('#state').text == 'running', 'no resume')

    def test_a_slider_changes_the_twin(self):
        with Server() as server, server.client() as client:
            client.subscribe('rotor/parameters')
            self.open(server)
            client.of('rotor/parameters')
            for summary in self.driver.find_elements(By.CSS_SELECTOR, 'summary'):
                summary.click()
            label = self.driver.find_element(By.XPATH, '//label[text()="mass"]')
            row = label.find_element(By.XPATH, '..')
            row.find_element(By.CSS_SELECTOR, 'input[type=range]').send_keys(Keys.ARROW_RIGHT)
            changed = client.of('rotor/parameters', lambda content: content['changed'] == ['mass'])
            mass = changed['values'][changed['names'].index('mass')]
            self.assertGreater(mass, 2.0)
            number = row.find_element(By.CSS_SELECTOR, 'input[type=number]')
            number.send_keys(Keys.CONTROL, 'a')
            number.send_keys('-1', Keys.TAB)
            self.wait(lambda: 'mass' in self.one('#message').text and 'found -1' in self.one('#message').text, 'no error')
            self.wait(lambda: abs(float(number.get_attribute('value')) - mass) < 1e-5 * mass, 'not the value of the twin')

    def test_an_alarm_is_acknowledged(self):
        with Server('--real-time-factor', '3') as server:
            self.open(server)
            self.wait(lambda: self.driver.find_elements(By.XPATH, '//li//button[text()="Acknowledge"]'), 'no alarm')
            self.one('#pause').click()
            self.wait(lambda: self.one('#state').text == 'paused', 'no pause')
            while buttons := self.driver.find_elements(By.XPATH, '//li//button[text()="Acknowledge"]'):
                count = len(buttons)
                buttons[0].click()
                self.wait(lambda before=count: len(self.driver.find_elements(
                    By.XPATH, '//li//button[text()="Acknowledge"]')) < before, 'not acknowledged')
            self.wait(lambda: self.driver.find_elements(By.CSS_SELECTOR, '#alarm-list .acknowledged'), 'none acknowledged')
            server.stop()
            self.wait(lambda: self.one('#state').text == 'disconnected', 'the end is not shown')
            self.assertIn('UNKNOWN', self.one('#alarm-list').text)

    def test_texts_are_not_markup(self):
        """What a server sends is text, whatever it is."""
        with Server('--paused') as server:
            self.open(server)
            shown = self.driver.execute_script('''
                const bad = "<img src=x onerror=window.broken=1>";
                const done = arguments[arguments.length - 1];
                const real = JSON.parse;
                JSON.parse = text => real(text, (key, value) =>
                    ["text", "summary", "meaning", "path", "silence", "model"].includes(key) ? bad : value);''')
            self.assertIsNone(shown)
            with Client(server.port) as client:
                client.greeting()
                client.call('set_real_time_factor', {'factor': 0})
                client.call('resume')
                self.wait(lambda: '<img' in self.one('#alarm-list').text, 'the text is not shown')
            self.assertEqual(self.driver.find_elements(By.TAG_NAME, 'img'), [])
            self.assertIsNone(self.driver.execute_script('return window.broken'))


if __name__ == '__main__':
    if not webdriver or not all(PROGRAMS):
        print('skipped: chromium, chromedriver or python3-selenium is not installed: scripts/setup --browser')
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
