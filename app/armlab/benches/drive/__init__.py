"""The tab of drives and sensors (chapter 2 of the notes), with one folder for each page."""
