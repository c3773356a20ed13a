"""What the packages of the core offer by name."""

import inspect
from importlib import import_module

import pytest

PACKAGES = ["control", "ik", "motion", "velocity", "workspace"]


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
