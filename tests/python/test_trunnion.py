"""The module says what the command line says, to the last digit."""
import concurrent.futures
import csv
import io
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy
import trunnion

PROGRAM = os.environ["TRUNNION_PROGRAM"]
SOURCE = pathlib.Path(os.environ["TRUNNION_SOURCE"])
MACHINE = SOURCE / "machines/bc_table.toml"
PART = SOURCE / "programs/examples/bracket_g43_4.nc"
POST = SOURCE / "programs/examples/bracket_post.nc"
WORN = "C.positioning: cos2_rad=4e-5"


def command(*words):
    """Standard output of the command line."""
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True)
    return done.stdout


def result_of(*words):
    """The JSON of a command, without the files that it read: Python works on values."""
    result = json.loads(command(*words))
    del result["inputs"]
    return result


def numbers(text, column):
    lines = [line for line in text.splitlines() if not line.startswith("#")]
    cells = [row[column] for row in csv.DictReader(io.StringIO("\n".join(lines)))]
    return [float(cell) if cell else numpy.nan for cell in cells]


class Bench(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.readings_csv = os.path.join(cls.folder.name, "readings.csv")
        command("run", "O8002", "--inject", WORN, "--readings", cls.readings_csv)
        cls.machine = trunnion.Setup(MACHINE)
        cls.readings = trunnion.Readings(cls.readings_csv, cls.machine)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def assertSameNumbers(self, array, expected):
        self.assertTrue(numpy.array_equal(array, numpy.array(expected), equal_nan=True))


class Runs(Bench):
    def test_result_is_that_of_run_json(self):
        run = self.machine.run(PART)
        self.assertEqual(run.result, result_of("run", PART, "--setup", MACHINE, "--json"))
        self.assertEqual(run.status, "ok")

    def test_trace_is_that_of_the_file(self):
        path = os.path.join(self.folder.name, "trace.csv")
        command("run", PART, "--trace", path, "--truth")
        text = pathlib.Path(path).read_text()
        trace = self.machine.run(PART, trace=True, truth=True).trace
        for name in ("x_mm", "b_deg", "tip_z_mm", "true_z_mm", "time_s"):
            self.assertSameNumbers(trace[name], numbers(text, name))
        self.assertEqual(set(trace["motion"]), {"G0", "G1"} | set(trace["motion"]))

    def test_readings_are_those_of_the_file(self):
        run = self.machine.with_effect(WORN).run("O8002")
        self.assertEqual(run.readings.csv(), pathlib.Path(self.readings_csv).read_text())
        text = pathlib.Path(self.readings_csv).read_text()
        self.assertSameNumbers(run.readings["value_mm"], numbers(text, "value_mm"))

    def test_effect_by_keyword_is_that_of_inject(self):
        by_word = self.machine.with_effect("C.positioning", cos2_rad=4e-5)
        self.assertEqual(by_word.toml(), self.machine.with_effect(WORN).toml())

    def test_text_and_variables(self):
        run = self.machine.run(text="O1\n#101=#100*2.\nM30\n", variables={100: 3.5})
        self.assertEqual(run.variables["101"], 7.0)

    def test_limit_is_a_status(self):
        run = self.machine.run(text="O1\nN1 GOTO 1\nM30\n", max_blocks=1000)
        self.assertEqual((run.status, run.result["limit"]), ("limit", "blocks"))


class Errors(Bench):
    def test_alarm_knows_its_place_and_keeps_the_run(self):
        with self.assertRaises(trunnion.Alarm) as caught:
            self.machine.run(text="O1\nG0 X1.\nG999\nM30\n", trace=True)
        alarm = caught.exception
        self.assertEqual((alarm.number, alarm.line, alarm.column), (10, 3, 1))
        self.assertEqual(alarm.line_text, "G999")
        self.assertEqual(len(alarm.run.trace["x_mm"]), 1)

    def test_bad_setup_knows_its_place(self):
        with self.assertRaises(trunnion.InputError) as caught:
            trunnion.Setup.parse('schema = "trunnion.setup/1"\n[machine]\nchain = 5\n', "m.toml")
        self.assertEqual((caught.exception.path, caught.exception.line), ("m.toml", 3))
        self.assertIn("m.toml:3:", str(caught.exception))

    def test_bad_cell_knows_its_place(self):
        text = pathlib.Path(self.readings_csv).read_text().replace(",touch,", ",tuch,", 1)
        with self.assertRaises(trunnion.InputError) as caught:
            trunnion.Readings.parse(text, self.machine, "r.csv")
        self.assertEqual(caught.exception.path, "r.csv")
        self.assertGreater(caught.exception.line, 1)

    def test_unknown_effect_parameter_and_option(self):
        with self.assertRaises(trunnion.InputError):
            self.machine.with_effect("C.backlsh", gap_rad=1e-5)
        with self.assertRaises(trunnion.InputError):
            self.machine.with_effect("C.backlash", gap_mm=1e-5)
        with self.assertRaises(TypeError):
            self.machine.run(PART, sed=3)
        with self.assertRaises(ValueError):
            trunnion.compare(PART, POST, by="taste")


class Fits(Bench):
    def test_prediction_is_that_of_the_command(self):
        out = os.path.join(self.folder.name, "jacobian.csv")
        text = command("predict", self.readings_csv, "--setup", MACHINE, "--jacobian", out,
                       "--effects", "location,C.positioning")
        found = self.machine.predict(self.readings, jacobian=True,
                                     effects=["location", "C.positioning"])
        self.assertEqual(found.readings.csv(), text)
        rows = list(csv.reader(io.StringIO(pathlib.Path(out).read_text())))
        self.assertEqual(rows[0][1:],
                         [f"{n} [{u}]" for n, u in zip(found.names, found.units)])
        self.assertSameNumbers(found.jacobian, [[float(c) for c in r[1:]] for r in rows[1:]])

    def test_jacobian_is_the_change_of_the_prediction(self):
        names = ["C.positioning"]
        found = self.machine.predict(self.readings, jacobian=True, effects=names)
        step = 1e-5
        moved = self.machine.with_effect("C.positioning", cos2_rad=step).predict(self.readings)
        column = found.names.index("C.positioning.cos2_rad")
        value = [v["value_mm"] for v in (moved.readings, found.readings)]
        reads = numpy.array([d != "" for d in self.readings["device"]])
        change = (value[0] - value[1])[reads] / step
        self.assertGreater(numpy.abs(change).max(), 10)
        self.assertLess(numpy.abs(change - found.jacobian[:, column]).max(), 0.05)

    def test_noise_has_its_seed(self):
        text = command("predict", self.readings_csv, "--setup", MACHINE, "--noise", "--seed", 7)
        found = self.machine.predict(self.readings, noise_seed=7)
        self.assertEqual(found.readings.csv(), text)

    def test_identification_is_that_of_the_command(self):
        effects = "location,C.positioning"
        expected = result_of("identify", self.readings_csv, "--setup", MACHINE,
                             "--effects", effects, "--json")
        found = self.machine.identify(self.readings, effects.split(","))
        self.assertEqual(found.result, expected)
        self.assertEqual(found.covariance.tolist(), expected["covariance"]["matrix"])
        self.assertEqual(len(found.names), len(found.covariance))
        after = found.setup.predict(self.readings).readings["value_mm"]
        left = (after - self.readings["value_mm"])[~numpy.isnan(after)]
        self.assertAlmostEqual(1e3 * numpy.sqrt(numpy.mean(left**2)), expected["rms_after_um"],
                               places=3)

    def test_diagnosis_is_that_of_the_command(self):
        expected = result_of("diagnose", self.readings_csv, "--setup", MACHINE, "--json")
        found = self.machine.diagnose(self.readings)
        self.assertEqual(found.result, expected)
        self.assertEqual(found.verdict, expected["verdict"])
        self.assertEqual(len(found.before_um), expected["readings"])

    def test_columns_go_back_to_the_same_table(self):
        again = trunnion.Readings.from_columns(self.readings.columns, self.machine,
                                               self.readings.comment)
        self.assertEqual(again.csv(), self.readings.csv())


class Compares(Bench):
    def test_comparison_is_that_of_the_command(self):
        expected = result_of("compare", PART, POST, "--json")
        found = trunnion.compare(PART, POST)
        self.assertEqual(found.result, expected)
        self.assertFalse(found.equal)

    def test_tolerance(self):
        self.assertTrue(trunnion.compare(PART, POST, tol_lin_mm=0.2, by="path").equal)


class Threads(Bench):
    def test_other_threads_go_on_while_it_works(self):
        """A thread that only counts must count while a run is at work."""
        ticks, end = [0], threading.Event()

        def count():
            while not end.is_set():
                ticks[0] += 1
                time.sleep(0.001)

        counter = threading.Thread(target=count)
        counter.start()
        before = ticks[0]
        self.machine.run(text="O1\nN1 GOTO 1\nM30\n", max_blocks=0, max_seconds=0.5)
        done = ticks[0] - before
        end.set()
        counter.join()
        self.assertGreater(done, 20)

    def test_same_results_on_many_threads(self):
        work = [self.machine.with_effect("C.positioning", cos2_rad=1e-5 * k) for k in range(8)]
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            many = list(pool.map(lambda m: m.predict(self.readings).readings.csv(), work))
        self.assertEqual(many, [m.predict(self.readings).readings.csv() for m in work])

    def test_ctrl_c_ends_a_run(self):
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        begin = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            self.machine.run(text="O1\nN1 GOTO 1\nM30\n", max_blocks=0, max_seconds=20)
        self.assertLess(time.monotonic() - begin, 10)


class Frames(Bench):
    def test_pandas_frame(self):
        try:
            import pandas
        except ImportError:
            self.skipTest("no pandas here")
        frame = self.readings.frame()
        self.assertIsInstance(frame, pandas.DataFrame)
        self.assertEqual(len(frame), len(self.readings))


if __name__ == "__main__":
    sys.exit(not unittest.main(exit=False, verbosity=1).result.wasSuccessful())
