#!/usr/bin/env python3
"""Opens a page of `eval --page` in headless Chromium and uses it as a reader does, by clicks and keys.

    page_test.py BUILD_FOLDER [--keep FOLDER]

Needs Debian's chromium, chromium-driver and python3-selenium; leaves with 77 (skipped) without them.
With --keep the screenshots stay in FOLDER.
"""
import argparse
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

try:
    from selenium import webdriver
    from selenium.common.exceptions import StaleElementReferenceException
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    sys.exit(77)
if shutil.which("chromedriver") is None or shutil.which("chromium") is None:
    sys.exit(77)

ROOT = pathlib.Path(__file__).resolve().parents[2]
arguments = argparse.ArgumentParser()
arguments.add_argument("build", type=pathlib.Path)
arguments.add_argument("--keep", type=pathlib.Path)
ARGUMENTS = arguments.parse_args()
FOLDER = pathlib.Path(tempfile.mkdtemp())
PAGE, FROM_LOG = FOLDER / "page.html", FOLDER / "log.html"


def run(*command):
    done = subprocess.run([str(ARGUMENTS.build / "bin/wordgaze"), *map(str, command)], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{command}: {done.stderr}")
    return done.stdout


def setUpModule():
    global browser
    run("eval", "--checkpoint", ROOT / "models/structured.safetensors", "--episodes", 12, "--page", PAGE,
        "--lcm-log", FOLDER / "eval.lcmlog")
    run("page", "--log", FOLDER / "eval.lcmlog", "--out", FROM_LOG)
    options = webdriver.ChromeOptions()
    for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1280,1000",
                 "--force-device-scale-factor=1"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = webdriver.Chrome(options=options)


def tearDownModule():
    browser.quit()
    shutil.rmtree(FOLDER)


def find(selector):
    return browser.find_element(By.CSS_SELECTOR, selector)


def find_all(selector):
    return browser.find_elements(By.CSS_SELECTOR, selector)


def text(selector):
    return find(selector).text


def press(key):
    ActionChains(browser).send_keys(key).perform()


def keep(name):
    if ARGUMENTS.keep:
        ARGUMENTS.keep.mkdir(parents=True, exist_ok=True)
        browser.save_screenshot(str(ARGUMENTS.keep / f"{name}.png"))


class Page(unittest.TestCase):
    def setUp(self):
        browser.set_window_size(1280, 1000)
        browser.get(PAGE.as_uri())

    def tearDown(self):
        errors = [entry for entry in browser.get_log("browser") if entry["level"] == "SEVERE"]
        self.assertEqual(errors, [])

    def test_lists_the_episodes_of_both_policies(self):
        self.assertEqual(len(find_all("#episodes button")), 24)
        self.assertIn("24 episodes", text("#summary"))
        self.assertEqual([o.text for o in find_all("#run option")], ["all runs", "greedy", "sampled"])
        keep("page")

    def test_steps_by_buttons_keys_and_slider(self):
        self.assertTrue(text("#step-text").startswith("step 1 of"))
        find("#next").click()
        self.assertTrue(text("#step-text").startswith("step 2 of"))
        world = find("#world").get_attribute("innerHTML")
        press(Keys.ARROW_RIGHT)
        self.assertTrue(text("#step-text").startswith("step 3 of"))
        self.assertNotEqual(find("#world").get_attribute("innerHTML"), world)
        find("#previous").click()
        press(Keys.ARROW_LEFT)
        self.assertTrue(text("#step-text").startswith("step 1 of"))
        press(Keys.END)
        last, of = text("#step-text").split()[1::2]
        self.assertEqual(last, of)
        press(Keys.HOME)
        self.assertTrue(text("#step-text").startswith("step 1 of"))

    def test_plays_and_pauses(self):
        press(" ")
        self.assertEqual(text("#play"), "Pause")
        browser.implicitly_wait(3)
        for _ in range(40):
            if not text("#step-text").startswith("step 1 of"):
                break
            browser.execute_async_script("setTimeout(arguments[0], 100)")
        self.assertFalse(text("#step-text").startswith("step 1 of"))
        press(" ")
        self.assertEqual(text("#play"), "Play")

    def test_a_word_shows_its_map_and_what_would_be_without_it(self):
        word = find('#words [data-word="2"]')
        name = word.find_element(By.TAG_NAME, "b").text
        ActionChains(browser).move_to_element(find("h1")).perform()
        self.assertEqual(text("#map-name"), "Where it looks (M)")
        word.click()
        self.assertIn(f"“{name}”", text("#map-name"))
        self.assertIn(f"without “{name}”", text("#policy-note"))
        self.assertEqual(len(find_all("#policy .without")), 7)
        keep("word")
        ActionChains(browser).move_to_element(find("h1")).perform()
        self.assertIn(f"“{name}”", text("#map-name"))
        press(Keys.ESCAPE)
        self.assertEqual(text("#map-name"), "Where it looks (M)")

    def test_a_word_is_hovered(self):
        ActionChains(browser).move_to_element(find('#words [data-word="1"]')).perform()
        self.assertIn("“", text("#map-name"))
        ActionChains(browser).move_to_element(find("h1")).perform()
        self.assertEqual(text("#map-name"), "Where it looks (M)")

    def test_a_cell_says_which_words_look_there(self):
        # A cell with something that the agent would miss.
        for _ in range(30):
            what = browser.execute_script(
                "const s = document.querySelectorAll('#map .cell title');"
                "return Array.from(s).findIndex((t) => parseFloat(t.textContent.split(': ')[1]) > .5)")
            if what >= 0:
                break
            press(Keys.ARROW_RIGHT)
        self.assertGreaterEqual(what, 0, "no step at which M is bright on a cell")
        find(f'#map [data-cell="{what}"]').click()
        ActionChains(browser).move_to_element(find("h1")).perform()
        self.assertGreaterEqual(len(find_all("#words .here")), 1)
        self.assertIn("without the", text("#policy-note"))
        keep("cell")

    def test_the_filter_can_be_seen(self):
        find('#choices [data-filter="true"]').click()
        self.assertEqual(text("#map-name"), "What reaches the memory, s(M)")

    def test_filters_the_list(self):
        find("#run").send_keys("greedy")
        self.assertEqual(len(find_all("#episodes button")), 12)
        find("#outcome").send_keys("failures")
        shown = find_all("#episodes button")
        self.assertEqual(len(shown), len([b for b in shown if "failure" in b.get_attribute("class")]))
        find("#outcome").send_keys("all episodes")
        find("#join").send_keys("“and”")
        for button in find_all("#episodes button"):
            self.assertIn("and", button.text.split("\n")[0].split())
        find("#order").send_keys("longest")
        lengths = [int(b.text.split()[-2]) for b in find_all("#episodes button")]
        self.assertEqual(lengths, sorted(lengths, reverse=True))

    def test_goes_to_the_next_episode_by_key_and_click(self):
        before = text("#facts")
        press("n")
        self.assertNotEqual(text("#facts"), before)
        press("p")
        self.assertEqual(text("#facts"), before)
        find_all("#episodes button")[5].click()
        self.assertEqual(find_all("#episodes button")[5].get_attribute("aria-current"), "true")

    def test_everything_to_use_has_a_name(self):
        for element in find_all("button, select, input, svg[role=img]"):
            if not element.is_displayed():
                continue
            name = element.get_attribute("aria-label") or element.text or element.accessible_name
            self.assertTrue(name.strip(), element.get_attribute("outerHTML")[:200])
        self.assertEqual(find("#said").get_attribute("aria-live"), "polite")
        self.assertIn("Step 0", text("#said"))

    def test_fits_a_phone(self):
        browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                {"width": 390, "height": 844, "deviceScaleFactor": 2, "mobile": True})
        browser.get(PAGE.as_uri())
        width = browser.execute_script("return document.documentElement.scrollWidth")
        self.assertLessEqual(width, 390)
        keep("phone")
        browser.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})

    def test_a_log_is_shown_too(self):
        browser.get(FROM_LOG.as_uri())
        self.assertEqual(len(find_all("#episodes button")), 24)
        self.assertIn("eval-1-sampled", [o.text for o in find_all("#run option")])
        self.assertEqual(find_all("#choices button"), [])  # a log does not hold s(M)
        self.assertIn("Lighter", text("#world-note"))
        keep("log")


class Program:
    """A command that shows a live page, until it is told to end."""

    def __init__(self, *command):
        self.process = subprocess.Popen([str(ARGUMENTS.build / "bin/wordgaze"), *map(str, command), "--watch-port", "0"],
                                        stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
        for line in self.process.stderr:
            if line.startswith("open "):
                self.url = line.split()[1]
                return
        raise RuntimeError(f"{command}: ended without a page")

    def __enter__(self):
        browser.get(self.url)
        return self

    def __exit__(self, *_):
        browser.get("about:blank")
        self.process.send_signal(signal.SIGINT)
        self.process.wait(20)
        self.process.stderr.close()


def wait_for(what, seconds=15):
    """Until `what` is so; elements come and go meanwhile."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        try:
            if what():
                return True
        except StaleElementReferenceException:
            pass
        time.sleep(.05)
    return False


class Live(unittest.TestCase):
    CHECKPOINT = ROOT / "models/single-attention.safetensors"

    def test_an_evaluation_is_watched(self):
        with Program("eval", "--checkpoint", self.CHECKPOINT, "--episodes", 3, "--greedy", "--watch", "--hz", 20):
            self.assertTrue(wait_for(lambda: len(find_all("#episodes .success")) == 3))
            self.assertTrue(wait_for(lambda: text("#note") == "The evaluation is over."))
            self.assertFalse(find("#commands").is_displayed())
            press(Keys.HOME)
            self.assertTrue(text("#step-text").startswith("step 1 of"))

    def test_training_is_watched(self):
        with Program("train", "--config", ROOT / "configs/single.toml", "--out", FOLDER / "run", "--frames", 120000,
                     "--set", "log_episodes=1", "--watch"):
            self.assertTrue(wait_for(lambda: "success_rate" in text("#learning")))
            self.assertTrue(wait_for(lambda: len(find_all("#episodes button")) >= 2))
            keep("training")

    def test_a_person_and_the_agent_play(self):
        with Program("play", "--checkpoint", self.CHECKPOINT, "--hz", 20):
            self.assertTrue(wait_for(lambda: text("#step-text") == "step 1 of 1"))
            self.assertIn("Would do", text("#policy-note"))
            find('[data-action="turn left"]').click()
            self.assertTrue(wait_for(lambda: text("#step-text") == "step 2 of 2"))
            press(Keys.ARROW_RIGHT)
            self.assertTrue(wait_for(lambda: text("#step-text") == "step 3 of 3"))
            find("#mission").send_keys("go to the moon" + Keys.ENTER)
            self.assertTrue(wait_for(lambda: "moon" in text("#note")))
            find("#mission").clear()
            find("#mission").send_keys("go to a ball" + Keys.ENTER)
            self.assertTrue(wait_for(lambda: "go to the ball" in text("#episodes")), text("#note"))
            find("#next-world").click()
            count = len(find_all("#episodes button"))
            find("#agent-on").click()
            self.assertTrue(wait_for(lambda: find_all("#episodes .success")), text("#episodes"))
            self.assertGreaterEqual(len(find_all("#episodes button")), count)
            keep("play")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=1)
