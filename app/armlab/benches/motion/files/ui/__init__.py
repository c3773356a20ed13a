"""The panel of the page Import & export."""
