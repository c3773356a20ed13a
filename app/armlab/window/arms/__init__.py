"""The dialog over the scene in which an arm is chosen from pictures, or a new one is made."""
