"""Sensors: encoders, the speed by counting, and what makes a measurement accurate (notes, sections 1.7 and 2.3)."""
