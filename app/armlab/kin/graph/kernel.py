"""A set of formulas, compiled at first use as scalar Python or as code for arrays."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from armlab.kin.graph.expression import Graph, Number
from armlab.kin.graph.scalar import compile_scalar
from armlab.kin.graph.tape import Tape


class Kernel:
    """Formulas of a graph with their two back-ends.

    Parameters
    ----------
    graph : Graph
    outputs : sequence of Number
        The expressions that are computed.
    inputs : int
        Number of variables.
    """

    def __init__(self, graph: Graph, outputs: Sequence[Number], inputs: int) -> None:
        self.graph, self.outputs, self.inputs = graph, list(outputs), inputs
        self._tapes: dict[np.dtype[np.floating], Tape] = {}

    @cached_property
    def scalar(self) -> Callable[..., tuple[float, ...]]:
        """A function of ``inputs`` floats that returns a tuple of floats."""
        return compile_scalar(self.graph, self.outputs, self.inputs)

    def __getstate__(self) -> dict[str, object]:
        """Leave out compiled functions, which cannot be pickled."""
        return {name: value for name, value in vars(self).items() if name != "scalar"} | {"_tapes": {}}

    def batch(self, x: NDArray[np.floating], out: NDArray[np.floating]) -> None:
        """Evaluate rows ``x`` (N, inputs) into ``out`` (N, outputs), in the precision of ``out``."""
        tape = self._tapes.get(out.dtype)
        if tape is None:
            tape = self._tapes[out.dtype] = Tape(self.graph, self.outputs, self.inputs, out.dtype)
        tape.run(x, out)
