"""The Python package: arrays of any kind, shape and layout, made by hypothesis.

    python3 tests/python/arrays.py
"""

import unittest

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as some
from hypothesis.extra import numpy as arrays

import common  # noqa: F401, where the package is found

import signorini

# Every run has the same examples.
EXAMPLES = settings(max_examples=400, deadline=None, derandomize=True)
SIXTEENTHS = some.integers(-64, 64).map(lambda n: n / 16)  # exact in single precision too

# Ways in which an array may lie in memory, with the same entries.
LAYOUTS = (
    lambda a: a,
    np.asfortranarray,
    lambda a: a.astype(np.float32),
    lambda a: a.astype(">f8"),
    lambda a: a.tolist(),
    lambda a: np.repeat(a, 2, axis=0)[::2],
    lambda a: a[::-1].copy()[::-1],
    lambda a: np.frombuffer(b"\0" + a.tobytes(), np.uint8)[1:].view(a.dtype).reshape(a.shape),
)


@some.composite
def problems(draw):
    """A positive definite problem of the plane, its numbers exact in single precision."""
    pairs = draw(some.integers(1, 3))
    roots = np.array(draw(some.lists(SIXTEENTHS, min_size=4 * pairs * pairs,
                                     max_size=4 * pairs * pairs))).reshape(2 * pairs, -1)
    numbers = some.lists(SIXTEENTHS, min_size=pairs, max_size=pairs)
    load = np.array(draw(numbers) + draw(numbers))
    whole = np.rint(4 * roots)
    K = whole @ whole.T + np.eye(2 * pairs)
    return K, load, np.array(draw(numbers)), np.abs(np.array(draw(numbers)))


def anything():
    """Arrays of any kind, with infinite numbers and those that are none, and what is no array at all."""
    kinds = some.one_of(arrays.floating_dtypes(), arrays.integer_dtypes(), arrays.boolean_dtypes(),
                        arrays.complex_number_dtypes(), arrays.unicode_string_dtypes(max_len=3))
    shapes = arrays.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=6)
    return some.one_of(arrays.arrays(kinds, shapes), some.none(), some.text(max_size=3),
                       some.floats(), some.lists(some.floats(), max_size=4))


class Arrays(unittest.TestCase):
    @EXAMPLES
    @given(problems(), some.lists(some.sampled_from(LAYOUTS), min_size=4, max_size=4))
    def test_the_layout_changes_no_bit(self, problem, layouts):
        plain = signorini.solve(*problem)
        given_arrays = [layout(array) for layout, array in zip(layouts, problem)]
        before = [np.array(array, copy=True) for array in given_arrays]
        other = signorini.solve(*given_arrays)
        for name in ("d", "F", "state"):
            np.testing.assert_array_equal(getattr(plain, name), getattr(other, name))
        for array, copy in zip(given_arrays, before):
            np.testing.assert_array_equal(array, copy)

    @EXAMPLES
    @given(problems(), some.integers(0, 3), anything())
    def test_anything_is_refused_in_one_sentence_or_solved(self, problem, place, thing):
        given_arrays = list(problem)
        given_arrays[place] = thing
        try:
            result = signorini.solve(*given_arrays)
        except (ValueError, TypeError, signorini.SignoriniError) as refusal:
            self.assertTrue(str(refusal))
            self.assertNotIn("\n", str(refusal))
        else:
            self.assertTrue(np.isfinite(result.d).all() and np.isfinite(result.F).all())


if __name__ == "__main__":
    unittest.main()
