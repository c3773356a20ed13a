"""The core: kinematics, and the course's models of drives; NumPy and SciPy only, no files, clock, plots or globals.

Joints have their numbers in the books: what is called ``joint``, ``joints`` or ``held``, and every sentence, counts
from 1. Places in an array count from 0, and say so. No object means both by one name.
"""
