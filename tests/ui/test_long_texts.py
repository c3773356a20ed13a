"""Texts that nobody types: fields hand on no more than their reader takes, and hold nothing of it."""

import json
import time

import pytest

from armlab.benches.motion.files.table import MOST_BYTES
from armlab.benches.workspace.cloud.ui.page import choices_markup
from armlab.content import table_grid, tables
from armlab.content.arithmetic import LONGEST
from armlab.content.robots import catalogue
from armlab.errors import InputError
from armlab.kin.motion.law_types import law_type
from armlab.session.edits import MOST_TEXT, PasteTable
from armlab.session.state import State
from armlab.teaching.hand_in import MOST
from armlab.teaching.lesson_progress import MOST_TYPED
from armlab.ui import option_text
from armlab.ui.fields import LONGEST_CELL, LONGEST_TYPED, Fields
from armlab.ui.units import units_of
from support.bare import Bare
from support.forms import asked
from support.patience import Patience
from support.student import run, student

PUMA = catalogue()["puma560"]


@pytest.fixture
def bare():
    started = Bare()
    yield started
    started.stop()


def sent(browser, channel, said):
    return browser.send({"type": "GuiUpdateMessage", "uuid": channel, "updates": {"value": said}})


def test_a_field_hands_on_what_its_reader_takes_and_one_character_more(bare):
    async def work(browser, do):
        fields = await do(lambda: Fields(bare.client.gui, lambda *said: heard.append(tuple(map(len, said))), 50))
        await browser.until(lambda: fields.channel_id in browser.controls)
        for said in (["c" * 10_000, "9" * 400_000, 1], ["c", "9" * 50, 2], [["c"], {"t": "9"}, 3]):
            await sent(browser, fields.channel_id, json.dumps(said))
        await sent(browser, fields.channel_id, "[" * 100_000)
        await sent(browser, fields.channel_id, "9" * 400_000)
        await sent(browser, fields.channel_id, json.dumps(["last", "", 4]))
        patience = Patience()
        while (4, 0) not in heard and patience.left():
            await browser.until(lambda: True)
            await do(lambda: None)
        assert fields.channel.value == "", "what was typed is not held a second time"

    heard = []
    bare.run(work)
    assert heard == [(LONGEST_CELL, 51), (1, 50), (0, 0), (4, 0)]


def test_what_nobody_types_is_refused_at_the_field_and_what_was_shown_stays(bare):
    async def work(browser, do):
        fields = await do(lambda: Fields(bare.client.gui, lambda *said: heard.append(said)))
        await do(lambda: fields.show("<b>as it was</b>"))
        await browser.until(lambda: "as it was" in browser.html())
        await sent(browser, fields.channel_id, json.dumps(["c", "9" * (LONGEST_TYPED + 1), 1]))
        await browser.until(lambda: "expected at most 20000 characters, got 20001" in browser.html())
        assert "as it was" in browser.html()
        await sent(browser, fields.channel_id, json.dumps(["c", "9" * LONGEST_TYPED, 2]))
        patience = Patience()
        while not heard and patience.left():
            await browser.until(lambda: True)
            await do(lambda: None)

    heard = []
    bare.run(work)
    assert heard == [("c", "9" * LONGEST_TYPED)]


def test_every_reader_that_takes_long_texts_has_a_field_that_hands_them_on():
    assert max(table_grid.LONGEST, MOST_TYPED, LONGEST) <= LONGEST_TYPED
    assert max(MOST_TEXT, MOST, MOST_BYTES) < 2_000_000, "more does not fit into a message"


FILES = {
    "table rows": ("read-motion", "time_s,q1_rad\n" + "0,0\n" * 300_000, "rows are too many"),
    "table columns": ("read-motion", "," * 400_000, "columns are too many"),
    "table of no numbers": ("read-motion", "time_s,q1,q2,q3,q4,q5,q6\n" + "nan," * 6 + "nan\n", "a finite number"),
    "no text": ("read-motion", "".join(map(chr, range(256))) * 1000, "binary"),
    "nested plan": ("read-motion", '{"a":' * 200_000, "plan"),
    "large file": ("read-motion", "1" * 1_900_000, "larger than 1.5 MB"),
}


@pytest.mark.parametrize(("cell", "text", "says"), FILES.values(), ids=FILES)
def test_a_file_that_is_none_is_a_sentence_at_its_field(url, cell, text, says):
    async def main():
        browser = await student(url)
        await browser.open("motion_files")
        shown = next(c for c in browser.controls.values() if f'data-cell="{cell}"' in c["props"].get("content", ""))
        channel = browser.channel(cell)
        await browser.press_on(channel, cell, text)
        await browser.until(lambda: says in browser.html())
        assert len(shown["props"]["content"]) < 100_000
        await browser.close()

    run(main())


def test_digits_without_end_take_a_table_no_longer_than_letters():
    def seconds(text):
        began = time.process_time()
        with pytest.raises(InputError):
            PasteTable(text).apply(state)
        return time.process_time() - began

    state = State.initial(PUMA)
    seconds("x" * LONGEST_TYPED)
    # A reader that looks on from each digit takes a thousand times as long.
    assert seconds("9" * LONGEST_TYPED) < 100.0 * seconds("x" * LONGEST_TYPED)


def test_a_table_of_ten_thousand_columns_is_a_sentence_before_any_is_read(monkeypatch):
    monkeypatch.setattr(tables, "read_header", lambda line: read.append(line))
    read = []
    with pytest.raises(InputError, match=r"^the table: expected at most 60 columns, got 10000$"):
        PasteTable("1 " * 10_000).apply(State.initial(PUMA))
    assert not read


def test_of_ten_thousand_numbers_in_the_field_of_one_none_is_worked_out(monkeypatch):
    monkeypatch.setattr(option_text, "evaluate", lambda text: worked_out.append(text))
    worked_out = []
    one = next(field for field in law_type("trapezoidal").fields if field.kind == "number")
    with pytest.raises(InputError, match="expected a number"):
        option_text.option_value(one, "1 " * 10_000)
    assert not worked_out


def test_a_seed_of_many_digits_is_a_sentence():
    state = State.initial(PUMA)
    with pytest.raises(InputError, match=r"^seed: expected a whole number, got '9{40}'$"):
        asked(lambda form: choices_markup(form, state, units_of(state)), "seed", "9" * 20_000)
