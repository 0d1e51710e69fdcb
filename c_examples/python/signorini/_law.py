"""The law of friction of the caller: mu, g, a law with its numbers, or nothing."""

from ._arrays import per_pair, several
from ._constants import Law, chosen


class Friction:
    """The Law, and the name and the numbers that the caller gives for it."""

    def __init__(self, mu, g, law, friction):
        if mu is not None and g is not None:
            raise ValueError("mu and g are both given: give mu for Coulomb friction, g for given "
                             "thresholds (Tresca), or neither for no friction")
        if law is None and friction is not None:
            raise ValueError("friction is given without a law: give law, or mu or g")
        self.is_given = not (mu is None and g is None and law is None)
        if law is None:
            self.law = (Law.COULOMB if mu is not None else
                        Law.TRESCA if g is not None else Law.FRICTIONLESS)
            self.name, self.values = ("mu", mu) if g is None else ("g", g)
            return
        if mu is not None or g is not None:
            raise ValueError("law is given, and mu or g: give the numbers of the law as friction")
        self.law = chosen("law", Law, law)
        self.name, self.values = "friction", friction
        name = self.law.name.lower()
        if not self.law.numbers and friction is not None:
            raise ValueError(f"friction is given, and the law is {name}: give another law")
        if self.law.numbers and friction is None:
            raise TypeError(f"friction is None: give the numbers of the law {name}")

    def numbers(self, pairs, dim, cases=None):
        """The numbers in the library's layout; None without friction."""
        if self.law.numbers > 1:
            return several(self.name, self.values, self.law.numbers, pairs, dim, cases)
        return per_pair(self.name, self.values, pairs, dim, cases, optional=True)
