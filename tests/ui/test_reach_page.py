"""The page Target: what counts of it is chosen there, and its fields and verdict say so."""

import html

from support.student import run, student


def test_less_than_the_whole_pose_is_asked_for_and_the_fields_and_the_verdict_follow(url):
    async def main():
        browser = await student(url)
        await browser.open("target")
        await browser.until(lambda: 'data-cell="roll"' in browser.html())
        await browser.press("asks position")
        await browser.until(lambda: 'data-cell="roll"' not in browser.html())
        assert "Only the position is asked for" in browser.html()
        assert "favours" not in browser.html()
        await browser.press("z", "700")
        await browser.until(lambda: "only the position is asked for" in browser.html())
        assert "✓ reached" in browser.html()
        await browser.press("asks approach")
        await browser.until(lambda: "only position and approach direction are asked for" in browser.html())
        await browser.press("favours position")
        await browser.until(lambda: 'data-cell="favours position" title' in browser.html())
        await browser.press("x", "5000")
        await browser.until(lambda: "out of reach" in html.unescape(browser.html()))
        await browser.press("undo")
        await browser.until(lambda: "✓ reached" in browser.html())
        await browser.close()

    run(main())


def test_an_arm_that_controls_a_position_only_has_nothing_to_choose(url):
    async def main():
        browser = await student(url, path="/robot/planar_2r")
        await browser.open("target")
        await browser.until(lambda: "This arm controls the position only" in browser.html())
        assert "What counts" not in browser.html()
        await browser.close()

    run(main())
