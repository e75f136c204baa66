"""An offline CNC control with a physical five-axis machine behind it.

    import trunnion
    machine = trunnion.Setup("machines/bc_table.toml")
    run = machine.run("part.nc", trace=True, truth=True)
    print(run.time_s, run.trace["tip_x_mm"])

Numbers are mm, degrees and seconds where a name says so, exactly those of the command line.
Work that takes long lets other threads of Python go on.
"""

import json as _json
import os as _os

from . import _native
from ._native import Alarm, InputError
from ._native import version as __version__

__all__ = [
    "Alarm",
    "Comparison",
    "Diagnosis",
    "Identification",
    "InputError",
    "Prediction",
    "Readings",
    "Run",
    "Setup",
    "Table",
    "compare",
    "shipped",
]


def shipped(name):
    """Path of a machine or program that ships with trunnion: "machines/bc_table.toml"."""
    return _native.shipped(name)


def _paths(files):
    one = isinstance(files, (str, _os.PathLike))
    return [_os.fspath(f) for f in ([files] if one else files)]


class Table(dict):
    """Columns by name: numpy arrays of numbers (NaN: an empty cell), lists of words."""

    def frame(self):
        """The same as a pandas DataFrame; needs pandas."""
        import pandas

        return pandas.DataFrame(dict(self))


class _Wrapped:
    """A value that lives in the compiled half."""

    @classmethod
    def _of(cls, native):
        made = cls.__new__(cls)
        made._native = native
        return made


class Readings(_Wrapped):
    """A table of readings, simulated and real alike (docs/readings.md)."""

    def __init__(self, files, setup):
        """One CSV file or several, joined in this order, taken on the machine of `setup`."""
        self._native = _native.load_readings(_paths(files), setup._native)

    @classmethod
    def parse(cls, text, setup, path="readings.csv"):
        """From the text of a CSV file; `path` stands in messages."""
        return cls._of(_native.parse_readings(text, path, setup._native))

    @classmethod
    def from_columns(cls, columns, setup, comment=None):
        """From columns by name: a dict of sequences or a pandas frame. NaN is an empty cell.
        `comment`: lines `# key = value` of the head."""
        names = list(columns)
        lines = [f"# {key} = {value}" for key, value in (comment or {}).items()]
        lines.append(",".join(names))
        rows = zip(*(list(columns[name]) for name in names), strict=True)
        lines += [",".join(map(_cell, row)) for row in rows]
        return cls.parse("\n".join(lines) + "\n", setup)

    def __len__(self):
        return len(self._native)

    @property
    def columns(self):
        """A Table of all columns of the CSV."""
        return Table(self._native.columns())

    def __getitem__(self, column):
        return self.columns[column]

    def frame(self):
        """As a pandas DataFrame; needs pandas."""
        return self.columns.frame()

    @property
    def comment(self):
        """The lines `# key = value` of the head."""
        return dict(self._native.comment)

    def csv(self):
        """The text of the file; numbers read back to the same double."""
        return self._native.csv()

    def save(self, path):
        """Writes the CSV file."""
        with open(path, "w", encoding="utf-8", newline="") as file:
            file.write(self.csv())


def _cell(value):
    if isinstance(value, str):
        return '"' + value.replace('"', '""') + '"' if any(c in value for c in ',"\n') else value
    if value is None or value != value:
        return ""
    number = float(value)
    return str(int(number)) if number.is_integer() and abs(number) < 1e15 else repr(number)


class Run:
    """What a run did. `result` is the object that `trunnion run --json` prints; its keys are
    attributes too: status, alarm, blocks, moves, time_s, path_mm, final, variables, printed."""

    def __init__(self, native):
        self._native = native
        self.result = _json.loads(native.json)
        self.readings = Readings._of(native.readings)
        self.notes = list(native.notes)

    def __getattr__(self, name):
        if name.startswith("_") or name not in self.result:
            raise AttributeError(name)
        return self.result[name]

    @property
    def trace(self):
        """A Table with a row for each move (docs/formats.md); asked for with trace=True."""
        return Table(self._native.trace())


class Prediction:
    """What the emulator reads: `readings`; with a Jacobian also `jacobian` (device rows times
    parameters, mm or rad for one `units`), `names`, `units` and `index` (of the rows)."""

    def __init__(self, readings, sensitivity=None):
        self.readings = readings
        self.jacobian = self.names = self.units = self.index = None
        if sensitivity is not None:
            self.jacobian = sensitivity.jacobian
            self.names = sensitivity.names
            self.units = sensitivity.units
            self.index = sensitivity.index


class _Found:
    def __init__(self, native):
        self._native = native
        self.result = _json.loads(native.json)
        self.setup = Setup._of(native.setup)
        self.notes = list(native.setup.notes)


class Identification(_Found):
    """Effects fitted to readings. `result` is the object of `trunnion identify --json`,
    `covariance` an array in the order of `names` (units of the parameters), `setup` the setup
    with the values entered."""

    @property
    def parameters(self):
        return self.result["parameters"]

    @property
    def names(self):
        return self.result["covariance"]["names"]

    @property
    def covariance(self):
        return self._native.covariance


class Diagnosis(_Found):
    """`result` is the object of `trunnion diagnose --json`; `before_um` and `after_um` machine
    minus simulation by reading; `setup` the setup with the effects added."""

    @property
    def verdict(self):
        return self.result["verdict"]

    @property
    def causes(self):
        return self.result["causes"]

    @property
    def before_um(self):
        return self._native.before_um

    @property
    def after_um(self):
        return self._native.after_um


class Setup(_Wrapped):
    """Control, machine, devices and artefacts as one value (docs/setup_file.md). Methods that
    change something return another Setup."""

    def __init__(self, path=""):
        """From a file; without one machines/bc_table.toml."""
        self._native = _native.load_setup(_os.fspath(path))

    @classmethod
    def parse(cls, text, path="setup.toml"):
        """From the text of a setup file; `path` stands in messages."""
        return cls._of(_native.parse_setup(text, path))

    @property
    def name(self):
        return self._native.name

    @property
    def path(self):
        return self._native.path

    @property
    def chain(self):
        """"w C B b X Y Z t": the axes from the workpiece over the bed to the tool."""
        return self._native.chain

    @property
    def axes(self):
        return list(self._native.axes)

    @property
    def effects(self):
        """What the physical machine does beside its geometry: [(name, {parameter: [values]})]."""
        return list(self._native.effects)

    @property
    def notes(self):
        """What was derived or is not known when the file was read, a line each."""
        return list(self._native.notes)

    def toml(self):
        """The setup as a file that loads again to the same value."""
        return self._native.toml()

    def document(self):
        """The same as a dict of the file's tables."""
        import tomllib

        return tomllib.loads(self.toml())

    def save(self, path):
        with open(path, "w", encoding="utf-8") as file:
            file.write(self.toml())

    def with_effect(self, name, **parameters):
        """With an effect switched on: with_effect("C.backlash", gap_rad=6e-5), or as --inject
        says it: with_effect("C.backlash=60urad")."""
        if not parameters and ("=" in name or ":" in name):
            return Setup._of(_native.injected(self._native, name))
        values = {
            key: [float(v) for v in value] if hasattr(value, "__len__") else [float(value)]
            for key, value in parameters.items()
        }
        return Setup._of(_native.switched_on(self._native, name, values))

    def run(self, program=None, *, text=None, **options):
        """Runs an NC program: a path, an O number, or its `text`. Options as in `trunnion run`:
        programs, seed, trace, truth, trace_step_mm, trace_chord_mm, variables={100: 3.5},
        wanted=[100, 101], measure, ballbar, max_blocks, max_print, max_readings, max_seconds.
        Raises Alarm (with the run until there as its `run`); a limit is a status."""
        request = _native.RunRequest()
        request.program = _os.fspath(program) if program is not None else "program"
        request.text = text
        if "programs" in options:
            options["programs"] = _paths(options["programs"])
        for key, value in options.items():
            if not hasattr(request, key):
                raise TypeError(f"run() has no option '{key}'")
            setattr(request, key, value)
        run = Run(_native.run(self._native, request))
        if run.alarm is not None:
            raise _alarm(run)
        return run

    def predict(self, readings, *, jacobian=False, effects=(), noise_seed=None):
        """What the emulator reads at these positions; with `noise_seed` as the devices would.
        `effects`: of the Jacobian, without them those of [model].modelled."""
        predicted = _native.predict(self._native, readings._native, noise_seed)
        found = None
        if jacobian:
            found = _native.sensitivity(self._native, readings._native, list(effects))
        return Prediction(Readings._of(predicted), found)

    def identify(self, readings, effects=(), *, allow_large=False):
        """Fits effects (without names those of [model].modelled) to readings."""
        native = _native.identify(self._native, readings._native, list(effects), allow_large)
        return Identification(native)

    def diagnose(self, readings, *, holdout=None, allow_large=False):
        """Where simulation and machine differ, which effect causes it, how far it shrinks."""
        kept = holdout._native if holdout is not None else None
        return Diagnosis(_native.diagnose(self._native, readings._native, kept, allow_large))


def _alarm(run):
    alarm = run.result["alarm"]
    error = Alarm(run._native.alarm_text)
    error.number = alarm["number"]
    error.path, error.line, error.column = alarm["program"], alarm["line"], alarm["column"]
    error.line_text = alarm["block"]
    error.run = run
    return error


class Comparison:
    """`result` is the object of `trunnion compare --json`."""

    def __init__(self, native):
        self._native = native
        self.equal = native.equal
        self.result = _json.loads(native.json())

    def text(self):
        return self._native.text()

    def markdown(self):
        return self._native.markdown()


def compare(a, b, *, setup="", setup_b=None, by=None, tol_lin_mm=None, tol_ang_deg=None,
            programs=(), devices=False):
    """Are two programs (or folders) the same machining? Setups are paths."""
    request = _native.CompareRequest()
    request.setup = _os.fspath(setup)
    request.setup_b = request.setup if setup_b is None else _os.fspath(setup_b)
    request.programs(_paths(programs))
    request.devices(devices)
    if by is not None:
        request.by(by)
    if tol_lin_mm is not None:
        request.tol_lin_mm(tol_lin_mm)
    if tol_ang_deg is not None:
        request.tol_ang_deg(tol_ang_deg)
    return Comparison(_native.compare(_os.fspath(a), _os.fspath(b), request))
