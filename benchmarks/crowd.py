"""Thirty students who drag at once while each has a bench open: what may lag gives way to the arm."""

import asyncio
from collections.abc import Iterator

import numpy as np

import drag
import servers
from rounds import quantile, sized
from support.fake_browser import FakeBrowser

TITLE = "A class dragging with a bench open: handle event to new pose"
STUDENTS, ROUNDS = sized((30, 2), (1, 1))
BENCHES = sized(("joints", "table", "film", "pose", "ellipsoid", "solutions"), ("joints",))


def measure() -> Iterator[str]:
    yield "| bench open | server | p50 | p95 | p95 ÷ bare viser | processor time |"
    yield "| --- | --- | --- | --- | --- | --- |"
    points, angles = drag.script()
    for bench in BENCHES:
        found: dict[str, tuple[list[float], list[float]]] = {}
        for _ in range(ROUNDS):
            for name, labs in (("bare viser", None), ("one process", 0), (f"front and {drag.LABS} labs", drag.LABS)):
                latencies, load = _once(points, angles, bench, labs)
                kept = found.setdefault(name, ([], []))
                kept[0].extend(latencies)
                kept[1].append(load)
        judge = quantile(found["bare viser"][0], 0.95)
        for name, (latencies, loads) in found.items():
            p50, p95 = (quantile(latencies, part) for part in (0.5, 0.95))
            times = f"{p50 * 1e3:.1f} ms | {p95 * 1e3:.1f} ms | {p95 / judge:.2f}"
            yield f"| {bench} | {name} | {times} | {100 * np.median(loads):.0f} % |"


def _once(points: np.ndarray, angles: np.ndarray, bench: str, labs: int | None) -> tuple[list[float], float]:
    async def prepare(browser: FakeBrowser) -> None:
        await browser.open(bench)

    if labs is None:
        with servers.bare() as server:
            return asyncio.run(drag.drive(server, STUDENTS, points, lambda _: drag.by_echo(points)))
    with servers.lab(labs) as server:
        reader = lambda browser: drag.by_first_joint(browser, angles)  # noqa: E731
        return asyncio.run(drag.drive(server, STUDENTS, points, reader, prepare))
