"""Random milling programs in the words that Fanuc and LinuxCNC understand alike.

Left out, because the two controls differ by design: FIX, FUP and MOD of negative numbers, AND and
OR, G91 inside a running cycle, G53 under a tool length, G43 without motion.
"""
import math
import random

PLANE_AXES = {17: (0, 1, 2), 18: (2, 0, 1), 19: (1, 2, 0)}
INCH_MM = 25.4


class Program:
    """Text of one program; keeps the programmed position so that every arc closes."""

    def __init__(self, seed, blocks=40):
        self.random = random.Random(seed)
        self.lines = ["G21 G90 G17 G40 G49 G80 G94 G54", "#101=1.5", "#102=-2.25", "#103=7."]
        self.position = [0.0, 0.0, 0.0]
        self.incremental, self.inch, self.plane = False, False, 17
        self.restart()
        steps = [self.line, self.arc, self.cycle, self.frame, self.expression, self.distance,
                 self.change_plane, self.unit]
        for step in self.random.choices(steps, [30, 30, 8, 8, 8, 6, 6, 4], k=blocks):
            step()
        self.lines += ["G80", "M2"]

    @property
    def decimals(self):
        return 4 if self.inch else 3

    def length(self, low_mm, high_mm):
        return self.random.uniform(low_mm, high_mm) / (INCH_MM if self.inch else 1.0)

    def text(self, value):
        return f"{value:.{self.decimals}f}"

    def word(self, i, target):
        """The word that moves axis i to `target`, in one of the ways people write it."""
        value = round(target - self.position[i] if self.incremental else target, self.decimals)
        self.position[i] = round(self.position[i] + value, 9) if self.incremental else value
        text = self.text(value)
        way = self.random.random()
        if way < 0.2:
            text = f"[{text}]"
        elif way < 0.3:
            part = round(self.random.uniform(-9, 9), 2)
            text = f"[{part}+[{value - part:.6f}]]"
        return "XYZ"[i] + text

    def target(self, i):
        return self.length(-20, 60) if i == 2 else self.length(-60, 60)

    def restart(self, before=""):
        """An absolute rapid to a known place."""
        if self.incremental:
            self.distance()
        self.position = [0.5, 0.25, 1.0] if self.inch else [5.0, 6.0, 30.0]
        x, y, z = (self.text(v) for v in self.position)
        self.lines.append(f"{before}G0 X{x} Y{y} Z{z}")

    def distance(self):
        self.incremental = not self.incremental
        self.lines.append("G91" if self.incremental else "G90")

    def change_plane(self):
        self.plane = self.random.choice(list(PLANE_AXES))
        self.lines.append(f"G{self.plane}")

    def unit(self):
        self.inch = not self.inch
        self.lines.append("G20" if self.inch else "G21")
        self.restart()

    def line(self):
        code = self.random.choice(["G0", "G1", "G00", "G01"])
        axes = self.random.sample(range(3), self.random.randint(1, 3))
        words = [self.word(i, self.target(i)) for i in axes]
        words.insert(self.random.randint(0, len(words)), code)
        if "1" in code:
            words.append(f"F{self.random.randint(50, 900)}")
        self.lines.append(" ".join(words))

    def arc(self):
        a, b, normal = PLANE_AXES[self.plane]
        radius, start = self.length(2, 40), self.random.uniform(0, 2 * math.pi)
        sweep = self.random.uniform(0.2, 6.0)
        to_centre = [round(-radius * f(start), self.decimals) for f in (math.cos, math.sin)]
        centre = [self.position[a] + to_centre[0], self.position[b] + to_centre[1]]
        radius, start = math.hypot(*to_centre), math.atan2(-to_centre[1], -to_centre[0])
        code = self.random.choice(["G2", "G3"])
        end = start + (sweep if code == "G3" else -sweep)
        full = self.random.random() < 0.15
        words = [code]
        if not full:
            words += [self.word(a, centre[0] + radius * math.cos(end)),
                      self.word(b, centre[1] + radius * math.sin(end))]
        if self.random.random() < 0.3:
            words.append(self.word(normal, self.target(normal)))
        by_radius = not full and 0.3 < sweep < 5.9 and abs(sweep - math.pi) > 0.05
        if by_radius and self.random.random() < 0.4:
            words.append(f"R{self.text(-radius if sweep > math.pi else radius)}")
        else:
            words += ["IJK"[i] + self.text(v) for i, v in zip((a, b), to_centre)]
        self.lines.append(" ".join(words + [f"F{self.random.randint(50, 900)}"]))

    def cycle(self):
        if self.plane != 17:
            self.plane = 17
            self.lines.append("G17")
        self.restart()
        retract = round(self.length(0, 10), self.decimals)

        def place(axis):
            return axis + self.text(self.length(-50, 50))

        def depth():
            return "Z" + self.text(retract - self.length(3, 20))

        code = self.random.choice(["G81", "G82", "G85", "G89", "G73", "G83"])
        block = [self.random.choice(["G98", "G99"]), code, place("X"), place("Y"), depth(),
                 f"R{self.text(retract)}", "F200"]
        if code in ("G82", "G89"):
            block.append("P1")
        if code in ("G73", "G83"):
            block.append(f"Q{self.text(self.length(1, 6))}")
        self.lines.append(" ".join(block))
        holes = [lambda: place("X"), lambda: f"{place('Y')} {depth()}",
                 lambda: f"{place('X')} {place('Y')}"]
        self.lines += [self.random.choice(holes)() for _ in range(self.random.randint(0, 3))]
        self.lines.append("G80")
        self.restart()

    def frame(self):
        words = [axis + self.text(self.length(-30, 30)) for axis in "XYZ"]
        way = self.random.random()
        if way < 0.3:
            self.restart(self.random.choice(["G54 ", "G55 ", "G56 ", "G59 "]))
        elif way < 0.6:
            self.restart()
            self.lines.append(f"G10 L2 P{self.random.randint(1, 6)} {' '.join(words)}")
        elif way < 0.8:
            self.restart()
            self.lines.append(f"G92 {words[0]} {words[1]}")
        else:
            self.restart(f"G43 H{self.random.randint(1, 3)} ")
        self.restart()

    def term(self, depth):
        if depth == 0:
            return self.random.choice([f"{self.random.uniform(-9, 9):.2f}",
                                       f"#{self.random.randint(101, 103)}"])
        forms = ["[{}+{}]", "[{}-{}*{}]", "[{}/[ABS[{}]+1.5]]", "SIN[{}]", "COS[{}]", "ABS[{}]",
                 "ROUND[{}]", "SQRT[ABS[{}]]", "ATAN[{}]/[ABS[{}]+1]", "[{}*{}]"]
        form = self.random.choice(forms)
        return form.format(*(self.term(depth - 1) for _ in range(form.count("{}"))))

    def expression(self):
        variable = self.random.randint(101, 103)
        while len(text := self.term(2)) > 120:
            pass
        self.restart()
        axis = self.random.choice("XYZ")
        self.lines += [f"#{variable}={text}", f"#{variable}=[SIN[#{variable}]*40.]",
                       f"G1 {axis}#{variable} F300"]
        self.restart()
