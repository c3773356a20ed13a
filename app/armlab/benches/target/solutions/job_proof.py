"""The requested search from thousands of random starts."""

from __future__ import annotations

from dataclasses import replace

from armlab.benches.target.solutions.proof import Proof, proved
from armlab.benches.target.solutions.state import Solutions, shown_proof
from armlab.session.job import Job, Wanted
from armlab.session.state import State


def wanted(state: State, panels: frozenset[str]) -> Wanted | None:
    """Return the requested proof until it is done, while the target stays."""
    proof = state.derived(shown_proof) if state[Solutions].proof is not None else None
    if proof is None or proof.done:
        return None
    return Wanted(proof.solutions, Proof(proof.question, proof.solutions))


def delivered(state: State, asked: Proof, found: Proof) -> State:
    """Return the state with the proof so far, if it is still wanted."""
    part = state[Solutions]
    if part.proof is None or part.proof.solutions is not asked.solutions or found.starts < part.proof.starts:
        return state
    return state.replace(replace(part, proof=found))


JOB = Job("proof", "The search from random starts", wanted, proved, delivered)
