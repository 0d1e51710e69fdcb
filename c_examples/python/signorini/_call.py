"""One call that solves: its settings, its progress function, Ctrl-C."""

import ctypes
import signal
import threading

from ._constants import Method, Search, chosen
from ._results import Progress
from ._structures import Callback, Settings

NAMES = ("method", "tolerance", "omega", "damping", "max_iterations", "time_limit", "search",
         "proof", "memory_limit", "full_space", "threads")
OF_MODELS = ("time_limit", "memory_limit", "full_space", "threads")
COUNTS = ("max_iterations", "memory_limit", "threads")
FAMILIES = {"method": Method, "search": Search}


class Call:
    """Settings of one call, with its progress function and what came of it."""

    def __init__(self, functions, settings, warm_start=False, names=NAMES):
        self.functions, self.error, self.pending, self.inside = functions, None, None, False
        self.settings = Settings()
        functions.settings_default(self.at(), ctypes.sizeof(Settings))
        self.progress = settings.pop("progress", None)
        for name, value in settings.items():
            if name not in names:
                why = "one of solve: give it there" if name in NAMES else "not a setting"
                raise TypeError(f"{name} is {why}; settings here: {', '.join(names)}, progress")
            if name in FAMILIES:
                value = chosen(name, FAMILIES[name], value)
            try:
                setattr(self.settings, name, value)
            except TypeError as error:
                raise TypeError(f"{name} is {value!r}: {error}") from None
            # ctypes keeps the last 64 bits of an integer.
            if name in COUNTS and getattr(self.settings, name) != value:
                raise ValueError(f"{name} is {value!r}: give at most {2**63 - 1}")
        self.settings.warm_start = warm_start
        if self.progress is not None:
            if not callable(self.progress):
                raise TypeError(f"progress is {self.progress!r}: give a function of a Progress")
            self.settings.progress = Callback(self._tell)

    def at(self):
        """Address of the settings."""
        return ctypes.byref(self.settings)

    def run(self, function, *arguments):
        """Calls a function of the library. Returns its status and sentence.

        What the progress function or Ctrl-C has raised goes on from here.
        """
        previous = signal.getsignal(signal.SIGINT) if self.progress is not None else None
        watch = callable(previous) and threading.current_thread() is threading.main_thread()
        if watch:
            # Python would raise KeyboardInterrupt at the door of _tell, where ctypes drops it.
            def handle(number, frame):
                self.pending = (previous, number, frame)
                if self.inside:
                    self._interrupt()

            signal.signal(signal.SIGINT, handle)
        try:
            status = function(*arguments)
        finally:
            if watch:
                signal.signal(signal.SIGINT, previous)
        message = self.functions.last_error().decode()
        if self.error is not None:
            try:
                raise self.error
            finally:
                self.error = None  # it has the frame of this call, which would keep it and what it was given for ever
        self._interrupt()
        return status, message

    def _tell(self, _, told):
        try:
            try:
                self.inside = True
                self._interrupt()
                told = told.contents
                cancel = self.progress(Progress(*[getattr(told, name) for name in Progress._fields]))
            finally:
                self.inside = False
            return 1 if cancel else 0
        except BaseException as error:  # none may cross the library; run() raises it
            self.error = error
            return 1

    def _interrupt(self):
        if self.pending is not None:
            (handler, *rest), self.pending = self.pending, None
            handler(*rest)
