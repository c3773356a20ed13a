"""The terms of the glossary: in order, and with the formulas of the notes."""

import pytest

from armlab.benches.help.glossary.terms import TERMS
from armlab.content.languages import keys, words_in
from armlab.content.words import has_words


def test_terms_are_in_alphabetical_order():
    names = [term.name.casefold() for term in TERMS]
    assert names == sorted(names)


def test_the_damping_is_that_of_the_notes_and_of_the_lab():
    (damped,) = (term for term in TERMS if term.name == "Damped least squares")
    assert damped.symbol == r"J^T(JJ^T+\lambda I)^{-1}"


@pytest.mark.parametrize("language", keys()[1:])
def test_the_words_by_which_a_term_is_searched_are_known_in_the_language(language):
    words, names = words_in(language), [name for term in TERMS for name in (term.name, *term.others)]
    assert [name for name in names if words.find(name) is None and has_words(name)] == []
