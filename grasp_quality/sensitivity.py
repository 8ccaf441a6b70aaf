# Copyright 2026 The grasp_quality authors
# SPDX-License-Identifier: Apache-2.0
"""
What the multipliers say about single contacts: worth of friction, and which one limits the task.

``h`` (k, 4) is G_i^T lambda of every contact, in the coordinates [t1, t2, n, m_n]
(docs/derivations.md).
"""

from grasp_quality.contact import ContactModel
import numpy as np

NEGLIGIBLE = 1e-6  # share of alpha below which a cap is worth nothing to the task


def friction_worth(grasp, h):
    """Worth of the friction part of each contact at normal force one, (k,)."""
    t1, t2, _, moment = (h * grasp.scales).T
    return np.sqrt(t1 * t1 + t2 * t2 + moment * moment)


def friction_slope(grasp, h):
    """Slope of the worth of each contact by mu at normal force one, (k,); 0 in an FPC contact."""
    mu, along = grasp.scales[:, 0], friction_worth(grasp, h)
    square = h[:, 0] ** 2 + h[:, 1] ** 2
    slope = np.divide(mu * square, along, where=along > 0.0, out=np.sqrt(square))
    if not mu.all():  # no friction yet, or a model that has none
        slope *= [m is not ContactModel.FPC for m in grasp.contacts.models]
    return slope


def limit(worth, alpha):
    """Index of the contact whose cap is worth most, of all (k,); None when none is."""
    best = int(np.argmax(worth))
    return best if worth[best] > NEGLIGIBLE * max(alpha, 1e-300) else None


def reason(grasp, h, i):
    """Tell whether friction is most of what a stronger press of contact i is worth."""
    return 'slip' if friction_worth(grasp, h)[i] >= abs(h[i, 2]) else 'cap'
