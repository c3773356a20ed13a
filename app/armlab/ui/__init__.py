"""The user interface: the only part of Armlab that knows viser. It computes no kinematics; it shows and posts."""
