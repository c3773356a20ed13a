"""The dock of the lesson."""
