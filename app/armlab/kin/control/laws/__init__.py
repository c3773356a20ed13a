"""One file a control law; each holds a constant ``LAW``."""
