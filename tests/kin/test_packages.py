"""What the packages of the core offer by name."""

import inspect
import pkgutil
import re
from importlib import import_module

import pytest

import armlab.kin

PACKAGES = ["control", "drive", "ik", "motion", "velocity", "workspace"]


@pytest.mark.parametrize("package", PACKAGES)
def test_a_package_offers_its_public_names_with_their_documentation(package):
    module = import_module(f"armlab.kin.{package}")
    assert module.__all__ == sorted(module.__all__, key=lambda name: (not name.isupper(), not name[0].isupper(), name))
    for name in module.__all__:
        found = getattr(module, name)
        assert not inspect.ismodule(found), name
        assert found.__doc__


def test_the_names_a_script_needs_are_there():
    from armlab.kin.velocity import answer, determinant, singularities, subspaces  # noqa: F401
    from armlab.kin.workspace import coverage, planar_workspace, section, size  # noqa: F401


def _classes():
    for found in pkgutil.walk_packages(armlab.kin.__path__, "armlab.kin."):
        for name, each in inspect.getmembers(import_module(found.name), inspect.isclass):
            if (
                each.__module__ == found.name
                and not name.startswith("_")
                and not found.name.split(".")[-1].startswith("_")
            ):
                yield each


def test_what_is_called_joint_counts_from_one():
    """A field with the number of a joint, or several; a field may hold how many there are, or something of each."""
    checked = 0
    for each in _classes():
        kinds = inspect.get_annotations(each)
        for name in {"joint", "joints"} & set(kinds):
            if re.fullmatch(r"int|tuple\[(int, \.\.\.|tuple\[int, float\], \.\.\.)\]", str(kinds[name])):
                told = re.search(rf"^{name} : .*\n((?: {{4}}.*(?:\n|$))+)", inspect.getdoc(each), re.MULTILINE)
                assert told, each
                assert re.search("1-based|Number of joints", told[1]), each
                checked += 1
    assert checked >= 6
