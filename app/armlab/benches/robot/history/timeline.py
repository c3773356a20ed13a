"""Robots and what led to them, by year: what was new, how they are built, and the models that the lab has of them."""

from __future__ import annotations

from dataclasses import dataclass

from armlab.registry import Registry

LANES = {
    "before": "Before robots",
    "factory": "Factory",
    "research": "Research",
    "space": "Space",
    "people": "Beside people",
    "words": "Words",
}
"""Groups of events, key to title."""

DRIVES = {"": "", "hydraulic": "hydraulic", "electric": "electric", "hand": "the hand of a person"}
"""Drives of the joints, key to words."""


@dataclass(frozen=True)
class Model:
    """An arm of the lab that shows the structure of a robot.

    Attributes
    ----------
    robot : str
        Key of its file.
    says : str
        What is the same, and what is not.
    """

    robot: str
    says: str


@dataclass(frozen=True)
class Event:
    """One entry of the timeline.

    Attributes
    ----------
    key, title : str
    year : int
    lane : str
        One of `LANES`.
    says : str
        What was new.
    joints : str
        Joints from the base to the hand, such as ``"RRPRRR"``; empty where there are none, or none are known.
    drive : str
        One of `DRIVES`.
    models : tuple of Model
    source : str
        Where year and facts are from.
    """

    key: str
    title: str
    year: int
    lane: str
    says: str
    joints: str = ""
    drive: str = ""
    models: tuple[Model, ...] = ()
    source: str = "Course notes⟦, section 1.7⟧"

    @property
    def structure(self) -> str:
        """The joints counted: ``5R 1P``."""
        counts = ((self.joints.count(kind), kind) for kind in "RP")
        return " ".join(f"{count}{kind}" for count, kind in counts if count)


GASPARETTO = "Gasparetto and Scalera, A Brief History of Industrial Robotics in the 20th Century, 2019"

EVENTS: Registry[Event] = Registry(
    "event",
    (
        Event(
            "rur",
            "The word robot",
            1920,
            "words",
            "Karel Čapek's play R.U.R., Rossum's Universal Robots, calls its artificial workers robots, after the "
            "Czech robota, forced labour. They are creatures of flesh, made to be cheap; the machines came later.",
            source="Course notes⟦, section 1.5⟧",
        ),
        Event(
            "asimov",
            "Three laws",
            1942,
            "words",
            "Isaac Asimov writes three laws of robotics down in his story Runaround, and with them the word robotics. "
            "What they decide can be tried under “3 Three laws”.",
            source="Astounding Science Fiction, March 1942⟦; course notes, section 1.6⟧",
        ),
        Event(
            "manipulator",
            "Master and slave manipulator",
            1949,
            "before",
            "Raymond Goertz has an arm for radioactive material patented, which repeats what the hand of a person does "
            "at another one: the mechanics of a robot, and no program.",
            drive="hand",
            source="U.S. patent 2,632,574, filed in 1949",
        ),
        Event(
            "milling",
            "Numerically controlled milling machine",
            1952,
            "before",
            "At MIT punched tape moves the three axes of a milling machine at once: a program and servo motors, and no "
            "hand. Both together make the robot.",
            joints="PPP",
            drive="hydraulic",
            models=(Model("cartesian_3p", "Three sliding joints at right angles, as such a machine has them."),),
            source="MIT Museum⟦; course notes, section 1.7, for the part it has in the origin of robots⟧",
        ),
        Event(
            "unimate",
            "Unimate",
            1961,
            "factory",
            "The first industrial robot, of George Devol and Joseph Engelberger, takes hot castings from a machine of "
            "General Motors. Its six joints give the hand any position and any orientation.",
            "RRPRRR",
            "hydraulic",
            (Model("unimate", "The same joints; all lengths are our choice, since the course gives none."),),
        ),
        Event(
            "stanford",
            "Stanford arm",
            1969,
            "research",
            "Victor Scheinman's arm is driven by electric motors and made to be controlled by a computer. Its three "
            "wrist axes meet in a point, so that its inverse kinematics has a closed form.",
            "RRPRRR",
            "electric",
            (Model("stanford", "Scheinman's arm with the lengths of the textbooks."),),
            GASPARETTO,
        ),
        Event(
            "famulus",
            "KUKA Famulus",
            1973,
            "factory",
            "Six axes with electric motors, where robots in factories were hydraulic and leaked oil.",
            "RRRRRR",
            "electric",
            (Model("kr6r900", "A successor of the same maker, forty years younger: six turning joints, too."),),
            "KUKA, Home of Robotik, 2023",
        ),
        Event(
            "irb6",
            "ASEA IRB-6",
            1973,
            "factory",
            "All joints driven electrically, and controlled by a microprocessor: it could follow a path smoothly, and "
            "polished tubes.",
            "RRRRR",
            "electric",
            (
                Model("scorbot", "A school robot with the same order of five joints; its own lengths."),
                Model("irb140", "A successor: ASEA became a part of ABB. It has a sixth joint."),
            ),
            "Tekniska museet, Stockholm⟦; course notes, section 1.7⟧",
        ),
        Event(
            "t3",
            "Cincinnati Milacron T3",
            1974,
            "factory",
            "“The Tomorrow Tool” is the first robot on the market with a computer as its controller, which lets "
            "it follow a moving part. Hydraulics carry its heavy loads.⟦ The notes say micro-computer; it was a "
            "minicomputer, and the IRB-6 had the microprocessor.⟧",
            "RRRRRR",
            "hydraulic",
            source="Powerhouse Collection, Sydney, 2019/102/1⟦; course notes, section 1.7⟧",
        ),
        Event(
            "puma",
            "First PUMA",
            1978,
            "factory",
            "Unimation develops Scheinman's arm on for General Motors, into the Programmable Universal Machine for "
            "Assembly: light, electric, six turning joints.⟦ Section 1.7 of the notes also dates the PUMA to 1970: "
            "that is eight years too early.⟧",
            "RRRRRR",
            "electric",
            (Model("puma560", "The PUMA 560 of the next year."),),
            GASPARETTO,
        ),
        Event(
            "scara",
            "SCARA",
            1978,
            "factory",
            "Hiroshi Makino's Selective Compliance Assembly Robot Arm yields sideways and is stiff vertically, so "
            "that a peg finds its hole. Hirata's AR-300 is one of the first; from 1981 many makers sell some.",
            "RRPR",
            "electric",
            (Model("scara", "The same joints with the lengths of an Adept Cobra 600: none of the AR-300 are known."),),
            "Makino, Development of the SCARA, 2014⟦; course notes, section 1.7, for Hirata's AR-300⟧",
        ),
        Event(
            "puma560",
            "PUMA 560",
            1979,
            "factory",
            "An arm with waist, shoulder, elbow and a wrist whose axes meet in a point: anthropomorphic. It became the "
            "arm of research and of textbooks.",
            "RRRRRR",
            "electric",
            (Model("puma560", "Lengths as measured at one; the gripper is our choice."),),
        ),
        Event(
            "canadarm",
            "Canadarm",
            1981,
            "space",
            "Fifteen metres long, on the second flight of the space shuttle: on the ground it could not lift itself.",
            "RRRRRR",
            "electric",
            (Model("canadarm2", "Its successor on the space station, with a seventh joint."),),
            "Ingenium, Canada's museums of science and innovation",
        ),
        Event(
            "wabot2",
            "WABOT-2",
            1984,
            "research",
            "The humanoid of Waseda University reads notes with a camera and plays them on an organ with hands and "
            "feet.⟦ WAM-8, as the notes call it, is the name of its arm.⟧",
            source="Takanishi, 1st International Symposium on Roboethics, 2004⟦; course notes, section 1.5⟧",
        ),
        Event(
            "h4",
            "Comau SMART H4",
            1995,
            "factory",
            "A large arm for car factories, such as those of Fiat, to which Comau belonged: fixed in its place, "
            "programmed anew for every model.",
            "RRRRRR",
            "electric",
            source="Course notes⟦, section 1.5⟧",
        ),
        Event(
            "lbr",
            "DLR lightweight robot",
            1995,
            "people",
            "A torque sensor in every joint lets an arm feel a touch; a seventh joint lets its elbow give way while "
            "the hand stays. Both are usual in arms that work beside people.",
            "RRRRRRR",
            "electric",
            (Model("iiwa7", "Its descendant on the market, the KUKA LBR iiwa 7."),),
            "DLR, Institute of Robotics and Mechatronics, LBR I",
        ),
        Event(
            "canadarm2",
            "Canadarm2",
            2001,
            "space",
            "It built the space station and walks over it end over end: both of its ends can be base or hand.",
            "RRRRRRR",
            "electric",
            (Model("canadarm2", "Joints and lengths of the arm in space."),),
            "Canadian Space Agency",
        ),
        Event(
            "spirit",
            "Spirit on its way to Mars",
            2003,
            "space",
            "Launched on 10 June 2003, it landed on 4 January 2004 and drove for six years. Its goals came from Earth; "
            "words that take minutes to arrive cannot steer, so it found its way by itself.⟦ The notes date it to "
            "2002.⟧",
            source="NASA, Mars Exploration Rovers⟦; course notes, section 1.5⟧",
        ),
        Event(
            "ur5",
            "Universal Robots UR5",
            2008,
            "people",
            "The first arm sold to work beside people without a fence: light, slow enough, and it stops at a touch.",
            "RRRRRR",
            "electric",
            (
                Model("ur5e", "Its successor of the e-Series, with the same structure."),
                Model("ur10", "Its larger sister of the same generation; the course computes its eight solutions."),
            ),
            "Universal Robots; first sold to Linatex in December 2008",
        ),
        Event(
            "iso2012",
            "ISO 8373:2012",
            2012,
            "words",
            "The standard says what an industrial robot is, and calls what lacks axes or autonomy a robotic device. "
            "What counts can be tried under “2 Robot or not?”.",
            source="ISO 8373:2012, Robots and robotic devices – Vocabulary, 2.6, 2.8 and 2.9",
        ),
        Event(
            "panda",
            "Franka Panda",
            2017,
            "people",
            "Seven joints with torque sensors for a tenth of the usual price: research and small firms got an arm that "
            "can be guided by the hand.",
            "RRRRRRR",
            "electric",
            (Model("panda", "Table and limits as Franka Emika gives them."),),
            "Deutscher Zukunftspreis 2017",
        ),
        Event(
            "iso2021",
            "ISO 8373:2021",
            2021,
            "words",
            "A robot is now a programmed actuated mechanism with a degree of autonomy that moves itself, moves things, "
            "or brings them into place.⟦ The notes say that this revision introduced the term robotic device; it "
            "stands in the title of that of 2012.⟧",
            source="ISO 8373:2021, Robotics – Vocabulary, 3.1 and 3.5",
        ),
    ),
)
"""Events by key, in the order of years."""


def of_lane(lane: str) -> list[Event]:
    """Return the events of a group, in the order of years."""
    return [event for event in EVENTS.values() if event.lane == lane]
