"""Numbers of the coils: force, torque now from the vectors, and over a turn in closed form and sampled."""

from __future__ import annotations

from armlab.benches.drive.quantities import prefixed
from armlab.benches.drive.torque.sampled import sampled_of
from armlab.benches.drive.torque.state import Torque
from armlab.kin.drive.coils import ripple
from armlab.session.amounts import amount
from armlab.session.state import State
from armlab.ui.format import mathml, pairs, scientific
from armlab.ui.html import Inside, Markup, tag
from armlab.ui.markup import verdict_box
from armlab.ui.units import units_of

FORCE, TORQUE = r"F=I\,(l\times B)", r"T=r_1\times F_1+r_2\times F_2"
RIPPLE = r"\frac{\tau_{max}-\tau_{min}}{\bar\tau}=\frac{\pi}{2N}\tan\frac{\pi}{4N}"


def now_markup(state: State) -> Markup:
    """Return forces and torque at the present angle."""
    part, found, units = state[Torque], state.derived(sampled_of), units_of(state)
    others = found.now - float(found.single[0])
    rows: list[tuple[Inside, Inside]] = [
        (("force on each side, ", mathml(FORCE)), prefixed(abs(part.coil.force), "N")),
        ("angle of the rotor θ", units.angle(found.angle)),
        (("angle of ", mathml("r_1"), " and ", mathml("F_1")), units.angle(found.between)),
        (("first coil, ", mathml(TORQUE)), prefixed(found.along, "N m")),
    ]
    if part.coils > 1:
        rows.append(("all other coils", prefixed(others, "N m")))
        rows.append(("torque τ now", tag("b", prefixed(found.now, "N m"))))
    return pairs(rows)


def turn_markup(state: State) -> Markup:
    """Return the verdict on the torque over a turn."""
    part, found = state[Torque], state.derived(sampled_of)
    least, largest, mean = part.torques
    if part.coil.peak == 0.0:
        return verdict_box("warn", "No current, no torque", tag("p", "F = I (l × B) is zero at every angle."))
    if not part.switched:
        return verdict_box(
            "no",
            "Mean torque of a turn: 0 N m",
            tag(
                "p",
                f"The torque changes its sign {found.zeros} times a turn, between {prefixed(-largest, 'N m')} and "
                f"{prefixed(largest, 'N m')}. Without a commutator the rotor swings, and does not turn.",
            ),
        )
    head = f"Ripple {amount(100.0 * ripple(part.coils))} %, mean {prefixed(mean, 'N m')}"
    zero = f" It is zero {found.zeros} times a turn, at every multiple of π." if found.zeros else ""
    body = (
        f"The torque is between {prefixed(least, 'N m')} and {prefixed(largest, 'N m')}.{zero} For each ampere the "
        f"mean is k = {prefixed(abs(mean / part.current), 'N m/A')}, the constant of the motor."
    )
    kind = "warn" if part.coils < 3 else "ok"
    return verdict_box(kind, head, tag("p", body))


def check_markup(state: State) -> Markup | None:
    """Return how the formula of the ripple agrees with the sum of the coils; nothing where there is no mean torque."""
    part, found = state[Torque], state.derived(sampled_of)
    if part.coil.peak == 0.0 or not part.switched:
        return None
    sampled = (found.largest - found.least) / abs(found.mean)
    away = abs(sampled - ripple(part.coils))
    return tag(
        "p.dim",
        mathml(RIPPLE),
        f" by the formula. The sum of the coils at 7200 angles gives {amount(100.0 * sampled)} %, which differs by "
        f"{scientific(100.0 * away)} %.",
    )


def model_words() -> Markup:
    """Return what the model leaves out."""
    return tag(
        "p.dim",
        "The field is uniform, and all coils carry the same current, in series. In real motors iron guides the field "
        "along the radius, which makes the tops flatter. ⟦The notes measure θ so that the torque is zero at kπ, as is "
        "done here.⟧",
    )
