"""What the page Pick & place draws and shows."""
