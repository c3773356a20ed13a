"""All inverse-kinematics solutions: how many of those that anybody finds, and how long it takes."""

import statistics
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

import armlab
import peers
from armlab.kin.arm import Arm
from armlab.kin.ik.general_6r import solve_general
from armlab.kin.ik.solve_all import solve_all
from rounds import sized
from support.solutions import by_many_starts, contains, worst_error

TITLE = "Inverse kinematics: all solutions, against a multistart of 1000 descents; best time of 5"
SEED = 7
ARMS, POSES = sized((200, 20), (2, 2))
STARTS, STARTS_OF_A_LOOP, POSES_OF_A_LOOP = sized((1000, 100, 5), (40, 4, 1))
QUARTERS = (0.0, np.pi / 2, -np.pi / 2)
NAMED = ("puma560", "ur10e", "manseur_doty")

Case = tuple[Arm, np.ndarray]


def measure() -> Iterator[str]:
    rng = np.random.default_rng(SEED)
    cases: dict[str, list[Case]] = {
        f"{ARMS} general 6R, seed {SEED}": [posed(random_6r(rng, structured=False), rng) for _ in range(ARMS)],
        f"{ARMS} structured 6R, seed {SEED}": [posed(random_6r(rng, structured=True), rng) for _ in range(ARMS)],
    }
    for key in NAMED:
        arm = armlab.load(key)
        cases[f"{arm.name}, {POSES} poses"] = [posed(arm, rng) for _ in range(POSES)]
    yield "| arms | solver | found / known | more | largest error | set-up | median | p99 |"
    yield "| --- | --- | --- | --- | --- | --- | --- | --- |"
    for title, some in cases.items():
        known = [by_many_starts(arm, T, STARTS, SEED) for arm, T in some]
        solvers: dict[str, Callable[[Arm, np.ndarray], np.ndarray]] = {
            "Armlab solve_all": lambda arm, T: solve_all(arm, T).q,
            "Armlab solve_general": lambda arm, T: solve_general(arm, T).q,
        }
        for name, solve in solvers.items():
            yield line(title, name, judged(solve, some, known))
        if len({id(arm) for arm, _ in some}) == 1 and peers.is_installed("pinocchio"):
            few = some[:POSES_OF_A_LOOP]
            loop = multistart_of_pinocchio(few[0][0])
            score = judged(loop, few, known, fresh=False)
            yield line(f"{title}: the first {POSES_OF_A_LOOP}", f"pinocchio, {STARTS_OF_A_LOOP} loops", score)


@dataclass
class Score:
    """What a solver did with some poses."""

    found: int = 0
    known: int = 0
    more: int = 0
    error: float = 0.0
    setups: list[float] = field(default_factory=list)
    seconds: list[float] = field(default_factory=list)


def judged(
    solve: Callable[[Arm, np.ndarray], np.ndarray],
    cases: Sequence[Case],
    known: Sequence[np.ndarray],
    fresh: bool = True,
) -> Score:
    """Solve every case; where it counts first with an arm never seen, whose extra time is the set-up."""
    score = Score()
    for (arm, T), expected in zip(cases, known, strict=False):
        if fresh:
            first = timed(solve, replace(arm), T)[1]
            q, seconds = again(solve, arm, T)
            score.setups.append(first - seconds)
        else:
            q, seconds = timed(solve, arm, T)
        score.seconds.append(seconds)
        score.known += len(expected)
        score.found += sum(contains(arm, q, row, 1e-4) for row in expected)
        score.more += sum(not contains(arm, expected, row, 1e-4) for row in q)
        score.error = max(score.error, worst_error(arm, q, T))
    return score


def timed(solve: Callable[[Arm, np.ndarray], np.ndarray], arm: Arm, T: np.ndarray) -> tuple[np.ndarray, float]:
    start = time.perf_counter()
    q = solve(arm, T)
    return q, time.perf_counter() - start


def again(solve: Callable[[Arm, np.ndarray], np.ndarray], arm: Arm, T: np.ndarray) -> tuple[np.ndarray, float]:
    """Return the solutions and the best time of an arm that was solved before: what else runs only adds to it."""
    solve(arm, T)
    rounds = [timed(solve, arm, T) for _ in range(5)]
    return rounds[0][0], min(seconds for _, seconds in rounds)


def line(title: str, name: str, score: Score) -> str:
    """Return a row of the table."""
    seconds = np.array(score.seconds) * 1e3
    setup = f"{statistics.median(score.setups) * 1e3:.0f} ms" if score.setups else "–"
    times = f"{setup} | {np.median(seconds):.2f} ms | {np.quantile(seconds, 0.99):.1f} ms"
    return f"| {title} | {name} | {score.found} / {score.known} | {score.more} | {score.error:.0e} | {times} |"


def random_6r(rng: np.random.Generator, structured: bool) -> Arm:
    """Return six revolute joints with random rows; structured ones have quarter-turn twists and half their lengths."""
    rows = []
    for _ in range(6):
        alpha = float(rng.choice(QUARTERS)) if structured else float(rng.uniform(-np.pi, np.pi))
        a, d = rng.uniform(-1.0, 1.0, 2) * (rng.random(2) > (0.5 if structured else 0.0))
        rows.append(("R", float(a), alpha, float(d), 0.0))
    arm = Arm.from_dh(rows, task="pose")
    # Twists and lengths that leave fewer than six freedoms reach a pose never or in infinitely many ways.
    regular = any(is_regular(arm, rng.uniform(-np.pi, np.pi, 6)) for _ in range(4))
    return arm if regular else random_6r(rng, structured)


def is_regular(arm: Arm, q: np.ndarray) -> bool:
    """Return whether no branches merge nearby, where rounding decides about their number."""
    J = np.asarray(arm.jacobian(q)) / np.array([arm.length_scale] * 3 + [1.0] * 3)[:, None]
    return bool(np.linalg.svd(J, compute_uv=False)[-1] > 2e-3)


def posed(arm: Arm, rng: np.random.Generator) -> Case:
    """Return the arm with a random pose inside its limits, a regular one."""
    q = rng.uniform(*arm.limits.T)
    return (arm, np.asarray(arm.fk(q))) if is_regular(arm, q) else posed(arm, rng)


def multistart_of_pinocchio(arm: Arm) -> Callable[[Arm, np.ndarray], np.ndarray]:
    """Return how its users would look for all solutions: its damped loop from many starts."""
    pinocchio = peers.Pinocchio(replace(arm, limits=np.tile([-np.pi, np.pi], (arm.n, 1))))

    def solve(arm: Arm, T: np.ndarray) -> np.ndarray:
        found: list[np.ndarray] = []
        for k in range(STARTS_OF_A_LOOP):
            q = pinocchio.solve(T, np.random.default_rng(k))
            if worst_error(arm, q[None], T) < 1e-5 and not contains(arm, np.array(found), q, 1e-3):
                found.append(q)
        return np.array(found).reshape(-1, arm.n)

    return solve
