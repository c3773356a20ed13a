"""Robots and what is none: definitions as lists of what a thing must have, and things with what they have."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.registry import Registry

FEATURES = {
    "manipulator": "links and joints that move objects",
    "automatic": "work without a person who steers",
    "reprogrammable": "motions that another program changes",
    "multipurpose": "more than one kind of task",
    "axes": "three or more programmable axes",
    "industry": "use in industrial automation",
    "perceives": "perception of its surroundings",
    "acts": "action in the physical world",
}
"""Features, key to words."""


@dataclass(frozen=True)
class Definition:
    """A definition of a robot, or of what a robot does.

    Attributes
    ----------
    key, title : str
    asks : str
        The question about a thing.
    needs : tuple of str
        Keys of `FEATURES`, all of which it must have.
    says : str
        What is to be known of the definition.
    source : str
    """

    key: str
    title: str
    asks: str
    needs: tuple[str, ...]
    says: str
    source: str


DEFINITIONS: Registry[Definition] = Registry(
    "definition",
    (
        Definition(
            "iso",
            "ISO 8373",
            "An industrial robot?",
            ("manipulator", "automatic", "reprogrammable", "multipurpose", "axes", "industry"),
            "The standard's industrial robot stands in its place or on a vehicle; what lacks axes or autonomy is a "
            "robotic device. Service robots and medical robots have definitions of their own.",
            "ISO 8373:2012, 2.9; almost the same words in ISO 8373:2021, 3.6",
        ),
        Definition(
            "ria",
            "RIA",
            "A robot?",
            ("manipulator", "automatic", "reprogrammable", "multipurpose"),
            "The Robot Institute of America, later the Robotic Industries Association, asks neither for a number of "
            "axes nor for a factory.⟦ That a robot takes information from its surroundings, which the notes add, is "
            "what it asks of the highest of its four classes of robots. Its first name is Robot, not Robotic.⟧",
            "Robot Institute of America, about 1980",
        ),
        Definition(
            "loop",
            "Perception and action",
            "Does it close the loop?",
            ("automatic", "perceives", "acts"),
            "Percept, action, percept: what it perceives decides what it does, and what it does changes what it "
            "perceives next. This says more of how a machine behaves than of how it is built.",
            "Course notes⟦, section 1.4.2⟧",
        ),
    ),
)


@dataclass(frozen=True)
class Thing:
    """A thing that may be a robot.

    Attributes
    ----------
    key, title : str
    has : frozenset of str
        Keys of `FEATURES`.
    """

    key: str
    title: str
    has: frozenset[str]

    def lacks(self, definition: Definition) -> tuple[str, ...]:
        """Return what the definition asks for and the thing does not have, in the order of the definition."""
        return tuple(each for each in definition.needs if each not in self.has)


def _thing(key: str, title: str, *has: str) -> Thing:
    return Thing(key, title, frozenset(has))


ARM = ("manipulator", "automatic", "reprogrammable", "multipurpose", "axes", "industry", "acts")
"""Features of an industrial arm that repeats what it was taught."""

THINGS: Registry[Thing] = Registry(
    "thing",
    (
        _thing("welder", "Arm of six joints that repeats taught welds", *ARM),
        _thing("picker", "SCARA that picks what its camera sees", *ARM, "perceives"),
        _thing("gantry", "Two-axis loader, programmable", *(set(ARM) - {"axes"})),
        _thing("stops", "Loader that runs between fixed stops", "manipulator", "automatic", "industry", "acts"),
        _thing("mill", "Milling machine with five axes", "automatic", "reprogrammable", "axes", "industry", "acts"),
        _thing("slave", "Manipulator steered by a hand elsewhere", "manipulator", "multipurpose", "acts"),
        _thing(
            "rover",
            "Rover on Mars with an arm",
            *(set(ARM) - {"industry"}),
            "perceives",
        ),
        _thing("drone", "Drone that follows a coast by camera", "automatic", "reprogrammable", "perceives", "acts"),
        _thing("car", "Car that drives itself", "automatic", "perceives", "acts"),
        _thing("washer", "Washing machine that weighs its load", "automatic", "perceives", "acts"),
        _thing("cash", "Cash machine", "automatic", "acts"),
        _thing("bot", "Program that fills in forms on a web page", "automatic", "reprogrammable", "multipurpose"),
        _thing("voice", "Voice assistant that answers questions", "automatic", "multipurpose", "perceives"),
    ),
)
"""Things by key."""


def fulfils(thing: str, definition: str) -> bool:
    """Return whether a thing has all that a definition asks for, both by key."""
    return not THINGS[thing].lacks(DEFINITIONS[definition])
