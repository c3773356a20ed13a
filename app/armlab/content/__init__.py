"""Robots and lessons: files in, typed and validated objects out."""
