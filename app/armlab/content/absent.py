"""Topics of robotics that the lab does not have, so that whoever looks for one is told, and does not look on."""

from __future__ import annotations

from collections.abc import Mapping

from armlab.content.languages import ENGLISH, words_in
from armlab.content.query import plain

ABSENT: Mapping[str, tuple[str, ...]] = {
    "The lab has no dynamics of arms: links have no masses, and torques are those of a load at rest (page Statics).": (
        *("dynamics", "dynamic model", "inertia matrix", "mass matrix", "newton euler", "euler lagrange"),
        *(
            "coriolis",
            "gravity compensation",
            "computed torque",
            "torque control",
            "impedance control",
            "force control",
        ),
    ),
    "The lab has no obstacles: nothing checks for collisions, and no path is searched around them.": (
        *("collision", "collisions", "obstacle", "obstacles", "path planner", "rrt", "prm", "potential field"),
    ),
    "The lab has no mobile robots: every arm stands on a fixed base.": (
        *("mobile robot", "mobile robots", "mobile base", "wheeled robot", "odometry", "slam", "legged robot", "drone"),
    ),
    "The lab has no PID controller: its laws are proportional, with feed-forward.": ("pid", "pi controller"),
    "The lab has no cameras and no images.": (
        *("computer vision", "visual servoing", "image processing", "camera calibration", "hand eye calibration"),
    ),
    "The lab has no interface to ROS or to real robots.": ("ros", "moveit", "urdf", "gazebo", "real robot"),
}
"""Sentences, each with the words by which such a topic is looked for."""


def absent(query: str, language: str = ENGLISH) -> str:
    """Return a sentence where a query, in a language or in English, asks for what the lab does not have.

    It is empty for any other.

    >>> absent("obstacle avoidance"), absent("error dynamics")
    ('The lab has no obstacles: nothing checks for collisions, and no path is searched around them.', '')
    """
    asked, said = f" {plain(query)} ", words_in(language)

    def names(words: tuple[str, ...]) -> bool:
        return any(f" {plain(name)} " in asked for word in words for name in (word, said(word)))

    return "" if names(HAS) else next((says for says, words in ABSENT.items() if names(words)), "")


HAS = ("error dynamics", "dynamics of the error", "motor dynamics", "dc motor")
"""Words that contain one of those above and mean what the lab has."""
