"""The sampled workspace in a real browser: points come while it is sampled, a slice, a click that moves the arm."""

import numpy as np
import pytest
from PIL import Image

pytestmark = pytest.mark.browser

POINTS = """name => {
  const node = window.__viserMutable.nodeRefFromName[name]; let count = 0;
  node.traverse(each => { if (each.isPoints) count = each.geometry.attributes.position.count; });
  return count;
}"""
PLACE = "name => { const { position } = window.__viserMutable.nodePoseData[name]; return position; }"


def points(lab):
    names = [name for name in lab.nodes() if name.endswith("/workspace/points")]
    return lab.page.evaluate(POINTS, names[0]) if names else 0


def test_the_cloud_grows_is_cut_and_answers_a_click(visit):
    lab = visit("robot/elbow_3r")
    lab.open_tab("Workspace")
    lab.page.locator('select[data-cell="count"]:visible').select_option("10000000")
    # Singular values take their time: half a minute for so many samples.
    lab.page.locator('select[data-cell="measure"]:visible').select_option("sigma_min")
    lab.press("cut none")
    lab.press("sample")
    lab.page.get_by_text("Sampling:").wait_for()
    lab.until(lambda: points(lab) > 0)
    lab.page.locator(".kv", has_text="Points drawn").first.wait_for()
    # More samples come while the first are looked at; then it is ended half way.
    before = done(lab)
    lab.until(lambda: done(lab) > before)
    lab.press("cancel")
    lab.page.locator('button[data-cell="sample"]:visible').wait_for()
    lab.rest()
    everything = points(lab)
    assert everything == 26_000
    assert done(lab) < 10_000_000
    lab.press("cut z")
    lab.until(lambda: 0 < points(lab) < everything // 2)
    lab.press("cut front")
    lab.until(lambda: everything // 3 < points(lab) < 2 * everything // 3)
    lab.rest()
    # Somewhere in the cloud, above the arm and away from its handle.
    box = lab.page.locator("canvas").first.bounding_box()
    middle = (box["x"] + 0.42 * box["width"], box["y"] + 0.45 * box["height"])
    lab.page.mouse.move(*middle)
    lab.page.wait_for_timeout(200)
    lab.page.mouse.down()
    lab.page.wait_for_timeout(120)
    lab.page.mouse.up()
    lab.page.locator(".verdict", has_text="The arm is there").wait_for()
    lab.rest()
    said = lab.page.locator(".verdict", has_text="The arm is there").inner_text()
    place = [float(each.replace("−", "-")) for each in said.partition("(")[2].partition(")")[0].split(",")]
    marked = lab.page.evaluate(PLACE, lab.node("/workspace/chosen"))
    np.testing.assert_allclose(1000.0 * np.array(marked), place, atol=0.06)
    # The arm went along: its handle, which sits on the tool, is at the point.
    np.testing.assert_allclose(lab.target(), marked, atol=1e-4)


def done(lab):
    rows = lab.page.locator(".kv:visible", has_text="Points drawn").first.locator("span").all_inner_texts()
    return int(rows[rows.index("Samples") + 1].replace("\u202f", ""))


def test_the_scene_is_saved_as_a_picture(visit):
    lab = visit("robot/planar_2r", painted=True)
    lab.open_tab("Workspace")
    lab.press("sample")
    lab.page.locator('button[data-cell="png"]:visible').wait_for()
    lab.rest()
    with lab.page.expect_download() as saved:
        lab.press("png")
    assert saved.value.suggested_filename == "workspace_planar_2r.png"
    picture = np.asarray(Image.open(saved.value.path()))
    assert picture.ndim == 3
    assert min(picture.shape[:2]) > 200
    # Points of many colours, and nothing where there is neither arm nor ground.
    assert len(np.unique(picture[..., :3].reshape(-1, 3), axis=0)) > 500
