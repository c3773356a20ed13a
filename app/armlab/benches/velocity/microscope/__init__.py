"""The page "Microscope"."""
