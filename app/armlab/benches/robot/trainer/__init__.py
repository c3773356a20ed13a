"""The page "trainer"."""
