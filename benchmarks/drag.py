"""From an event of the handle to the new pose, for 1 to 60 students dragging at once at 20 events a second."""

import asyncio
import html
import json
import time
from collections.abc import Awaitable, Callable, Iterator

import numpy as np

import servers
from armlab.content.robots import catalogue
from armlab.session.parts.joints import Joints
from armlab.session.parts.target import DragTarget, target_pose
from armlab.session.session import Session
from rounds import quantile, sized
from support.fake_browser import FakeBrowser, Message

TITLE = "Dragging: handle event to new pose at the client"
CLASSES, ROUNDS = sized(((1, 10, 30, 60), 3), ((1,), 1))
RATE, SECONDS = 20.0, sized(6.0, 0.3)
LABS = sized(2, 1)
EVENTS = int(RATE * SECONDS)
LAST = sized(0.5, 0.1)
"""Seconds for the last answers."""

Prepare = Callable[[FakeBrowser], Awaitable[None]]
"""What a student does before the drag."""

SETTLING = sized(12.0, 0.2)
"""Seconds until every server has done what it does once, after its start and for new pages; a lab reads its lessons."""


def measure() -> Iterator[str]:
    yield "| students | server | p50 | p95 | p95 ÷ bare viser | processor time |"
    yield "| --- | --- | --- | --- | --- | --- |"
    points, angles = script()
    joint = lambda browser: by_first_joint(browser, angles)  # noqa: E731
    every: dict[str, tuple[Callable, Callable, Prepare | None]] = {
        "bare viser": (servers.bare, lambda _browser: by_echo(points), None),
        "Armlab, one process": (servers.lab, joint, None),
        f"Armlab, front and {LABS} labs": (lambda: servers.lab(LABS), joint, None),
    }
    alone = {
        "Armlab, its page of plots open": (servers.lab, joint, open_plots),
        "Armlab, its plots in the tray": (servers.lab, joint, open_tray),
    }
    for count in CLASSES:
        kinds = {**every, **(alone if count == 1 else {})}
        found: dict[str, tuple[list[float], list[float]]] = {name: ([], []) for name in kinds}
        for _ in range(ROUNDS):
            for name, (start, reader, prepare) in kinds.items():
                with start() as server:
                    latencies, load = asyncio.run(drive(server, count, points, reader, prepare))
                found[name][0].extend(latencies)
                found[name][1].append(load)
        judge = quantile(found["bare viser"][0], 0.95)
        for name, (latencies, loads) in found.items():
            p50, p95 = quantile(latencies, 0.5), quantile(latencies, 0.95)
            times = f"{p50 * 1e3:.1f} ms | {p95 * 1e3:.1f} ms | {p95 / judge:.2f}"
            yield f"| {count} | {name} | {times} | {100 * np.median(loads):.0f} % |"


PLOTS = "ellipsoid"
"""A page whose plots follow the arm: their cursors at every step, their curves when the arm rests."""


async def open_plots(browser: FakeBrowser) -> None:
    """Open the page of plots."""
    await browser.open(PLOTS)
    await browser.until(lambda: "data-cursor" in browser.html())


async def open_tray(browser: FakeBrowser) -> None:
    """Open the page of plots and show two of them large, with the points of a screen."""
    await open_plots(browser)
    await browser.press("large")
    await browser.until(lambda: "data-tray=" in browser.html())
    head = json.loads(html.unescape(browser.html().split('data-tray="', 1)[1].split('"', 1)[0]))
    look = {"keys": [plot["key"] for plot in head["plots"][:2]], "points": 900}
    await browser.press_on(head["chan"], "look", json.dumps(look))
    await browser.until(lambda: browser.html().count("data-numbers=") == 2)


def script() -> tuple[np.ndarray, np.ndarray]:
    """Return the points of the drag and the angles of joint 1 that the lab answers with."""
    session = Session.fresh("x", catalogue()["puma560"])
    pose = target_pose(session.state).copy()
    points, angles = [], []
    for k in range(EVENTS):
        turn, radius = -0.9 + 1.5 * k / EVENTS, 0.62 + 0.06 * np.sin(k / 9)
        pose = pose.copy()
        pose[:3, 3] = radius * np.cos(turn), radius * np.sin(turn), 0.72 + 0.08 * np.sin(k / 7)
        session.apply(DragTarget(pose, 1), 0)
        points.append(pose[:3, 3])
        angles.append(session.state[Joints].q[0])
    return np.array(points), np.array(angles)


def to_and_fro(points: np.ndarray, angles: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield points and angles of one drag after the other: the first ends where the script begins, the next returns.

    Where the arm stands no event moves it: so all but the first leave out their first point.
    """
    points, angles = points[::-1], angles[::-1]
    yield points, angles
    while True:
        points, angles = points[::-1], angles[::-1]
        yield points[1:], angles[1:]


Reader = Callable[[Message], int | None]
"""Returns the event a message answers, if it answers one."""


def by_echo(points: np.ndarray) -> Reader:
    """Read the sphere of the bare server."""

    def event_of(message: Message) -> int | None:
        if message["type"] != "SetPositionMessage" or message["name"] != "/echo":
            return None
        distances = np.abs(points - message["position"]).max(axis=1)
        k = int(np.argmin(distances))
        return k if distances[k] < 1e-6 else None

    return event_of


def by_first_joint(browser: FakeBrowser, angles: np.ndarray) -> Reader:
    """Read the first joint of the arm, whose angle tells which point was solved."""
    node = next(name for name in browser.nodes if name.endswith("/arm/1"))

    def event_of(message: Message) -> int | None:
        if message["type"] != "SetOrientationMessage" or message["name"] != node:
            return None
        w, _, _, z = message["wxyz"]
        return int(np.argmin(np.abs(np.angle(np.exp(1j * (angles - 2 * np.arctan2(z, w)))))))

    return event_of


async def drive(
    server: servers.Server,
    count: int,
    points: np.ndarray,
    reader: Callable,
    prepare: Prepare | None = None,
) -> tuple[list[float], float]:
    """Return the latencies of all students' events and the share of a processor the server used."""
    browsers = [server.browser() for _ in range(count)]
    await asyncio.gather(*(browser.connect() for browser in browsers))
    await asyncio.gather(*(browser.until(lambda b=browser: is_open(b)) for browser in browsers))
    if prepare is not None:
        await asyncio.gather(*(prepare(browser) for browser in browsers))
    await asyncio.sleep(SETTLING)
    before, start = server.cpu(), time.perf_counter()
    phases = np.arange(count) / count / RATE
    runs = (one_student(b, points, reader(b), phase) for b, phase in zip(browsers, phases, strict=True))
    latencies = [latency for of_one in await asyncio.gather(*runs) for latency in of_one]
    load = (server.cpu() - before) / (time.perf_counter() - start)
    await asyncio.gather(*(browser.close() for browser in browsers))
    return latencies, load


def is_open(browser: FakeBrowser) -> bool:
    """Return whether arm and handle are there."""
    return "/target" in browser.nodes and any(name.endswith(("/arm/1", "/arm/0")) for name in browser.nodes)


async def one_student(
    browser: FakeBrowser,
    points: np.ndarray,
    reader: Reader,
    phase: float,
    clock: Callable[[], float] | None = None,
    between: list[float] | None = None,
) -> list[float]:
    """Drag along the points; an event is answered by the first pose that is its own or a later one's.

    Where there is another clock, ``between`` gets what passed on it from each event to its answer.
    """
    sent, latencies = [], []
    also = []

    def note(message: Message, at: float) -> None:
        answered = reader(message)
        if answered is not None:
            new = range(len(latencies), min(answered + 1, len(sent)))
            latencies.extend(at - sent[k] for k in new)
            if clock is not None and between is not None:
                now = clock()
                between.extend(now - also[k] for k in new)

    await asyncio.sleep(phase)
    await browser.drag("start")
    browser.on_message = note
    start = time.perf_counter()
    for k, point in enumerate(points):
        sent.append(time.perf_counter())
        if clock is not None:
            also.append(clock())
        await browser.drag("update", point, (1.0, 0.0, 0.0, 0.0))
        await asyncio.sleep(max(0.0, start + (k + 1) / RATE - time.perf_counter()))
    await browser.drag("end")
    # Of the last few events one may be answered by a pose that reads as the one before.
    await browser.until(lambda: len(latencies) >= sized(0.97, 0.5) * len(sent))
    await asyncio.sleep(LAST)
    return latencies
