"""The page Glossary of the lab."""

from armlab.benches.help.glossary.terms import TERMS
from armlab.page import Page

PAGE = Page(
    __name__,
    "glossary",
    "Glossary",
    "VOCABULARY",
    91,
    tab="help",
    about=("terms", "definitions", "meaning", *(f"what {name} means" for t in TERMS for name in (t.name, *t.others))),
)
