"""Robots and lessons: files are read into typed and checked objects."""
