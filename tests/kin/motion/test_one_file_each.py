"""A path and a timing law are one new file each."""

import pytest

from armlab.errors import PluginError
from armlab.kin import paths, timing
from armlab.kin.motion.law_types import law_types
from armlab.kin.motion.path_types import path_types

PATH = """
from armlab.kin.motion.path_types import PathType
from armlab.kin.paths._template import Template

def make(knots, options):
    return Template(knots, lambda s, order: (s**2, 2 * s, 2 + 0 * s, 0 * s)[order])

PATH = PathType("made_up", "Made up", 99, make, most=2)
"""

LAW = """
from armlab.kin.motion.law_types import LawType
from armlab.kin.timing.cubic import make

LAW = LawType("made_up", "Made up", 99, make)
"""


@pytest.mark.parametrize(
    ("folder", "text", "kinds"), [(paths, PATH, path_types), (timing, LAW, law_types)], ids=["path", "law"]
)
def test_a_file_in_the_folder_is_found(folder, text, kinds, tmp_path, monkeypatch):
    (tmp_path / "made_up.py").write_text(text, encoding="utf-8")
    monkeypatch.setattr(folder, "__path__", [*folder.__path__, str(tmp_path)])
    kinds.cache_clear()
    try:
        assert list(kinds())[-1] == "made_up"
        made = kinds()["made_up"]
        if folder is paths:
            assert made.path([[0.0], [4.0]]).at(0.5).tolist() == [1.0]
        else:
            assert made.law(2.0).duration == 2.0
        (tmp_path / "empty.py").write_text("x = 1", encoding="utf-8")
        kinds.cache_clear()
        with pytest.raises(PluginError, match="empty: expected a constant"):
            kinds()
    finally:
        monkeypatch.undo()
        kinds.cache_clear()
    assert "made_up" not in kinds()
