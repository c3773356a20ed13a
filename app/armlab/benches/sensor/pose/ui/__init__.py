"""Everything that the page Pose accuracy draws."""
