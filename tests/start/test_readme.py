"""What README shows to those who write scripts runs as it stands there."""

import re

import pytest

from support.sources import TOP

BLOCKS = re.findall(r"```python\n(.*?)```", (TOP / "README.md").read_text(encoding="utf-8"), re.DOTALL)


@pytest.mark.parametrize("script", BLOCKS)
def test_the_script_of_the_readme_runs(script, capsys):
    exec(script, {})
    assert capsys.readouterr().out.strip()
