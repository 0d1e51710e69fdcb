"""Models of which the host gives products and solutions alone."""

import ctypes

import numpy as np

from ._arrays import at, components
from ._structures import HeldFunction, Operator, ProductFunction, sized


class HostFunctions:
    """Functions of the host as the library calls them. None of what they raise may cross the library: it goes on
    where a `with` on this object ends."""

    def __init__(self, dim, pairs, stiffness, inverse, held, units):
        self._size, self._error = dim * pairs, None
        self._units = components("units", units, pairs, dim, optional=True)
        self.structure = sized(Operator, dim=dim, pairs=pairs, units=at(self._units))
        given = {"stiffness": stiffness, "inverse": inverse, "held": held}
        for name, function in given.items():
            if function is None:
                continue
            if not callable(function):
                raise TypeError(f"{name} is {function!r}: give a function that returns an array")
            called = self._held(function) if name == "held" else self._product(name, function)
            setattr(self.structure, name, called)

    def __enter__(self):
        self._error = None

    def __exit__(self, *_):
        error, self._error = self._error, None
        if error is not None:
            raise error

    def _product(self, name, function):
        return ProductFunction(lambda _, x, y: self._answer(name, y, function, self._copy(x)))

    def _held(self, function):
        def call(_, held, changed, x, y):
            held = np.ctypeslib.as_array(held, (self._size,)) != 0
            return self._answer("held", y, function, held, bool(changed), self._copy(x))

        return HeldFunction(call)

    def _copy(self, x):
        return np.ctypeslib.as_array(x, (self._size,)).copy()

    def _answer(self, name, y, function, *arguments):
        try:
            answer = np.asarray(function(*arguments), float)
            if answer.shape != (self._size,):
                raise ValueError(f"{name} returns the shape {answer.shape}: give {(self._size,)}")
            np.ctypeslib.as_array(y, (self._size,))[:] = answer
            return 0
        except BaseException as error:  # noqa: B036 (Ctrl-C too goes on in __exit__)
            self._error = error
            return 1
