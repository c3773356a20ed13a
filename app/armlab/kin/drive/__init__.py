"""Drives of joints: motors, gears and encoders, and what they cause at the tool."""
