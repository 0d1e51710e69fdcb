"""The law of friction of the caller: mu, g or neither."""

from ._constants import Law


def law_of(mu, g):
    """The Law, and the name and values of its numbers."""
    if mu is not None and g is not None:
        raise ValueError("mu and g are both given: give mu for Coulomb friction, g for given "
                         "thresholds (Tresca), or neither for no friction")
    if mu is not None:
        return Law.COULOMB, "mu", mu
    if g is not None:
        return Law.TRESCA, "g", g
    return Law.FRICTIONLESS, "mu", None
