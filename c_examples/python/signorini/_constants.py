"""The constants of signorini.h, one family each."""

from enum import IntEnum, IntFlag

ABI_VERSION = 3  # of the signorini.h that this package is written for


class Status(IntEnum):
    """Status that a call returned. Below 0 it is an error; -k: the k-th argument of the C call."""

    SOLVED = 0
    ITERATION_LIMIT = 1
    TIME_LIMIT = 2
    CANCELLED = 3
    NO_EQUILIBRIUM = 4
    STALLED = 5
    NOT_A_SOLUTION = 6
    NOT_PROVED = 7
    MEMORY_LIMIT = 8
    INTERNAL = -1000
    OUT_OF_MEMORY = -1001
    FILE = -1002


class State(IntEnum):
    """State of a pair."""

    OPEN = 0
    SLIP = 1
    STICK = 2


class Law(IntEnum):
    """Law of friction.  numbers: how many it has for each pair."""

    def __new__(cls, value, numbers):
        member = int.__new__(cls, value)
        member._value_, member.numbers = value, numbers
        return member

    # From the table of the library (tests/sources/bindings.rs)
    FRICTIONLESS = 0, 0
    COULOMB = 1, 1
    TRESCA = 2, 1
    COHESIVE = 3, 3
    ORTHOTROPIC = 4, 3
    ORTHOTROPIC_COLLINEAR = 5, 3
    BY_PAIR = 6, 4
    TIED = 7, 0


class Method(IntEnum):
    """How to solve."""

    AUTO = 0
    SOR_NESTED = 1
    SOR_DIAGONAL = 2
    LEMKE = 3
    BLOCK_PIVOTING = 4
    NEWTON = 5
    PATH = 6


START_PREVIOUS = 2  # settings.warm_start: each case starts from the solution of the one before


class Search(IntEnum):
    """Search for other solutions."""

    OFF = 0
    OTHERS = 1


class Uniqueness(IntEnum):
    """Knowledge about other solutions."""

    NOT_KNOWN = 0
    UNIQUE = 1
    SEVERAL = 2


class Fallback(IntEnum):
    """Why the method that was tried first did not end the call."""

    NONE = 0
    CYCLE = 1
    SINGULAR = 2
    UNSTABLE = 3
    INACCURATE = 4


class Remark(IntFlag):
    """Remark on data that are legal and often a mistake.

    GAPS_NEGATIVE: every finite gap is negative: interference everywhere, or the sign is turned round.
    FRICTION_LARGE: a coefficient of friction is above 10: percent, or another array.
    FREE_MOTION: without friction the bodies may move without any force, d is one of many; a support
    may be missing.
    HELD_BY_ROUNDING: only rounding of K holds a body, d is a million times what the loads ask for.
    NEEDS_LOW_PART: d rounded to doubles misses the tolerance, d + d_low meets it.
    GAPS_PASSED: the penetration is not small beside gaps and normal displacements, as bodies are soft
    beside the loads; forces may be wrong: ask for a smaller tolerance.
    """

    GAPS_NEGATIVE = 1
    FRICTION_LARGE = 2
    FREE_MOTION = 4
    HELD_BY_ROUNDING = 8
    NEEDS_LOW_PART = 16
    GAPS_PASSED = 32


class Proof(IntEnum):
    """Is a solution proved to exist?"""

    NOT_ASKED = 0
    PROVED = 1
    NOT_PROVED = 2


class Triangle(IntEnum):
    """Which entries a sparse matrix holds."""

    LOWER = 0
    UPPER = 1
    FULL = 2


class ModelKind(IntEnum):
    """How a model solves its load cases."""

    STIFFNESS = 0
    FULL_SPACE = 1
    OPERATOR = 2
    FLEXIBILITY = 3


class Pairing(IntEnum):
    """How surfaces are paired."""

    DUAL_MORTAR = 0
    NODE_TO_SURFACE = 1


class Normals(IntEnum):
    """Whose normals pairs from surfaces have."""

    AVERAGED = 0
    FACES = 1


class Rims(IntEnum):
    """Fate of slave nodes with little of the master over them."""

    FOLD = 0
    KEEP = 1
    FOLD_LITTLE = 2


class Obstacle(IntEnum):
    """Kind of a rigid obstacle, or of the true shape of a side."""

    PLANE = 0
    CYLINDER = 1
    SPHERE = 2
    FACES = 3
    CONE = 4
    TORUS = 5


class Problem(IntEnum):
    """Kind of the problem in a file."""

    CONTACT = 0
    LCP = 1


def member(family, value):
    """The member of a family with this value; the number itself if there is none."""
    try:
        return family(value)
    except ValueError:
        return int(value)


def chosen(name, family, value):
    """The member of a family that the caller names by itself, its number or its name."""
    words = [each.name.lower() for each in family]
    try:
        return family[value.upper()] if value in words else family(value)
    except ValueError:
        raise ValueError(f"{name} is {value!r}, not one of {', '.join(words)}") from None
