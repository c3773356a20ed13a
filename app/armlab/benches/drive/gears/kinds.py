"""Kinds of transmissions in robots, with typical numbers.

The numbers are ranges of what is usual in machines of the size of a robot arm; a data sheet may say something else.
"""

from __future__ import annotations

from dataclasses import dataclass

from armlab.registry import Registry


@dataclass(frozen=True)
class Kind:
    """A kind of transmission.

    Attributes
    ----------
    key, title : str
    ratio, efficiency, play, drives_back : str
        Typical ratio of one stage, efficiency in percent, backlash, and whether the load can turn the motor.
    use : str
        What it is used for.
    trouble : str
        What it is bad at.
    """

    key: str
    title: str
    ratio: str
    efficiency: str
    play: str
    drives_back: str
    use: str
    trouble: str


KINDS = Registry(
    "kind of transmission",
    (
        Kind(
            "spur",
            "Spur gears",
            "1–8",
            "97–99",
            "3–20′",
            "yes",
            "Parallel shafts: they change speed and torque, and carry the motion to a parallel axis. Large ratios take "
            "several stages.",
            "Deformation of the teeth, backlash in every mesh, noise.",
        ),
        Kind(
            "bevel",
            "Bevel gears",
            "1–5",
            "95–98",
            "4–20′",
            "yes",
            "Shafts that meet at an angle, as in a wrist whose motors sit in the forearm.",
            "As of spur gears, and the wheels push each other apart along their axes.",
        ),
        Kind(
            "screw",
            "Lead screw",
            "2–20 mm a turn",
            "20–50",
            "0.05–0.3 mm",
            "mostly no",
            "It turns a rotation into a translation, for prismatic joints. With plain threads the load stays where it "
            "is without a brake.",
            "Friction, elasticity, backlash of the nut.",
        ),
        Kind(
            "ball",
            "Ball screw",
            "5–50 mm a turn",
            "85–95",
            "0–0.05 mm",
            "yes",
            "A lead screw with balls between screw and nut, for prismatic joints that must be fast or accurate.",
            "A vertical axis needs a brake; cost, and noise of the balls.",
        ),
        Kind(
            "worm",
            "Worm gear",
            "5–100",
            "40–90",
            "5–30′",
            "seldom",
            "A large ratio in one stage between shafts that cross at right angles.",
            "The teeth slide on each other: friction, heat, wear. The larger the ratio, the worse.",
        ),
        Kind(
            "belt",
            "Toothed belt",
            "1–6",
            "95–98",
            "almost none",
            "yes",
            "The motor may sit far from the joint, near the base, so that the arm has less to carry.",
            "The belt gives way like a spring, and must be kept tight.",
        ),
        Kind(
            "chain",
            "Chain",
            "1–6",
            "95–98",
            "some slack",
            "yes",
            "As a belt, for larger forces.",
            "Its mass makes it swing at high speed; it gets longer as it wears.",
        ),
        Kind(
            "harmonic",
            "Harmonic drive",
            "30–200",
            "60–85",
            "below 1′",
            "hardly",
            "A very large ratio in one small stage on the axis of the joint: the gear of wrists and of light arms.",
            "Elasticity: the flexspline winds up under load, and the joint may swing.",
        ),
        Kind(
            "shaft",
            "Shaft and couplings",
            "1",
            "98–99",
            "almost none",
            "yes",
            "It carries the turn along the inside of a link; flexible couplings take up what is not in line.",
            "A long shaft twists like a spring.",
        ),
    ),
)
"""Kinds by key, in the order of the table."""
