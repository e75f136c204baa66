#!/usr/bin/env python3
"""Writes the sets of this folder: files in the shapes that instruments, controls and people
write, from machines whose errors are known. It shares nothing with the product: every reading is
computed here, from formulas of its own, with noise of its own. `truth.txt` lists what the tests
expect.

    python3 make_sets.py

The shapes (prose above the table, decimal commas, units in the header, in a row or in prose, a byte
order mark, CRLF, several tables in a file, statistics below them, missing values, rows that repeat a
target, no header at all) are those that exports have; no file of anybody was copied.
"""

import math
import pathlib
import random

HERE = pathlib.Path(__file__).parent
TRUTH = []


def save(name, text, crlf=False, bom=False, encoding="utf-8"):
    text = text.replace("\n", "\r\n") if crlf else text
    data = ("\ufeff" if bom else "") + text
    (HERE / name).write_bytes(data.encode(encoding))


def truth(name, key, value, unit):
    TRUTH.append(f"{name} {key} {value!r} {unit}")


def comma(value, digits):
    return f"{value:.{digits}f}".replace(".", ",")


def wave(q, span):
    """A smooth error of a ball screw, um."""
    return 9 * math.sin(2 * math.pi * q / span * 0.8) - 0.02 * q + 2.5 * math.cos(9 * q / span)


def laser_matrix():
    """Laser software, five runs both ways: prose, CRLF, ';', decimal comma, results below."""
    rng = random.Random(1)
    reversal = 25.4
    targets = [round(i * 55 + d, 3) for i, d in enumerate([0, .7, -.4, 1.1, .2, -.9, .5, .1, -.3, .8])]
    head = ["Linearpositionierung nach ISO 230-2:2014", "Maschine;FZ 12 (Halle 3)", "Seriennummer;4711",
            "Achse;X", "Datum;12.03.2024", "Bediener;--", "Lufttemperatur;20,41;\u00b0C",
            "Luftdruck;1013,2;mbar", "Einheit;\u00b5m", "Sensor;Material 1;11,7;ppm/\u00b0C", ""]
    runs = [(r, d) for r in range(1, 6) for d in "+-"]
    lines = head + ["Ziel [mm];" + ";".join(f"Lauf {r} {'vor' if d == '+' else 'zurueck'}" for r, d in runs) + ";"]
    columns = {}
    for r, d in runs:
        zero = rng.gauss(0, 0.2)
        for t in targets:
            columns[r, d, t] = wave(t, 500) + zero + (reversal / 2 if d == "+" else -reversal / 2) + rng.gauss(0, 0.5)
    for t in targets:
        lines.append(comma(t, 3) + ";" + ";".join(comma(columns[r, d, t], 2) for r, d in runs) + ";")
    lines += ["", "Auswertung", "Umkehrspanne B;25,9;\u00b5m", "Genauigkeit A;61,2;\u00b5m", "Ende"]
    save("laser_x.csv", "\n".join(lines) + "\n", crlf=True, encoding="latin-1")
    truth("laser_x", "backlash_um", reversal, "um")


def laser_list():
    """A list with a line for each value: BOM, ISO times, two axes, two days, positions and errors."""
    rng = random.Random(2)
    lines = ["Timestamp,Axis,Run,Direction,Target (mm),Measured (mm),Error (um),Air temp (C)"]
    clock = 8 * 3600
    for day, axis, reversal in ((14, "X", 12.77), (15, "Y", 10.6)):
        for run in range(1, 4):
            for way in ("+", "-"):
                order = range(0, 13) if way == "+" else range(12, -1, -1)
                for i in order:
                    t = 25.0 * i
                    e = 0.6 * wave(t, 300) + (reversal / 2 if way == "+" else -reversal / 2) + rng.gauss(0, 0.4)
                    clock += 7
                    h, m, s = clock // 3600, clock // 60 % 60, clock % 60
                    lines.append(f"2024-03-{day}T{h:02}:{m:02}:{s:02}.250,{axis},{run},{way},{t:.3f},"
                                 f"{t + e / 1e3:.5f},{e:.2f},{20 + 0.1 * rng.random():.2f}")
        clock = 8 * 3600
        truth("laser_list", f"{axis}.backlash_um", reversal, "um")
    save("laser_list.csv", "\n".join(lines) + "\n", bom=True)


def position_at(t, parts):
    return sum(a * math.sin(w * t + p) for a, w, p in parts)


def speed_at(t, parts):
    return sum(a * w * math.cos(w * t + p) for a, w, p in parts)


def mill_log():
    """A control's trace of two axes: title lines, a row of units, ';', decimal comma, sections."""
    rng = random.Random(3)
    lag = {"X1": 5.1e-3, "Z1": 8.7e-3}
    out = ["Name;Trace 7", "File;mill.tcscope", "Start;2024-05-02 09:11:02.120", ""]
    for section in range(3):
        parts = {"X1": [(20, 1.1 + .4 * section, .3), (3, 4.0, section)], "Z1": [(12, 1.7 + .3 * section, 1.0)]}
        out += [f"Section;{section + 1}", "Zeit;X1.Sollposition;X1.Istposition;Z1.Sollposition;Z1.Istposition;Z1 Strom",
                "ms;mm;mm;mm;mm;A"]
        for k in range(600):
            t = k * 0.01
            cells = [str(k * 10)]
            for axis in ("X1", "Z1"):
                q = position_at(t, parts[axis])
                read = q - lag[axis] * speed_at(t, parts[axis]) + rng.gauss(0, 1e-3)
                cells += [comma(q, 4), "" if axis == "X1" and k in (77, 78) else comma(read, 4)]
            out.append(";".join(cells) + ";" + comma(rng.random(), 2))
        out.append("")
    save("mill_log.csv", "\n".join(out), crlf=True)
    truth("mill_log", "X.tau_ms", lag["X1"] * 1e3, "ms")
    truth("mill_log", "Z.tau_ms", lag["Z1"] * 1e3, "ms")


def sampler():
    """What a sampler of a PC control prints: numbers alone, blanks between, an overrun."""
    rng = random.Random(4)
    lag = 12.4e-3
    parts = [(8, 2.0, 0), (1.5, 7.0, 1.0)]
    out = []
    for k in range(1500):
        t = k * 0.004
        if k == 700:
            out.append("overrun")
        q = position_at(t, parts)
        out.append(f"{k} {q:.6f} {q - lag * speed_at(t, parts) + rng.gauss(0, 5e-4):.6f} 0 ")
    save("sampler.txt", "\n".join(out) + "\n")
    truth("sampler", "tau_ms", lag * 1e3, "ms")


def turned(x, y, angle, dx, dy):
    """The part turned by `angle` about the origin and shifted."""
    return x * math.cos(angle) - y * math.sin(angle) + dx, x * math.sin(angle) + y * math.cos(angle) + dy


def plate_wide():
    """A CMM's report of a plate in the plane: tabs, no Z, deviations beside, points left out."""
    rng = random.Random(5)
    angle = math.radians(0.029)
    lines = ["Inspection report", "Part: plate A", "Date: 2024-04-11", "",
             "Point\tX Nom (mm)\tY Nom (mm)\tX Act (mm)\tY Act (mm)\tX Dev (um)\tY Dev (um)\tRemark"]
    number = 0
    for j in range(7):
        for i in range(7):
            x, y = i * 40.0, j * 40.0
            mx, my = turned(x * (1 + 12e-6), y * (1 - 9e-6), angle, -0.044, 0.079)
            mx += rng.gauss(0, 1.2e-3)
            my += rng.gauss(0, 1.2e-3)
            number += 1
            if number in (11, 30):
                lines.append(f"P{number}\t{x:.3f}\t{y:.3f}\t---\t---\t---\t---\tdirt")
            else:
                lines.append(f"P{number}\t{x:.3f}\t{y:.3f}\t{mx:.4f}\t{my:.4f}\t{(mx - x) * 1e3:.1f}\t{(my - y) * 1e3:.1f}\t")
    save("plate_wide.tsv", "\n".join(lines) + "\n")
    truth("plate_wide", "turned_deg", 0.029, "deg")


def plate_lines():
    """A CMM's report with a line for each coordinate: name, axis, nominal, actual, deviation."""
    rng = random.Random(6)
    scale, square = -34e-6, 41e-6
    lines = ["Messprotokoll;Platte B", "Datum;11.04.2024;", "Einheit;mm", "",
             "Element;Merkmal;Nennwert;Messwert;Abweichung;OTol;UTol"]
    k = 0
    for j in range(6):
        for i in range(8):
            x, y, z = 30.0 * i - 100, 35.0 * j - 90, -140.0
            real = (x * (1 + scale) - square * y, y * (1 + scale), z)
            mx, my = turned(real[0], real[1], 1.3e-4, 0.02, -0.035)
            k += 1
            for name, nominal, measured in (("X", x, mx), ("Y", y, my), ("Z", z, z + 0.004)):
                measured += rng.gauss(0, 0.3e-3)
                lines.append(f"KREIS_{k};{name};{comma(nominal, 3)};{comma(measured, 4)};"
                             f"{comma(measured - nominal, 4)};0,05;-0,05")
            lines.append(f"KREIS_{k};D;{comma(12, 3)};{comma(12.003, 4)};{comma(.003, 4)};0,05;-0,05")
    save("plate_lines.csv", "\n".join(lines) + "\n", crlf=True, bom=True)
    truth("plate_lines", "scale_ppm", scale * 1e6, "ppm")
    truth("plate_lines", "square_urad", square * 1e6, "urad")


def resolver():
    """A resolver against a reference encoder: three turns, 0 to 360 again and again, both ways."""
    rng = random.Random(7)
    order4, order1, step = 70.9, 38.0, 22.0
    lines = ["% resolver test bench", "% date 2023-11-08", "%", "% index   reference_deg   resolver_deg"]
    k = 0
    for way in (1, -1, 1, -1):
        for i in range(361):
            a = 2.0 * i if way > 0 else 720 - 2.0 * i
            r = math.radians(a)
            e = order4 * math.sin(4 * r + 0.4) + order1 * math.cos(r) + way * step / 2 + rng.gauss(0, 2)
            lines.append(f"{k:6d}   {a % 360:12.5f}   {(a + math.degrees(e * 1e-6)) % 360:13.6f}")
            k += 1
    save("resolver.dat", "\n".join(lines) + "\n")
    truth("resolver", "order4_urad", order4, "urad")
    truth("resolver", "backlash_urad", step, "urad")


def telescope():
    """Stars all over the sky: azimuth and altitude as set, errors as the camera found them."""
    rng = random.Random(8)
    north, east, collimation, index = 95e-6, -60e-6, 140e-6, 80e-6
    arcsec = math.radians(1 / 3600)
    lines = ["# pointing run 2024-02-17", "# site 50.9 N 11.7 E", "",
             "date,time,star,Az (deg),Alt (deg),dAz (arcsec),dAlt (arcsec),fwhm"]
    for k in range(120):
        az, alt = rng.uniform(0, 360), rng.uniform(15, 78)
        a, h = math.radians(az), math.radians(alt)
        # Horizon frame: X east, Y north, Z up; azimuth from north through east. The azimuth axis
        # leans: turned by `east` about X and by `north` about Y; what it carries leans with it.
        sight = (math.cos(h) * math.sin(a), math.cos(h) * math.cos(a), math.sin(h))
        lean = (east, north, 0.0)
        moved = [lean[1] * sight[2], -lean[0] * sight[2], lean[0] * sight[1] - lean[1] * sight[0]]
        along_az = (math.cos(a), -math.sin(a), 0.0)
        up = (-math.sin(h) * math.sin(a), -math.sin(h) * math.cos(a), math.cos(h))
        cross = sum(m * u for m, u in zip(moved, along_az)) + collimation
        rise = sum(m * u for m, u in zip(moved, up)) + index
        d_az = cross / math.cos(h) / arcsec + rng.gauss(0, 1.0) / math.cos(h)
        d_alt = rise / arcsec + rng.gauss(0, 1.0)
        s = 70000 + 95 * k
        lines.append(f"2024-02-{17 + s // 86400},{s // 3600 % 24:02}:{s // 60 % 60:02}:{s % 60:02},HR{1000 + k},{az:.4f},{alt:.4f},"
                     f"{d_az:.2f},{d_alt:.2f},{rng.uniform(1.5, 3):.1f}")
    save("telescope.csv", "\n".join(lines) + "\n")
    truth("telescope", "lean_x_urad", east * 1e6, "urad")
    truth("telescope", "lean_y_urad", north * 1e6, "urad")


def matrix(axis, angle):
    c, s = math.cos(angle), math.sin(angle)
    return {"x": [[1, 0, 0], [0, c, -s], [0, s, c]], "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]]}[axis]


def apply(m, v):
    return [sum(m[i][j] * v[j] for j in range(3)) for i in range(3)]


def arm(joints, zero, shoulder):
    """Tip of a four-joint arm, mm: base turn, shoulder, elbow, wrist."""
    q = [math.radians(a) + z for a, z in zip(joints, zero)]
    v = apply(matrix("y", q[3]), [120.0, 0.0, 25.0])
    v = apply(matrix("y", q[2]), [v[0] + 380.0, v[1], v[2]])
    v = apply(matrix("y", q[1]), [v[0] + 420.0, v[1], v[2]])
    return apply(matrix("z", q[0]), [v[0] + shoulder, v[1], v[2] + 300.0])


def robot():
    """A tracker's points of an arm: joint angles, nominal and measured, decimal points, ';'."""
    rng = random.Random(9)
    zero = (0.0, 0.55e-3, -0.9e-3, 0.0)
    angle = 0.35e-3
    lines = ["Tracker export;job 12;", "units;mm;", "",
             "no;joint_1 [deg];joint_2 [deg];joint_3 [deg];joint_4 [deg];X nominal;Y nominal;Z nominal;"
             "X measured;Y measured;Z measured;rms"]
    for k in range(90):
        joints = [rng.uniform(-120, 120), rng.uniform(-70, 20), rng.uniform(10, 110), rng.uniform(-80, 80)]
        nominal = arm(joints, (0, 0, 0, 0), 0.0)
        x, y, z = arm(joints, zero, 0.0)
        mx, my = turned(x, y, angle, 0.31, -0.22)
        measured = [v + rng.gauss(0, 0.012) for v in (mx, my, z + 0.15)]
        lines.append(";".join([str(k + 1)] + [f"{j:.5f}" for j in joints] + [f"{v:.4f}" for v in nominal]
                              + [f"{v:.4f}" for v in measured] + ["0.01"]))
    save("robot.csv", "\n".join(lines) + "\n")
    truth("robot", "J2.zero_urad", zero[1] * 1e6, "urad")
    truth("robot", "J3.zero_urad", zero[2] * 1e6, "urad")


def ballbar():
    """Both ways of one circle in one file: ';', decimal comma, a head above each."""
    rng = random.Random(10)
    square, reversal, radius = 80e-6, 6.0, 100.0
    out = ["Kreisformtest", "Ebene: XY", "Vorschub: 1200", "Radius: 100 mm", ""]
    for way, sign in (("CCW", 1), ("CW", -1)):
        out += [f"Richtung: {way}", "Winkel (\u00b0);Abweichung (\u00b5m)"]
        for i in range(181):
            a = math.radians(2.0 * i) * sign
            x, y = math.cos(a), math.sin(a)
            vy = math.cos(a) * sign
            # Y leans by `square` towards -X; Y lags by half the reversal in its direction of travel.
            error = -square * radius * 1e3 * x * y + y * (reversal / 2) * (1 if vy > 1e-12 else -1 if vy < -1e-12 else 0)
            out.append(f"{comma(math.degrees(a) % 360 if i % 180 else 0, 2)};{comma(error + 1.7 * x - .8 * y + rng.gauss(0, .3), 2)}")
        out.append("")
    save("ballbar.txt", "\n".join(out), crlf=True)
    truth("ballbar", "square_urad", square * 1e6, "urad")
    truth("ballbar", "Y.backlash_um", reversal, "um")


def star_rows(rng, count, start_s, disturbed):
    """Rows of a telescope whose azimuth axis leans; `disturbed(k)`: errors of azimuth and altitude on
    the sky, arcsec, that no axis makes. The frame and the signs are those of telescope()."""
    east, north, collimation, index, arcsec = -50e-6, 40e-6, 140e-6, 80e-6, math.radians(1 / 3600)
    lines = ["date,time,star,Az (deg),Alt (deg),dAz (arcsec),dAlt (arcsec)"]
    for k in range(count):
        az, alt = rng.uniform(0, 360), rng.uniform(15, 78)
        a, h = math.radians(az), math.radians(alt)
        # Turned by `east` about X and `north` about Y: along the azimuth circle and upwards.
        sight = (math.cos(h) * math.sin(a), math.cos(h) * math.cos(a), math.sin(h))
        moved = (north * sight[2], -east * sight[2], east * sight[1] - north * sight[0])
        across = moved[0] * math.cos(a) - moved[1] * math.sin(a)
        rise = (-moved[0] * math.sin(h) * math.sin(a) - moved[1] * math.sin(h) * math.cos(a)
                + moved[2] * math.cos(h))
        more_az, more_alt = disturbed(k)
        d_az = ((across + collimation) / arcsec + rng.gauss(0, 5.0) + more_az) / math.cos(h)
        d_alt = (rise + index) / arcsec + rng.gauss(0, 5.0) + more_alt
        s = start_s + 95 * k
        lines.append(f"2024-02-{17 + s // 86400},{s // 3600 % 24:02}:{s // 60 % 60:02}:{s % 60:02},HR{1000 + k},"
                     f"{az:.4f},{alt:.4f},{d_az:.2f},{d_alt:.2f}")
    return "\n".join(lines) + "\n"


def stars_wild():
    """A night of 24 stars, three of them mistaken for others."""
    rng = random.Random(11)
    wild = {4, 12, 19}
    save("stars_wild.csv", star_rows(rng, 24, 70000, lambda k: (rng.gauss(0, 300), rng.gauss(0, 300))
                                     if k in wild else (0.0, 0.0)))
    save("stars_fresh.csv", star_rows(rng, 150, 160000, lambda k: (0.0, 0.0)))
    truth("stars_wild", "noise_urad", math.radians(5 / 3600) * 1e6, "urad")


def stars_slip():
    """Another night: the azimuth slips by 24 arcsec on the sky, and back, every 20 stars."""
    rng = random.Random(12)
    save("stars_slip.csv", star_rows(rng, 120, 70000, lambda k: (24.0 * (k // 20 % 2), 0.0)))
    truth("stars_slip", "slip_arcsec", 24.0, "arcsec")


def laser_drifting():
    """Five cycles of a laser whose zero moves from cycle to cycle by more than all else."""
    rng = random.Random(13)
    targets = [round(i * 50 + d, 3) for i, d in enumerate([0, .7, -.4, 1.1, .2, -.9, .5, .1, -.3, .8, .4])]
    for name, cycles in (("laser_drifting.csv", 5), ("laser_fresh.csv", 4)):
        zero, lines = 0.0, ["target_mm,error_um,run,direction"]
        for cycle in range(1, cycles + 1):
            zero += rng.gauss(0, 15)
            for way, order in (("+", targets), ("-", targets[::-1])):
                for t in order:
                    error = wave(t, 500) * .6 + zero + (6 if way == "+" else -6) + rng.gauss(0, .5)
                    lines.append(f"{t:.3f},{error:.2f},{cycle},{way}")
        save(name, "\n".join(lines) + "\n")
    truth("laser_drifting", "reversal_um", 12.0, "um")


def full_steps():
    """A motor of 200 full steps against an encoder: every second step falls short."""
    rng = random.Random(14)
    lines = ["n,C_cmd_deg,C_act_deg"]
    k = 0
    for _ in range(2):
        for order in (range(200), range(200, 0, -1)):
            for i in order:
                angle = 2 * math.pi * i / 200
                error = 813e-6 * (1 if i % 2 == 0 else -1) + 150e-6 * math.cos(angle) + rng.gauss(0, 4e-6)
                lines.append(f"{k},{math.degrees(angle):.6f},{math.degrees(angle + error):.6f}")
                k += 1
    save("full_steps.csv", "\n".join(lines) + "\n")
    truth("full_steps", "alternating_urad", 813.0, "urad")


if __name__ == "__main__":
    for write in (laser_matrix, laser_list, mill_log, sampler, plate_wide, plate_lines, resolver, telescope,
                  robot, ballbar, stars_wild, stars_slip, laser_drifting,
                  full_steps):
        write()
    (HERE / "truth.txt").write_text("\n".join(TRUTH) + "\n")
