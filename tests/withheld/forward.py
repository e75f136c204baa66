"""What the devices read: product of exact 4x4 transforms, exact touch root, exact ball-to-ball length.

Work side  M <- W:  Tr(q0+d0) Exp(e0) Rot(u0, word+a0) Tr(-q0) Tr(q1+d1) Exp(e1) Rot(u1, word+a1) Tr(-q1)
Tool side  M <- S:  Tr(shift) Tr(x) Exp(eX) Tr(y) Exp(eY) Tr(z) Exp(eZ), tip and cup hang from it: each slide
carries the next.
All errors are actual - nominal, along and about + axes of M (of the carrier for axis 1).
"""
import numpy as np

import frames


class Errors:
    """Accumulated error of every row; effects add to these arrays (mm, rad)."""

    def __init__(self, n):
        self.angle_rad = np.zeros((n, 2))          # added to the word, about `direction`
        self.axis_shift_mm = np.zeros((2, n, 3))   # error motions of the rotary axes
        self.axis_tilt_rad = np.zeros((2, n, 3))
        self.gauge_mm = np.zeros((n, 3))           # where the linear axes put the gauge point, in M
        self.carriage_rad = np.zeros((3, n, 3))    # angular error of X, Y, Z
        self.tip_mm = np.zeros((n, 3))             # stylus against its declared place, in S
        self.artefact_mm = np.zeros((n, 3))        # in W
        self.work_mm = np.zeros((n, 3))            # the carried work as a whole, in M
        self.radius_mm = np.zeros(n)               # added to contact distance of stylus and sphere (touch)
        self.value_mm = np.zeros(n)                # added to the reading


class Scene:
    """Rows on a machine: caches what does not change between evaluations."""

    def __init__(self, machine, base, rows):
        self.machine, self.base, self.rows = machine, base, rows
        names = [a.name for a in machine.artefacts]
        self.which = np.array([names.index(f) if f in names else 0 for f in rows.feature])
        self.center_mm = np.array([a.center_mm for a in machine.artefacts])[self.which]
        self.sum_radius_mm = np.array([a.diameter_mm for a in machine.artefacts])[self.which] / 2 \
            + machine.ball_diameter_mm / 2
        self.word_rad = np.radians(rows.ang_deg)
        self.turned = [frames.rotation_about(self.word_rad[:, k, None] * machine.directions[k]) for k in (0, 1)]
        self.kept = (None, None)        # work side without effects, for the base values last used

    def work_point(self, errors, values, point_w_mm):
        """Points fixed to the table (W) in M."""
        machine, parts = self.machine, self.base.split(values)
        out = point_w_mm
        for k in (1, 0):
            angle = self.word_rad[:, k] + errors.angle_rad[:, k]
            spin = frames.rotation_about(angle[:, None] * machine.directions[k])
            lean = frames.rotation_about(parts["tilt"][k] + errors.axis_tilt_rad[k])
            shift = frames.translation(machine.points_mm[k] + parts["shift"][k] + errors.axis_shift_mm[k])
            back = frames.translation(np.broadcast_to(-machine.points_mm[k], (self.rows.n, 3)))
            out = frames.apply(shift @ lean @ spin @ back, out)
        return out + errors.work_mm

    def centers(self, errors, values):
        """Artefact centres in M; kept when only the tool side has effects."""
        moved = (errors.angle_rad, errors.axis_shift_mm, errors.axis_tilt_rad, errors.work_mm, errors.artefact_mm)
        parts = self.base.split(values)
        if any(array.any() for array in moved):
            return self.work_point(errors, values, self.center_mm + parts["center"][self.which] + errors.artefact_mm)
        if self.kept[0] != values.tobytes():
            self.kept = (values.tobytes(), self.work_point(errors, values, self.center_mm + parts["center"][self.which]))
        return self.kept[1]

    def tool_point(self, errors, arm_mm):
        """Points of the spindle side (S) in M."""
        place = self.rows.pos_mm
        if not errors.carriage_rad.any():
            return place + errors.gauge_mm + arm_mm      # the product of pure shifts
        spin = [frames.rotation_about(errors.carriage_rad[k]) for k in range(3)]
        chain = frames.translation(errors.gauge_mm)
        for k in range(3):
            chain = chain @ frames.translation(place * np.eye(3)[k]) @ spin[k]
        return frames.apply(chain, arm_mm)

    def readings(self, values, effects=(), amplitudes=None):
        """value_mm of every row (0 for device-less ones) for base values and effects in force.

        Touches: the axes go on to the contact, and what the effects do there is what counts.
        """
        if self.base.sessions == 1:
            return self.of_session(values, effects, amplitudes)
        days = [self.of_session(self.base.of_session(values, s), effects, amplitudes) for s in range(self.base.sessions)]
        return np.choose(self.rows.session, days)

    def of_session(self, values, effects, amplitudes):
        """The same with the set-up of one session."""
        first, touch = self.read(values, effects, amplitudes), self.rows.device == "touch"
        if not touch.any() or not len(effects):
            return first
        end = self.rows.pos_mm
        self.rows.pos_mm = end + (first * touch)[:, None] * self.rows.dir
        second = self.read(values, effects, amplitudes)
        self.rows.pos_mm = end
        return np.where(touch, first + second, first)

    def read(self, values, effects, amplitudes):
        """The same with the axes where `pos_mm` says."""
        rows, machine = self.rows, self.machine
        errors = Errors(rows.n)
        for k, effect in enumerate(effects):
            effect.apply(self, errors, effect.amplitude if amplitudes is None else amplitudes[k])
        parts = self.base.split(values)
        center = self.centers(errors, values)
        out = np.zeros(rows.n)
        if rows.probe.any():
            tip = self.tool_point(errors, machine.tip_mm + errors.tip_mm)
            sphere, touch = rows.device == "sphere", rows.device == "touch"
            away = center - tip
            along = np.einsum("ni,ni->n", rows.dir, away)
            out[sphere] = along[sphere]
            if touch.any():
                across = np.einsum("ni,ni->n", away, away) - along ** 2
                reach = (self.sum_radius_mm + errors.radius_mm) ** 2 - across
                out[touch] = (along - np.sqrt(np.maximum(reach, 0.0)))[touch]
        if rows.bar.any():
            cup = self.tool_point(errors, machine.cup_mm + parts["cup"][0])
            length = np.sqrt(np.einsum("ni,ni->n", center - cup, center - cup))
            out[rows.bar] = (length - machine.bar_length_mm + parts["length"][0, 0])[rows.bar]
        return (out + errors.value_mm) * rows.read
