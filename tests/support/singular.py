"""Whether what a singularity says is lost is lost."""

import numpy as np

from armlab.kin.velocity.subspaces import task_axes


def assert_is_lost(arm, q, found):
    """Check a direction: of the tool where only that is controlled, else of the point that the sentence names."""
    d, J = found.direction, arm.jacobian(q)
    if d is None:
        return
    if arm.task.rotation == "none":
        d = task_axes(arm, q).T @ (task_axes(arm, q) @ d)
        assert np.abs(d @ J[:3]).max() < 1e-6 * np.abs(J[:3]).max()
    elif found.kind == "dependent":
        rows = J[3:] if found.turning else J[:3]
        assert np.abs(d @ rows).max() < 1e-6 * np.abs(rows).max()
    elif "centre" in found.says or "axes 5 and 6 meet" in found.says:
        J = at_point(arm, q, arm.n - 2, arm.n)
        _, sigma, V_T = np.linalg.svd(J[:3])
        held = V_T[int(np.sum(sigma > 1e-9 * sigma[0])) :].T
        lost = d @ J[3:] @ held if found.turning else d @ J[:3]
        assert np.abs(lost).max() < 1e-6 * np.abs(J[:3]).max()
    else:
        # The last axis of the planar part, as it is moved by the joints before it.
        last = found.joints[-1] - 1
        frames = np.asarray(arm.frames(q))
        frames = frames[:-1] if arm.convention == "standard" else frames[1:]
        J = J[:3] + np.cross(J[3:].T, frames[last, :3, 3] - arm.position(q)).T
        assert np.abs(d @ J[:, :last]).max() < 1e-6 * np.abs(J).max()


def at_point(arm, q, first, last):
    """Return the Jacobian at the point where two axes (0-based) meet."""
    frames = np.asarray(arm.frames(q))
    frames = frames[:-1] if arm.convention == "standard" else frames[1:]
    z, o = frames[:, :3, 2], frames[:, :3, 3]
    second = last - 1
    normal, way = np.cross(z[first], z[second]), o[second] - o[first]
    centre = o[first] + np.cross(way, z[second]) @ normal / (normal @ normal) * z[first]
    J = arm.jacobian(q)
    return np.vstack([J[:3] + np.cross(J[3:].T, centre - arm.position(q)).T, J[3:]])
