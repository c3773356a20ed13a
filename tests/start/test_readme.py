"""What README shows to those who write scripts runs as it stands there."""

import re

import pytest

from armlab.kin.arm import Arm
from support.sources import TOP

README = (TOP / "README.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"```python\n(.*?)```", README, re.DOTALL)


@pytest.mark.parametrize("script", BLOCKS)
def test_the_script_of_the_readme_runs(script, capsys):
    exec(script, {})
    assert capsys.readouterr().out.strip()


def test_the_readme_names_the_axes_of_the_jacobian_that_its_docstring_names():
    axes = re.search(r"arm\.jacobian.*, (\w+ axes)$", README, re.MULTILINE)
    assert axes
    assert axes[1] in Arm.jacobian.__doc__
