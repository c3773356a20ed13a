"""The page Import & export of the lab."""

from armlab.page import Page

PAGE = Page(
    __name__,
    "motion_files",
    "Import & export",
    "FILE_EXPORT",
    45,
    tab="motion",
    about=(
        "S6.0-pipeline",
        "export",
        "import",
        "CSV",
        "JSON",
        "Python",
        "recording",
        "samples of a motion",
        "MATLAB",
    ),
)
