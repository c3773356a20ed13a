"""The terms of the glossary: in order, and with the formulas of the notes."""

from armlab.benches.help.glossary.terms import TERMS


def test_terms_are_in_alphabetical_order():
    names = [term.name.casefold() for term in TERMS]
    assert names == sorted(names)


def test_the_damping_is_that_of_the_notes_and_of_the_lab():
    (damped,) = (term for term in TERMS if term.name == "Damped least squares")
    assert damped.symbol == r"J^T(JJ^T+\lambda I)^{-1}"
