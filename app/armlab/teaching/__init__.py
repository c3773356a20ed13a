"""Lessons as they are played, the way through a course, assignments, and work that is handed in and checked."""
