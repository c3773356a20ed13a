"""The live table in a real browser: cells are typed, conventions changed, joints added, tables pasted."""

import numpy as np
import pytest

from armlab.content.robots import catalogue
from armlab.content.write_table import write_table

pytestmark = pytest.mark.browser
PUMA = catalogue()["puma560"]
TOO_WIDE = """() => {
  const panel = document.querySelector('.dh.edit').closest('.mantine-ScrollArea-root, [role=tabpanel], body');
  return [...panel.querySelectorAll('.al *')].filter(e => {
    const style = getComputedStyle(e), box = e.getBoundingClientRect();
    return box.width > 2 && (box.right > innerWidth || (e.matches('.field') && e.scrollWidth > e.clientWidth + 1));
  }).map(e => e.outerHTML.slice(0, 120));
}"""


def at_the_table(lab):
    lab.open_tab("Robot")
    lab.press("table")
    lab.page.locator(".dh.edit").wait_for()
    return lab


def value(lab, cell):
    return lab.page.locator(f'input[data-cell="{cell}"]').input_value()


def tool(lab):
    """Return where the page has the tool point, in the world."""
    return np.array(
        lab.page.evaluate(
            """([name, root]) => {
              const nodes = window.__viserMutable.nodeRefFromName;
              nodes[name].updateWorldMatrix(true, false);
              const place = nodes[name].position.clone().setFromMatrixPosition(nodes[name].matrixWorld);
              return nodes[root].worldToLocal(place).toArray();
            }""",
            [lab.node("/point"), "/" + lab.node("/point").split("/")[1]],
        )
    )


def test_cells_are_typed_a_joint_is_added_and_a_table_pasted(visit):
    lab = at_the_table(visit())
    _moves_the_arm_by_an_edited_cell_and_marks_a_wrong_one(lab)
    _draws_the_tool_point_where_it_was_typed(lab)
    _goes_down_the_column_by_enter_and_undoes_from_a_field(lab)
    _goes_on_to_the_next_cell(lab)
    _adds_a_joint_and_takes_a_pasted_table(lab)


def _moves_the_arm_by_an_edited_cell_and_marks_a_wrong_one(lab):
    np.testing.assert_allclose(lab.target(), PUMA.arm.position(PUMA.home), atol=1e-6)
    lab.type_into("dh-2-a", "600")
    rows = [{name: getattr(row, name) for name in ("kind", "a", "alpha", "d", "theta")} for row in PUMA.arm.rows]
    rows[1]["a"] = 0.6
    longer = type(PUMA.arm).from_dh(rows, "standard", PUMA.arm.base, PUMA.arm.tool)
    np.testing.assert_allclose(lab.target(), longer.position(PUMA.home), atol=1e-6)
    assert lab.address().split("?")[0].endswith("/")
    lab.type_into("dh-2-a", "a lot")
    wrong = lab.page.locator('input[data-cell="dh-2-a"]')
    assert wrong.get_attribute("aria-invalid") == "true"
    told = lab.page.locator("[role=alert]", has_text="row 2, a").last.inner_text()
    assert "row 2, a: expected a number in mm, got 'a lot'" in told
    np.testing.assert_allclose(lab.target(), longer.position(PUMA.home), atol=1e-6)
    lab.press("undo")
    assert value(lab, "dh-2-a") == "431.8"
    lab.until(lambda: "/robot/puma560" in lab.address())


def _draws_the_tool_point_where_it_was_typed(lab):
    T = PUMA.arm.fk(PUMA.home)
    np.testing.assert_allclose(tool(lab), T[:3, 3], atol=1e-5)
    lab.type_into("point-x", "100")
    np.testing.assert_allclose(tool(lab), T[:3, 3] + 0.1 * T[:3, 0], atol=1e-5)
    assert any(name.endswith("/point_line") for name in lab.nodes())


def _goes_down_the_column_by_enter_and_undoes_from_a_field(lab):
    field = lab.page.locator('input[data-cell="dh-1-d"]')
    field.fill("700")
    field.press("Enter")
    lab.rest()
    assert lab.page.evaluate("() => document.activeElement.dataset.cell") == "dh-2-d"
    assert value(lab, "dh-1-d") == "700"
    lab.page.keyboard.press("Control+z")
    lab.until(lambda: value(lab, "dh-1-d") == "671.83")


def _goes_on_to_the_next_cell(lab):
    field = lab.page.locator('input[data-cell="dh-1-d"]')
    field.fill("700")
    field.press("Tab")
    lab.rest()
    assert lab.page.evaluate("() => document.activeElement.dataset.cell") == "dh-1-theta"
    lab.page.keyboard.type("pi/4")
    lab.page.keyboard.press("Tab")
    lab.rest()
    assert (value(lab, "dh-1-d"), value(lab, "dh-1-theta")) == ("700", "+45")


def _adds_a_joint_and_takes_a_pasted_table(lab):
    lab.press("dh-6-add")
    assert sum("/arm/" in name and name.endswith("/body") for name in lab.nodes()) == 8
    lab.page.get_by_text("Paste a table").click()
    lab.page.locator("textarea[data-cell=paste]").fill(write_table(catalogue()["scara"].arm, "markdown"))
    lab.press("apply")
    lab.until(lambda: lab.page.locator('input[data-cell="dh-5-a"]').count() == 0)
    lab.rest()
    assert "SCARA: closed form" in lab.page.locator("body").inner_text()
    assert sum("/arm/" in name and name.endswith("/body") for name in lab.nodes()) == 5
    lab.page.reload()
    lab.ready()
    at_the_table(lab)
    assert lab.page.locator("tr:has(.head)").count() == 4


def test_the_other_convention_keeps_the_tool(visit):
    lab = at_the_table(visit("robot/planar_2r"))
    before = lab.target()
    lab.press("modified")
    np.testing.assert_allclose(lab.target(), before, atol=1e-6)
    assert "moved here from row 2" in lab.page.locator("body").inner_text()
    assert value(lab, "dh-1-a") == "0"
    lab.press("standard")
    np.testing.assert_allclose(lab.target(), before, atol=1e-6)
    assert value(lab, "dh-1-a") != "0"


def test_nothing_is_cut(visit):
    lab = visit("robot/trunk9", size=(1024, 700))
    at_the_table(lab)
    lab.press("dh-9-row")
    lab.type_into("dh-9-theta", "-2.5 rad")
    lab.type_into("dh-9-a", "-0.1234 m")
    lab.type_into("dh-9-alpha", "-1.5708 rad")
    assert lab.page.evaluate(TOO_WIDE) == []
    lab.open_tab("View")
    for unit in ("rad", "m"):
        lab.press(unit)
    at_the_table(lab)
    assert value(lab, "dh-9-theta") == "−2.5"
    assert lab.page.evaluate(TOO_WIDE) == []
