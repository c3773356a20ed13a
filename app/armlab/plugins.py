"""Find plug-ins by folder: one module each, one constant each.

Plug-ins of no page in particular lie in folders of their own, see `discover`; those of a page lie in the folder of that
page, ``armlab/benches/TAB/PAGE``, in modules with fixed names, see `discover_in_benches`. Nobody below imports
`armlab.benches`: it is only walked.
"""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterable, Iterator
from functools import cache
from types import ModuleType
from typing import TypeVar

from armlab.errors import PluginError
from armlab.registry import Keyed, Registry

T = TypeVar("T")
K = TypeVar("K", bound=Keyed)

BENCHES = "armlab.benches"
"""The package whose sub-packages are the tabs, and theirs the pages."""


def discover(package: ModuleType, constant: str, kind: type[K], word: str = "") -> Registry[K]:
    """Import every public module of a package and collect one constant from each.

    Parameters
    ----------
    package : module
        The folder; its modules whose names begin with an underscore are helpers and are left out.
    constant : str
        Name of the constant, such as ``"PANEL"``.
    kind : type
        What the constant must be an instance of.
    word : str, optional
        What one is called in sentences; that of the constant when left out.

    Returns
    -------
    Registry
        The constants by key, ordered by ``order`` where they have one, then by key.

    Raises
    ------
    PluginError
        A module fails to import, its constant is missing or of another kind, or a key comes twice.
    """
    return _collected(_public(package), constant, kind, word)


def discover_in_benches(role: str, constant: str, kind: type[K], *shared: ModuleType | str) -> Registry[K]:
    """Collect one constant from every module with a role in the folder of a page.

    Parameters
    ----------
    role : str
        Name of the module, or how it begins before an underscore, such as ``"job"`` for ``job.py`` and
        ``job_proof.py``, or ``"ui.scene"``.
    constant, kind
        As of `discover`.
    shared : module or str
        Folders with more of the kind that belong to no page, or their names.

    Returns
    -------
    Registry
        As of `discover`.

    Raises
    ------
    PluginError
        As of `discover`.
    """
    folders = [_imported(each) if isinstance(each, str) else each for each in shared]
    names = [name for package in folders for name in _public(package)]
    return _collected([*names, *_with_role(role)], constant, kind)


def discover_pages(constant: str, kind: type[K]) -> Registry[K]:
    """Collect one constant from the packages of all pages; see `discover`."""
    return _collected(bench_pages(), constant, kind)


def _with_role(role: str) -> Iterator[str]:
    """Yield the names of the modules of all pages that have a role."""
    folder, _, word = role.rpartition(".")
    for page in bench_pages():
        where = _within(page, folder)
        for name in _inside(where) if where else ():
            if name == word or name.startswith(f"{word}_"):
                yield f"{where}.{name}"


def _within(page: str, folder: str) -> str:
    """Return the name of a sub-package of a page, or of the page itself; empty where there is none such."""
    if not folder:
        return page
    return f"{page}.{folder}" if folder in _inside(page) else ""


@cache
def _inside(package: str) -> dict[str, bool]:
    """Return the names of the modules of a package, and whether each is a package; its folder is looked at once."""
    return {info.name: info.ispkg for info in pkgutil.iter_modules(importlib.import_module(package).__path__)}


def bench_pages() -> Iterator[str]:
    """Yield the names of the packages of all pages, such as ``armlab.benches.robot.table``."""
    for tab in _inside(BENCHES):
        for page, is_package in _inside(f"{BENCHES}.{tab}").items():
            if is_package:
                yield f"{BENCHES}.{tab}.{page}"


def modules_of_page(page: str) -> Iterator[ModuleType]:
    """Import the modules in the folder of a page, by the name of its package, and yield them.

    Raises
    ------
    PluginError
        A module fails to import.
    """
    for name, is_package in _inside(page).items():
        if not is_package:
            yield _imported(f"{page}.{name}")


def _public(package: ModuleType) -> Iterator[str]:
    for info in pkgutil.iter_modules(package.__path__):
        if not info.name.startswith("_"):
            yield f"{package.__name__}.{info.name}"


def _collected(names: Iterable[str], constant: str, kind: type[K], word: str = "") -> Registry[K]:
    names = list(names)
    word = word or constant.lower()
    found = Registry(word, [constant_of(name, constant, kind) for name in names], names)
    ordered = sorted(found.values(), key=lambda plugin: (getattr(plugin, "order", 0), plugin.key))
    return Registry(word, ordered, [found.origin[plugin.key] for plugin in ordered])


def constant_of(module_name: str, constant: str, kind: type[T]) -> T:
    """Import a module and return its constant; `PluginError` when that fails or it is of another kind."""
    plugin = getattr(_imported(module_name), constant, None)
    if plugin is None:
        raise PluginError(f"{module_name}: expected a constant {constant}, found none")
    if not isinstance(plugin, kind):
        raise PluginError(f"{module_name}: {constant} must be a {kind.__name__}, got {type(plugin).__name__}")
    return plugin


def _imported(name: str) -> ModuleType:
    try:
        return importlib.import_module(name)
    except Exception as error:
        raise PluginError(f"{name}: cannot be imported: {error!r}") from error
