"""The page "sliders"."""
