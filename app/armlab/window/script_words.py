"""The texts that scripts of the page say by themselves, without the lab; a test compares them with the scripts."""

SCRIPT_WORDS = (
    "The connection to the lab is lost. The page keeps trying to reconnect; your work is kept.",
    "The lab does not answer. If it is open in many windows, close some and load this page again.",
    "{arm} is on its way …",
    "Back: V or Esc",
    "Topics",
    "Plots",
    "Height of the plots",
    "Plots shown",
    "The plots in place of the scene",
    "⤢ Full view",
    "Close the plots",
    "Close (X or Esc)",
    "Drag: move the arm. Shift + drag, wheel: zoom",
    "Drag, wheel: zoom",
    "There is nothing to plot at present.",
    "Whole curves again (double click)",
    "Reset zoom",
    "Save {title} as {kind}",
    "Cursor of {title}",
    "not in the plot",
)
