"""A motion is saved and read again, and a recording of it plays without a lab."""

import json

import pytest

pytestmark = pytest.mark.browser

READ = 'input[type=file][data-cell="read-motion"]'

CHOOSE = """([field, files]) => {
  const input = document.querySelector(field);
  for (const [name, byte, size] of files) {
    const chosen = new DataTransfer();
    chosen.items.add(new File([new Uint8Array(size).fill(byte)], name));
    input.files = chosen.files;
    input.dispatchEvent(new Event('change', {bubbles: true}));
  }
}"""
"""Chooses files one after the other before the lab has answered; the first takes longer to read."""


def at_files(visit, path="robot/scara", **options):
    lab = visit(path, **options)
    lab.open_tab("Motion")
    lab.press("motion_files")
    lab.until(lambda: "Plan of 2 waypoints" in says(lab))
    return lab


def says(lab):
    return lab.page.locator(".al:has(.row.files)").inner_text()


def save(lab, cell, folder):
    """Press a button; returns the file the browser has saved."""
    with lab.page.expect_download() as download:
        lab.page.locator(f'button[data-cell="{cell}"]').click()
    path = folder / download.value.suggested_filename
    download.value.save_as(path)
    lab.until(lambda: f"✓ Saved {path.name}" in says(lab))
    return path


def test_files_are_saved_read_again_and_refused_in_words_and_a_recording_plays_without_a_lab(visit, tmp_path):
    lab = at_files(visit)
    _saves_a_table_and_a_plan_and_reads_them_again(lab, tmp_path)
    _refuses_in_words_what_cannot_be_read_and_lives_on(lab, tmp_path)
    _saves_a_recording_that_plays_without_a_lab(lab, tmp_path)


def _saves_a_table_and_a_plan_and_reads_them_again(lab, tmp_path):
    table = save(lab, "csv", tmp_path)
    rows = table.read_text().splitlines()
    assert rows[0].startswith("time_s,q1_rad,q2_rad,q3_m,q4_rad,qdot1_rad_s")
    plan = save(lab, "json", tmp_path)
    lab.page.locator(READ).set_input_files(table)
    lab.until(lambda: f"From a file: {len(rows) - 1} samples" in says(lab))
    lab.page.locator(READ).set_input_files(plan)
    lab.until(lambda: "Plan of 2 waypoints" in says(lab))
    again = save(lab, "json", tmp_path / "again")
    assert json.loads(again.read_text()) == json.loads(plan.read_text())


def _refuses_in_words_what_cannot_be_read_and_lives_on(lab, tmp_path):
    said = lab.page.locator('p.no[role="alert"]')
    for name, data, wanted in (  # no sentence twice in a row, or the second would be taken for there at once
        ("empty.csv", b"", "the file is empty"),
        ("zeros.bin", bytes(3_000_000), "expected text in UTF-8, got a binary file"),
        ("many.csv", b"0,0,0,0,0\n" * 1_000_000, "the file is larger than 1.5 MB"),
        ("high.bin", b"\xff" * 1_400_000, "expected text in UTF-8, got a binary file"),
        ("rows.csv", "".join(f"{k},0,0,0,0\n" for k in range(20_000)).encode(), "20000 rows are too many"),
    ):
        (tmp_path / name).write_bytes(data)
        lab.page.locator(READ).set_input_files(tmp_path / name)
        lab.until(lambda wanted=wanted: said.count() == 1 and wanted in said.inner_text())
    lab.page.evaluate(CHOOSE, [READ, [["high.bin", 0xFF, 1_400_000], ["empty.csv", 0, 0]]])
    lab.until(lambda: said.count() == 1 and "the file is empty" in said.inner_text())
    lab.rest()
    assert "the file is empty" in said.inner_text()
    assert "Plan of 2 waypoints" in says(lab)


def _saves_a_recording_that_plays_without_a_lab(lab, tmp_path):
    path = save(lab, "html", tmp_path)
    page = lab.page.context.new_page()
    asked, errors = [], []
    page.on("request", lambda request: asked.append(request.url))
    page.on("websocket", lambda socket: asked.append(socket.url))
    page.on("pageerror", lambda error: errors.append(str(error)))
    lab.page.context.set_offline(True)
    page.goto(path.as_uri())
    loaded = "Object.keys(window.__viserMutable?.nodeRefFromName ?? {}).filter(name => name.endsWith('/body')).length"
    page.wait_for_function(f"() => {loaded} === 5")
    assert page.title().endswith(": motion")
    turn = "window.__viserMutable.nodePoseData['/0/arm/1'].wxyz.join()"
    first = page.evaluate(turn)
    page.wait_for_function(f"first => {turn} !== first", arg=first)
    assert all(address.startswith(("file:", "data:", "blob:")) for address in asked)
    assert errors == []
    lab.page.context.set_offline(False)


def test_nothing_is_cut_on_the_page(visit, tmp_path):
    lab = at_files(visit, "robot/puma560", size=(1024, 700))
    table = save(lab, "csv", tmp_path)
    lab.page.locator(READ).set_input_files(table)
    lab.until(lambda: lab.page.locator('[data-cell="by-time"]').count() == 1)
    lab.rest()
    over = lab.page.evaluate(
        """() => [...document.querySelectorAll('.al:has(.row.files) *, .al:has(.made) *')]
          .filter(e => e.getClientRects().length && !e.matches('input[type=file]'))
          .filter(e => e.getBoundingClientRect().right > innerWidth - 4
            || (e.clientWidth && e.scrollWidth > e.clientWidth + 1))
          .map(e => e.outerHTML.slice(0, 120))"""
    )
    assert over == []
    tops = [lab.page.locator(f'[data-cell="{cell}"]').bounding_box()["y"] for cell in ("by-shape", "by-time")]
    assert tops[0] == pytest.approx(tops[1], abs=1.0)
