"""The page Export of the lab."""

from armlab.page import Export, Page

PAGE = Page(
    __name__,
    "motion_files",
    "Import & export",
    "FILE_EXPORT",
    43,
    tab="motion",
    page="Export",
    about=(
        "export",
        "import",
        "recording",
        "samples of a motion",
        "MATLAB",
        "save a motion",
        "open a motion",
    ),
    exports=(
        Export("csv", "Samples of the motion as CSV", ("CSV", "joint values over time", "table", "MATLAB")),
        Export("python", "Motion as a Python script", ("code", "program")),
        Export("json", "Plan as JSON", ("waypoints", "save the plan")),
        Export("html", "Recording as a web page", ("video", "animation", "film", "HTML")),
        Export("viser", "Recording for the player of viser", ("video",)),
        Export("read-motion", "Read a motion or a plan", ("import", "load", "open", "CSV", "JSON")),
    ),
)
