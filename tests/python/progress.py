"""The Python package: progress functions, and what ends a call early.

    python3 tests/python/progress.py
"""

import gc
import os
import signal
import threading
import time
import unittest
import weakref

import numpy as np

from common import chain

import bar_mesh
import signorini


class Progress(unittest.TestCase):
    slow = {"method": "sor_nested", "omega": 1e-6, "max_iterations": 10**9, "tolerance": 1e-15}

    def setUp(self):
        # A program that was started in the background ignores Ctrl-C.
        signal.signal(signal.SIGINT, signal.default_int_handler)

    def test_is_told_and_cancels(self):
        told = []
        result = signorini.solve(*chain(), 0.01, 0.3, **self.slow,
                                 progress=lambda now: told.append(now) or len(told) == 5)
        self.assertEqual(result.status, signorini.Status.CANCELLED)
        self.assertEqual(len(told), 5)
        self.assertGreaterEqual(told[-1].iterations, told[0].iterations)
        self.assertGreaterEqual(told[-1].elapsed, 0)

    def test_reductions_have_limits(self):
        bar = bar_mesh.assemble()

        def make(**more):
            return signorini.Model.sparse(bar.matrix, bar.contact, [0, -1], fixed=bar.held, **more)

        told = []
        size = bar.matrix.shape[0] if hasattr(bar.matrix, "shape") else len(bar.matrix[2]) - 1
        model = make(progress=lambda now: told.append(now), order=np.arange(size)[::-1])
        self.assertGreater(told[-1].memory, model.stiffness.nbytes)
        self.assertLessEqual(told[-1].reduced, 1)
        chosen = make().stiffness
        np.testing.assert_allclose(model.stiffness, chosen, atol=1e-12 * abs(chosen).max())
        for more, status in (({"progress": lambda now: True}, signorini.Status.CANCELLED),
                             ({"memory_limit": 1000}, signorini.Status.MEMORY_LIMIT)):
            with self.assertRaises(signorini.SignoriniError) as caught:
                make(**more)
            self.assertIs(caught.exception.status, status)
        with self.assertRaisesRegex(signorini.SignoriniError, "order.1. is 0, as order.0. is"):
            make(order=np.zeros(size, int))
        with self.assertRaisesRegex(ValueError, "order has the shape"):
            make(order=[0])

    def test_models_of_dense_matrices_have_limits(self):
        K = chain()[0]
        for make in (signorini.Model.condensed,
                     lambda K, **more: signorini.Model.two_body(K, K, **more)):
            told = []
            make(K, progress=lambda now: told.append(now))
            self.assertGreater(told[0].memory, K.nbytes)
            for more, status in (({"progress": lambda now: True}, signorini.Status.CANCELLED),
                                 ({"memory_limit": 1000}, signorini.Status.MEMORY_LIMIT)):
                with self.assertRaises(signorini.SignoriniError) as caught:
                    make(K, **more)
                self.assertIs(caught.exception.status, status)

    def test_exceptions_cancel_and_go_on(self):
        def fail(_):
            calls.append(1)
            raise LookupError("mine")

        K, load = chain()
        model = signorini.Model.condensed(K)
        for call in (
            lambda: signorini.solve(K, load, 0.01, 0.3, **self.slow, progress=fail),
            lambda: model.solve(load, 0.01, 0.3, **self.slow, progress=fail),
            lambda: signorini.lcp_solve(K, -load, progress=fail),
        ):
            calls = []
            with self.assertRaisesRegex(LookupError, "mine"):
                call()
            self.assertEqual(len(calls), 1)

    def test_calls_that_raise_are_forgotten(self):
        """What a progress function holds goes when it has raised, been interrupted, or has cancelled."""
        class Held:
            pass

        def call(end):
            held = Held()

            def progress(_, held=held):
                return end()

            try:
                signorini.solve(*chain(), 0.01, 0.3, **self.slow, progress=progress)
            except (LookupError, KeyboardInterrupt):
                pass
            return weakref.ref(held)

        def fail():
            raise LookupError("mine")

        for end in fail, lambda: os.kill(os.getpid(), signal.SIGINT), lambda: True:
            kept = call(end)
            gc.collect()
            self.assertIsNone(kept())

    def interrupted(self, progress):
        timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
        timer.start()
        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            signorini.solve(*chain(), 0.01, 0.3, **self.slow, time_limit=20, progress=progress)
        self.assertLess(time.monotonic() - began, 10)
        self.assertIs(signal.getsignal(signal.SIGINT), signal.default_int_handler)
        timer.join()

    def test_ctrl_c_in_the_library(self):
        for _ in range(5):
            self.interrupted(lambda _: False)

    def test_ctrl_c_in_the_function(self):
        self.interrupted(lambda _: time.sleep(5))

    def test_in_another_thread(self):
        results = []

        def work():
            results.append(signorini.solve(*chain(), 0.01, 0.3, **self.slow, progress=lambda _: 1))

        thread = threading.Thread(target=work)
        thread.start()
        thread.join()
        self.assertEqual(results[0].status, signorini.Status.CANCELLED)


if __name__ == "__main__":
    unittest.main()
