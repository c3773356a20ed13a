"""What a person types arrives as it was typed, also over a slow network."""

import random

import pytest

from support.chromium import new_page
from support.lab import running_lab
from support.own_lessons import lesson, write
from support.page import LabPage
from support.slow_net import slowed

pytestmark = pytest.mark.browser

ROWS, COLUMNS, MATRICES = 6, 12, 3
"""Of the largest matrix a lesson may ask for, and how many of them: 216 entries."""

PAUSES = (0, 0, 0, 0, 0, 0, 40, 40, 40, 90)
"""Milliseconds between two keys, one of these for each entry."""

KINDS = ("{:.3f}", "{:.1f}", "{:.2f} m", "{:.0f}/8")
"""How an entry is written; the blank parts a number from its unit."""

LATE = 0.08, 0.14
"""Seconds by which everything is late, each way."""


def drawn():
    """Return entries as they are typed: numbers with signs, fractions, units."""
    rng = random.Random(7)
    count = ROWS * COLUMNS
    return [
        [KINDS[rng.randrange(len(KINDS))].format(rng.uniform(-1, 1)) for _ in range(count)] for _ in range(MATRICES)
    ]


def meant(text):
    number, _, rest = text.partition("/")
    return float(number.removesuffix(" m")) / (float(rest) if rest else 1.0)


def question(k, entries):
    rows = [[meant(text) for text in entries[i * COLUMNS : (i + 1) * COLUMNS]] for i in range(ROWS)]
    return (
        f'\n## Matrix {k}\n\nJoint 1 is at {{{{q1}}}}.\n\n```question\nkind = "matrix"\ntext = "Copy it."\n'
        f'answer = {rows}\nunit = "m"\ntolerance = 0.0001\n```\n'
    )


TWO_NUMBERS = """
## One

```question
kind = "number"
text = "One?"
answer = 1
tolerance = 0.01
```

## Two

```question
kind = "number"
text = "Two?"
answer = 2
tolerance = 0.01
```
"""


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    """A lab behind a slow network."""
    text = "\nIntroduction.\n" + "".join(question(k, entries) for k, entries in enumerate(drawn()))
    folder = write(tmp_path_factory.mktemp("lessons"), copied=lesson(text), numbers=lesson(TWO_NUMBERS))
    with running_lab(lessons=folder) as address, slowed(address, *LATE) as late:
        yield late


def held(lab):
    """Return what stands in the fields of the matrix."""
    values: list[str] = lab.page.locator(".entries input").evaluate_all("fields => fields.map(each => each.value)")
    return values


def test_of_200_entries_typed_over_a_slow_network_none_is_wrong(visit):
    lab = visit("lesson/copied", size=(1400, 850))
    rng, wrong = random.Random(1), []
    for k, entries in enumerate(drawn()):
        if k:
            lab.press(f"lesson-step-{k}")
        lab.until(lambda k=k: lab.page.get_by_role("heading", name=f"Matrix {k}").is_visible())
        fields = lab.page.locator(".entries input")
        assert fields.count() == ROWS * COLUMNS
        assert set(held(lab)) == {""}
        fields.first.click()
        for text in entries:
            lab.page.keyboard.type(text, delay=rng.choice(PAUSES))
            lab.page.keyboard.press("Tab")
        shown = held(lab)
        wrong += [pair for pair in zip(entries, shown, strict=True) if pair[0] != pair[1]]
        lab.page.locator('button[data-cell="lesson-check"]').click()
        lab.until(lambda: lab.page.locator(".ask + .verdict, .verdict.ok").first.is_visible())
        assert lab.page.locator(".verdict.ok").is_visible(), lab.page.locator(".verdict").inner_text()
        shown = held(lab)
        wrong += [pair for pair in zip(entries, shown, strict=True) if pair[0] != pair[1]]
    assert wrong == []


def test_what_is_typed_stays_where_it_is_typed_while_the_lab_answers(visit):
    lab = visit("lesson/copied", size=(1400, 850))
    fields = lab.page.locator(".entries input")
    fields.nth(0).click()
    _stands_where_the_cursor_is(lab)
    assert held(lab)[:3] == ["1", "0.9707", ""]
    fields.nth(2).click()
    _does_not_make_the_page_anew_without_end_with_a_blank(lab)
    assert held(lab)[2:5] == ["0.2 m", "0.3 m", ""]


def _does_not_make_the_page_anew_without_end_with_a_blank(lab):
    lab.page.keyboard.type("0.2 m")
    lab.page.keyboard.press("Tab")
    lab.page.keyboard.type("0.3 m")
    lab.still(1.0)
    changes = lab.page.evaluate(
        """async () => {
          let count = 0;
          const seen = new MutationObserver(() => count++);
          const whole = document.querySelector('.entries').closest('.al').parentElement;
          seen.observe(whole, { childList: true, subtree: true });
          await new Promise(done => setTimeout(done, 1500));
          return count;
        }"""
    )
    assert changes == 0


def test_what_is_typed_for_one_step_is_no_answer_to_another_to_which_another_window_went(visit):
    lab = visit("lesson/numbers", size=(1400, 850))
    answer = '.ask input[data-cell="lesson-answer"]'
    lab.page.locator(answer).click()
    lab.page.keyboard.type("2.0")
    other = LabPage(new_page(lab.page.context, painted=False), lab.url)
    other.press("lesson-next")
    lab.waits_for("Two?")
    lab.rest()
    lab.page.keyboard.press("Enter")
    lab.rest()
    assert lab.page.locator(answer).input_value() == ""
    assert lab.page.locator(".ask ~ .verdict").count() == 0
    lab.press("lesson-back")
    lab.waits_for("One?")
    _is_none_either_when_it_was_on_its_way(lab, answer)


def _is_none_either_when_it_was_on_its_way(lab, answer):
    lab.page.evaluate(
        """() => {
          const line = window.__viserMutable;
          const send = line.sendMessage;
          const held = [];
          line.sendMessage = message => held.push(message);
          window.letGo = () => {
            line.sendMessage = send;
            held.forEach(message => send(message));
          };
        }"""
    )
    lab.page.locator(answer).fill("2")
    lab.page.keyboard.press("Enter")
    other = LabPage(new_page(lab.page.context, painted=False), lab.url)
    other.press("lesson-next")
    lab.waits_for("Two?")
    assert lab.page.locator(answer).input_value() == ""
    lab.page.evaluate("() => window.letGo()")
    lab.waits_for("This page has moved on")
    assert lab.page.locator(answer).input_value() == ""
    assert lab.page.locator(".ask ~ .verdict").count() == 0


def _stands_where_the_cursor_is(lab):
    """Also in the middle of a word, and with the markup made anew beside it."""
    lab.page.keyboard.type("1")
    lab.page.keyboard.press("Tab")
    lab.page.keyboard.type("0.707")
    for _ in range(3):
        lab.page.keyboard.press("ArrowLeft")
    lab.page.evaluate("() => { window.held = document.activeElement; }")
    lab.rest()  # the answer to the first entry has come
    assert lab.page.evaluate("() => window.held.isConnected && window.held === document.activeElement")
    assert lab.page.evaluate("() => document.activeElement.selectionStart") == 2
    lab.page.keyboard.type("9")
