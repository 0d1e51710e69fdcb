"""Models of which the host gives products and solutions alone."""

import ctypes

import numpy as np

from ._arrays import at, components, doubles, reals
from ._structures import (HeldFunction, Operator, PreconditionFunction, ProductFunction,
                          sized)


class HostFunctions:
    """Functions of the host as the library calls them. None of what they raise may cross the library: it goes on
    where a `with` on this object ends."""

    def __init__(self, dim, pairs, units, *, place=None, accuracy=0.0, **given):
        self._dim, self._pairs, self._error, self._place = dim, pairs, None, None
        if place is None:
            self._size = dim * pairs
            self._units = components("units", units, pairs, dim, optional=True)
            self.structure = sized(Operator, dim=dim, pairs=pairs, units=at(self._units),
                                   accuracy=accuracy)
        else:
            self._place, self._units = place, doubles(reals("units", units))
            if self._units.ndim != 1:
                shape = self._units.shape
                raise ValueError(f"units has the shape {shape}: give one number for each unknown")
            self._size = len(self._units)
            self.structure = sized(Operator, dim=dim, pairs=pairs, units=at(self._units),
                                   unknowns=self._size, place=at(place))
        for name, function in given.items():
            if function is None:
                continue
            if not callable(function):
                raise TypeError(f"{name} is {function!r}: give a function that returns an array")
            called = {"held": self._held, "precondition": self._precondition}.get(name)
            called = called(function) if called else self._product(name, function)
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

    def _precondition(self, function):
        components, across = self._dim * self._pairs, self._dim - 1

        def call(_, held, springs, changed, r, z):
            held = np.ctypeslib.as_array(held, (components,)) != 0
            springs = np.ctypeslib.as_array(springs, (self._pairs, across, across)).copy()
            return self._answer("precondition", z, function, held, springs, bool(changed),
                                self._copy(r))

        return PreconditionFunction(call)

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
