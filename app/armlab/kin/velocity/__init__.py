"""Velocities: rigid bodies, rates of angles, Jacobians and their derivatives (sections 1.2 and 5.1 of the notes)."""
