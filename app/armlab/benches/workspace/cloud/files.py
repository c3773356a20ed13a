"""A sampled workspace as files for other programs: points with colours and values as PLY, with joint values as CSV."""

from __future__ import annotations

import io

import numpy as np

from armlab.benches.workspace.cloud.samples import Sampled
from armlab.kin.workspace.measures import measure_named


def as_ply(found: Sampled) -> bytes:
    """Return the drawn samples as a binary PLY file: x, y, z in metres in the world, and the measure.

    References
    ----------
    Turk, *The PLY Polygon File Format*, 1994.
    """
    shown, asked = found.shown, found.question
    name = " ".join(asked.arm.name.split()) or "an arm"  # a comment is one line, which a name need not be
    head = (
        "ply\nformat binary_little_endian 1.0\n"
        f"comment workspace of {name}, first {len(shown.points)} of {found.done} samples, "
        f"seed {asked.seed}, metres\n"
        f"element vertex {len(shown.points)}\nproperty float x\nproperty float y\nproperty float z\n"
        f"property float {asked.measure}\nend_header\n"
    )
    table = np.column_stack([shown.points, shown.values]).astype("<f4")
    return head.encode("ascii", "replace") + table.tobytes()


def as_csv(found: Sampled) -> str:
    """Return the drawn samples as CSV: x, y, z in metres, the measure, and the joint values in rad and m."""
    shown, asked = found.shown, found.question
    unit = measure_named(asked.measure).unit(asked.arm)
    names = [f"q{i + 1} ({'rad' if row.revolute else 'm'})" for i, row in enumerate(asked.arm.rows)]
    head = ["x (m)", "y (m)", "z (m)", f"{asked.measure} ({unit})" if unit else asked.measure, *names]
    text = io.StringIO()
    text.write(",".join(head) + "\n")
    np.savetxt(text, np.column_stack([shown.points, shown.values, shown.q]), fmt="%.7g", delimiter=",")
    return text.getvalue()
