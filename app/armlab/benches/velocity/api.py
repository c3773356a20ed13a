"""Parts of the tab Velocity for other tabs: the present joint speeds, and the torques that balance the wrench."""

from armlab.benches.velocity.speeds.motion import speeds_of
from armlab.benches.velocity.speeds.state import Velocity
from armlab.benches.velocity.statics.state import Statics, balance

__all__ = ["Statics", "Velocity", "balance", "speeds_of"]
