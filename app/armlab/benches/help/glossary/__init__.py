"""The page Glossary of the lab."""

from armlab.content.glossary import TERMS
from armlab.page import Page

PAGE = Page(
    __name__,
    "glossary",
    "Glossary",
    "VOCABULARY",
    91,
    tab="help",
    about=("terms", "definitions", "meaning", *(name for term in TERMS for name in (term.name, *term.others))),
    always=True,
)
