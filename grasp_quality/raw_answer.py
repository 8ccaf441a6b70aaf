# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""What a solver says, before anything of it is believed."""

from dataclasses import dataclass

from grasp_quality.arrays import Array
import numpy as np


@dataclass(frozen=True, eq=False)
class RawAnswer:
    """
    A solver's last iterate, or its certificate.

    Attributes
    ----------
    shares : (k, 4) array
        Local forces [t1/mu, t2/mu, n, m_n/gamma] as shares of the caps.
    values : (t,) array
        Variables of the virtual contact.
    multipliers : (equations,) array
        lambda, and nu behind it.
    status : str
        The solver's own word.

    """

    shares: Array
    values: Array
    multipliers: Array
    status: str

    @property
    def solved(self) -> bool:
        """Whether the solver met its tolerances, with numbers; almost solved is not solved."""
        # no proof sees an infinite alpha: it holds alpha to the upper bound
        return self.status == 'Solved' and all(
            np.isfinite(part).all() for part in (self.shares, self.values, self.multipliers))
