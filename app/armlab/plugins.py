"""Find plug-ins by folder: one module each, one constant each.

What is nobody's bench in particular lies in folders of its own, see `discover`; what belongs to a page lies in the
folder of that page, ``armlab/benches/TAB/PAGE``, in a module with a fixed name, see `discover_in_benches`. Nobody below
imports `armlab.benches`: it is only walked.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterable, Iterator
from types import ModuleType
from typing import Any, Protocol, TypeVar

from armlab.errors import PluginError


class Keyed(Protocol):
    """What every plug-in constant has."""

    @property
    def key(self) -> str:
        """A unique short name."""
        ...


T = TypeVar("T")
K = TypeVar("K", bound=Keyed)

BENCHES = "armlab.benches"
"""The package whose sub-packages are the tabs, and theirs the pages."""


def discover(package: ModuleType, constant: str, kind: type[K]) -> dict[str, K]:
    """Import every public module of a package and collect one constant from each.

    Parameters
    ----------
    package : module
        The folder; its modules whose names begin with an underscore are helpers and are left out.
    constant : str
        Name of the constant, such as ``"PANEL"``.
    kind : type
        What the constant must be an instance of.

    Returns
    -------
    dict
        Key to constant, ordered by ``order`` where the constants have one, then by key.

    Raises
    ------
    PluginError
        A module fails to import, its constant is missing or of another kind, or a key comes twice.
    """
    return _collected(_public(package), constant, kind)


def discover_in_benches(role: str, constant: str, kind: type[K], *shared: ModuleType) -> dict[str, K]:
    """Collect one constant from every module with a role in the folder of a page.

    Parameters
    ----------
    role : str
        Name of the module, or how it begins before an underscore, such as ``"job"`` for ``job.py`` and
        ``job_proof.py``, or ``"ui.scene"``.
    constant, kind
        As of `discover`.
    shared : module
        Folders with more of the kind that belong to no page.

    Returns
    -------
    dict
        As of `discover`.

    Raises
    ------
    PluginError
        As of `discover`.
    """
    names = [name for package in shared for name in _public(package)]
    return _collected([*names, *_with_role(role)], constant, kind)


def discover_pages(constant: str, kind: type[K]) -> dict[str, K]:
    """Collect one constant from the packages of all pages; see `discover`."""
    return _collected(bench_pages(), constant, kind)


def _with_role(role: str) -> Iterator[str]:
    """Yield the names of the modules of all pages that have a role."""
    folder, _, word = role.rpartition(".")
    for page in bench_pages():
        where = _within(page, folder)
        for info in pkgutil.iter_modules(importlib.import_module(where).__path__) if where else ():
            if info.name == word or info.name.startswith(f"{word}_"):
                yield f"{where}.{info.name}"


def _within(page: str, folder: str) -> str:
    """Return the name of a sub-package of a page, or of the page itself; empty where there is none such."""
    if not folder:
        return page
    there = pkgutil.iter_modules(importlib.import_module(page).__path__)
    return f"{page}.{folder}" if folder in {info.name for info in there} else ""


def bench_pages() -> Iterator[str]:
    """Yield the names of the packages of all pages, such as ``armlab.benches.robot.table``."""
    benches = importlib.import_module(BENCHES)
    for tab in pkgutil.iter_modules(benches.__path__, f"{BENCHES}."):
        for page in pkgutil.iter_modules(importlib.import_module(tab.name).__path__, f"{tab.name}."):
            if page.ispkg:
                yield page.name


def _public(package: ModuleType) -> Iterator[str]:
    for info in pkgutil.iter_modules(package.__path__):
        if not info.name.startswith("_"):
            yield f"{package.__name__}.{info.name}"


def _collected(names: Iterable[str], constant: str, kind: type[K]) -> dict[str, K]:
    found: dict[str, K] = {}
    origin: dict[str, str] = {}
    for name in names:
        plugin = constant_of(name, constant, kind)
        if plugin.key in found:
            raise PluginError(f"{name}: the key {plugin.key!r} is already used by {origin[plugin.key]}")
        found[plugin.key], origin[plugin.key] = plugin, name
    return dict(sorted(found.items(), key=lambda item: (getattr(item[1], "order", 0), item[0])))


def constant_of(module_name: str, constant: str, kind: type[T]) -> T:
    """Import a module and return its constant; `PluginError` when that fails or it is of another kind."""
    try:
        module: Any = importlib.import_module(module_name)
    except Exception as error:
        raise PluginError(f"{module_name}: cannot be imported: {error!r}") from error
    plugin = getattr(module, constant, None)
    if plugin is None:
        raise PluginError(f"{module_name}: expected a constant {constant}, found none")
    if not isinstance(plugin, kind):
        raise PluginError(f"{module_name}: {constant} must be a {kind.__name__}, got {type(plugin).__name__}")
    return plugin
