"""The panel of the page Timing laws."""
