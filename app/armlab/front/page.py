"""The page as the front serves it: viser's own, with our script and style before it, and the policy that fits exactly.

viser's page holds a small loader script whose attribute ``data-p`` carries the packed style sheet and program; the
loader inserts the program as a second inline script. Both get a hash in the Content-Security-Policy, so that no other
script can run, not even one that finds its way into a label.
"""

from __future__ import annotations

import base64
import gzip
import hashlib
import re
from dataclasses import dataclass
from functools import cached_property
from importlib import resources
from importlib.resources.abc import Traversable
from importlib.util import find_spec
from pathlib import Path

import zstandard

from armlab.errors import ArmlabError

# The digits of the base-88 code of viser's build: printable ASCII without quotes, brackets and ampersand.
_DIGITS = "".join(character for character in map(chr, range(0x21, 0x7F)) if character not in "\"&<>'`")
_VALUES = bytes(max(0, _DIGITS.find(chr(code))) for code in range(256))
_LOADER = re.compile(r'<script data-p="([^"]*)" data-ss="(\d+)" data-cs="(\d+)">(.*?)</script>', re.DOTALL)

FRAMES = "'self' http://localhost:* http://127.0.0.1:*"
"""Sources that may show the lab in a frame: notebooks on the same machine."""


class PageError(ArmlabError):
    """The installed viser is not the tested version."""


@dataclass(frozen=True)
class Page:
    """The page and the hashes of its scripts."""

    html: bytes
    scripts: tuple[str, ...]

    @cached_property
    def compressed(self) -> bytes:
        """The page, gzipped."""
        return gzip.compress(self.html, 6)

    def policy(self, sockets: str) -> str:
        """Return the Content-Security-Policy; ``sockets`` are addresses to which the page may open a WebSocket."""
        return "; ".join(
            [
                "default-src 'none'",
                f"script-src {' '.join(self.scripts)} 'wasm-unsafe-eval'",
                "worker-src blob:",
                "style-src 'unsafe-inline'",  # Mantine writes style elements; MathML needs style attributes
                "img-src data: blob:",
                "font-src data:",
                f"connect-src {sockets} data: blob:",
                "frame-src 'none'",
                "form-action 'none'",
                "base-uri 'none'",
                f"frame-ancestors {FRAMES}",
            ]
        )


def make_page(title: str = "Armlab") -> Page:
    """Return the page made from the installed viser.

    Raises
    ------
    PageError
        viser is missing or its page has another shape than the tested one.
    """
    spec = find_spec("viser")  # found, not imported: a front of its own process stays small
    if spec is None or spec.origin is None:
        raise PageError("viser is not installed")
    source = (Path(spec.origin).parent / "client" / "build" / "index.html").read_text(encoding="utf-8")
    match = _LOADER.search(source)
    if match is None or "<title>" not in source or "<head>" not in source:
        raise PageError(
            "viser's page has changed: its loader script was not found; install the version of pyproject.toml"
        )
    packed, styles, _, loader = match.groups()
    unpacked = zstandard.ZstdDecompressor().decompress(decode_base88(packed))
    script, style = _assets(".js"), f"{_assets('.css')}\n{_bench_styles()}"
    html = re.sub(r"<title>.*?</title>", f"<title>{title}</title>", source, count=1)
    html = html.replace("<head>", f"<head><script>{script}</script><style>{style}</style>", 1)
    program = unpacked[int(styles) :]
    return Page(html.encode(), tuple(_hash(code) for code in (script.encode(), loader.encode(), program)))


def decode_base88(text: str) -> bytes:
    """Return the bytes of a base-88 text: five digits for four bytes, most significant first.

    All groups are one whole number, four bytes of it each, in which none overflows into the next: so the
    page is decoded by ten long operations instead of a million short ones.
    """
    digits = text.encode().translate(_VALUES)
    whole = len(digits) // 5
    groups = 0
    for place in range(5):
        lanes = bytearray(4 * whole)
        lanes[3::4] = digits[place : 5 * whole : 5]
        groups = 88 * groups + int.from_bytes(lanes, "big")
    last = 0
    for digit in digits[5 * whole :]:
        last = 88 * last + digit
    return groups.to_bytes(4 * whole, "big") + last.to_bytes(max(0, len(digits) % 5 - 1), "big")


def _asset(file: Traversable) -> str:
    text = file.read_text(encoding="utf-8")
    if "</script" in text or "</style" in text:
        raise PageError(f"{file.name} would end its own element")
    return text


def _assets(ending: str) -> str:
    """Return the files for the whole lab with this ending, then those for single topics."""
    folder = resources.files("armlab.front") / "static"
    names = sorted(file.name for file in folder.iterdir())
    topics = (name for name in names if name.endswith(ending) and name != f"armlab{ending}")
    return "\n".join(_asset(folder / name) for name in (f"armlab{ending}", *topics))


def _bench_styles() -> str:
    """Return the stylesheets of the benches, each restricted to the pages of its own tab."""
    found = []
    for tab in _folders(resources.files("armlab") / "benches"):
        for page in _folders(tab):
            file = page / "style.css"
            if file.is_file():
                found.append(f".b-{tab.name} {{\n{_closed(_asset(file), f'{tab.name}/{page.name}')}}}")
    return "\n".join(found)


def _closed(rules: str, page: str) -> str:
    """Return a stylesheet; `PageError` when it would end the rule around it, or leaves one open."""
    depth = 0
    for brace in re.findall(r"[{}]", re.sub(r"/\*.*?\*/", "", rules, flags=re.DOTALL)):
        depth += 1 if brace == "{" else -1
        if depth < 0:
            break
    if depth != 0:
        raise PageError(f"{page}/style.css: expected a closing brace for each opening one")
    return rules


def _folders(place: Traversable) -> list[Traversable]:
    return sorted((entry for entry in place.iterdir() if entry.is_dir()), key=lambda entry: entry.name)


def _hash(code: bytes) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(code).digest()).decode()}'"
