"""One file a job; each holds a constant ``JOB``."""
