"""Models of drives: power, the torque of coils, and the DC motor (notes 2.0 and 2.1).

They are the models of chapter 2 of the course, pure mathematics as the rest of the core, and they stand beside the
kinematics: no model here knows an arm, and the masses of arms stay out of the lab. A motor sees its load as a torque
over time that somebody has given.

>>> from armlab.kin.drive import DcMotor
>>> motor = DcMotor(R=1.2, L=0.002, k=0.05, J=1e-4, F=2e-5)
>>> current, speed = motor.steady(voltage=12.0, load=0.1)
>>> round(float(speed), 3)
190.174
"""
