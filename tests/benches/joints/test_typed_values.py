"""The values of the joints as a person types them, beside the sliders."""

import re

from armlab.content.robots import catalogue
from support.student import run, settled, student

PUMA = catalogue()["puma560"]


def shown(browser, joint):
    """Return the value in the field of a joint, 1-based."""
    return re.search(rf'value="([^"]*)"[^>]*data-cell="value {joint}"', browser.html())[1]


def test_two_typed_values_are_two_steps_of_undo(url):
    async def main():
        browser = await student(url)
        home = shown(browser, 1), shown(browser, 2)
        await browser.press("value 1", "30")
        await browser.press("value 2", "50")
        await browser.until(lambda: (shown(browser, 1), shown(browser, 2)) == ("30.0", "50.0"))
        await browser.press("undo")
        await browser.until(lambda: (shown(browser, 1), shown(browser, 2)) == ("30.0", home[1]))
        await browser.press("undo")
        await browser.until(lambda: (shown(browser, 1), shown(browser, 2)) == home)
        await browser.close()

    run(main())


def test_a_value_cut_to_its_limit_says_so_at_the_field_until_the_joint_leaves_it(url):
    async def main():
        browser = await student(url)
        await browser.press("value 2", "999")
        said = "999.0° exceeds the limit of joint 2: set to 225.0°"
        await browser.until(lambda: said in browser.html())
        assert shown(browser, 2) == "225.0"
        await browser.press("value 2", "-100")
        await browser.until(lambda: "−100.0° exceeds the limit of joint 2: set to −45.0°" in browser.html())
        assert said not in browser.html()
        await browser.press("value 2", "225.04")
        await browser.until(lambda: shown(browser, 2) == "225.0")
        await browser.until(lambda: "exceeds the limit" not in browser.html())
        await browser.press("value 2", "300")
        await browser.until(lambda: "300.0° exceeds the limit" in browser.html())
        await browser.set_value(browser.slider(2), 10.0)
        await browser.until(lambda: "exceeds the limit" not in browser.html())
        await browser.set_value(browser.slider(2), 225.0)
        await settled(browser)
        assert "exceeds the limit" not in browser.html()
        await browser.close()

    run(main())


def test_units_and_formulas_are_read_and_nonsense_is_refused_at_the_field(url):
    async def main():
        browser = await student(url)
        await browser.press("value 1", "pi/2")
        await browser.until(lambda: shown(browser, 1) == "90.0")
        await browser.press("value 1", "a lot")
        await browser.until(lambda: "joint 1: expected a number in degrees, got &#39;a lot&#39;" in browser.html())
        await browser.close()

    run(main())


def test_a_held_joint_takes_no_typed_value(url):
    async def main():
        browser = await student(url)
        await browser.press("0")
        await browser.until(lambda: re.search(r'data-cell="value 1"[^>]*disabled', browser.html()))
        before = shown(browser, 1)
        await browser.press("value 1", "77")
        await settled(browser)
        assert shown(browser, 1) == before
        await browser.close()

    run(main())
