"""Find plug-ins by folder: one module each, one constant each."""

from __future__ import annotations

import importlib
import pkgutil
from types import ModuleType
from typing import Any, Protocol, TypeVar

from armlab.errors import PluginError


class Keyed(Protocol):
    """What every plug-in constant has."""

    @property
    def key(self) -> str:
        """A unique short name."""
        ...


T = TypeVar("T", bound=Keyed)


def discover(package: ModuleType, constant: str, kind: type[T]) -> dict[str, T]:
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
    found: dict[str, T] = {}
    origin: dict[str, str] = {}
    for info in pkgutil.iter_modules(package.__path__):
        if info.name.startswith("_"):
            continue
        name = f"{package.__name__}.{info.name}"
        plugin = _constant_of(name, constant, kind)
        if plugin.key in found:
            raise PluginError(f"{name}: the key {plugin.key!r} is already used by {origin[plugin.key]}")
        found[plugin.key], origin[plugin.key] = plugin, name
    return dict(sorted(found.items(), key=lambda item: (getattr(item[1], "order", 0), item[0])))


def _constant_of(module_name: str, constant: str, kind: type[T]) -> T:
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
