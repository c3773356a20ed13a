"""The panel of the page Identities."""
