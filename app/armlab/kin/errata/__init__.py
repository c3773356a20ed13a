"""The errata of the notes, run: the printed and the correct form of each, compared with an independent judge.

A trial stands in `trials` under the id of its erratum. The words, what is printed and why it is wrong, are in
`armlab.content.errata`.

>>> from armlab.kin.errata import run, trials
>>> found = run(trials()["1.58"], seed=1)
>>> found.seen, found.worst_correct < 1e-12
(20, True)
"""

from __future__ import annotations

from functools import cache

from armlab.kin.errata.trial import POINTS, Forms, Quiet, Run, Trial, in_pieces, run
from armlab.registry import Registry

__all__ = ["POINTS", "Forms", "Quiet", "Run", "Trial", "in_pieces", "run", "trials"]


@cache
def trials() -> Registry[Trial]:
    """Return all trials by the ids of their errata; they are imported with the first call, since they need SciPy."""
    from armlab.kin.errata import (
        frames,
        introduction,
        inverse_kinematics,
        inverse_velocity,
        orientation,
        planning,
        splines_and_control,
        velocity,
    )

    modules = (
        introduction,
        orientation,
        frames,
        inverse_kinematics,
        velocity,
        inverse_velocity,
        planning,
        splines_and_control,
    )
    return Registry("trial", [trial for module in modules for trial in module.TRIALS])
