"""Text of the caller as C strings, and warnings for the caller."""

import os
import sys
import warnings

_PACKAGE = os.path.dirname(os.path.abspath(__file__))


def tell(sentence):
    """Warns at the line outside of the package that has led here."""
    level, frame = 2, sys._getframe(1)
    while frame is not None and os.path.dirname(os.path.abspath(frame.f_code.co_filename)) == _PACKAGE:
        level, frame = level + 1, frame.f_back
    warnings.warn(sentence, stacklevel=level)


def path_bytes(path):
    """Name of a file."""
    return _terminated("path", os.fsencode(path))


def remark_bytes(remark):
    """A remark of a problem file, or None."""
    if remark is None:
        return None
    if not isinstance(remark, str):
        raise TypeError(f"remark is {remark!r}: give a text of one line")
    return _terminated("remark", remark.encode())


def name_bytes(name):
    """Name of a field."""
    if not isinstance(name, str):
        raise TypeError(f"the field {name!r} has no name: give a text")
    return _terminated("a name", name.encode())


def zone_bytes(name):
    """Name of a zone."""
    if not isinstance(name, str):
        raise TypeError(f"zones names a zone {name!r}: give a text as its name")
    try:
        return _terminated(f"the name of zone {name!r}", name.encode())
    except UnicodeEncodeError:
        raise ValueError(f"the name of zone {name!r} holds half of a character: give a text that UTF-8 can write") from None


def _terminated(name, text):
    if b"\0" in text:
        raise ValueError(f"{name} holds a null character, which ends a text in C: leave it out")
    return text
