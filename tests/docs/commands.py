"""Every command of a page is run, and prints what the page shows.

commands.py TRUNNION SOURCE PAGE... ; with UPDATE=1 in the environment it writes what they print
into the page. A block ```console holds commands, `$ trunnion ...` (`> ` goes on), each with its output below:
standard output and messages, a line `...` for any lines. The commands of a page share one folder,
which has copies of machines, programs and docs/instruments.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"(?<=```console\n).*?(?=```)", re.S)
COMMAND = re.compile(r"^\$ (.*\n(?:> .*\n)*)((?:(?!\$ ).*\n)*)", re.M)


def prepare(folder, source, program):
    for name in ("machines", "programs", "docs/instruments", "docs/scripts"):
        shutil.copytree(source / name, folder / name)
    (folder / "bin").mkdir()
    os.symlink(program, folder / "bin/trunnion")
    return {"PATH": f"{folder}/bin:/usr/bin:/bin", "HOME": str(folder), "LC_ALL": "C.UTF-8",
            "TRUNNION_HOME": str(folder), "TZ": "UTC"}


def printed(command, folder, environment):
    typed = re.sub(r"^> ", "", command, flags=re.M)
    done = subprocess.run(["bash", "-c", typed], cwd=folder, env=environment, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8")
    text = "".join(line.rstrip() + "\n" for line in done.stdout.splitlines())
    return text if done.returncode < 2 else text + f"(exit code {done.returncode})\n"


def fits(shown, found):
    """A line `...` stands for any lines."""
    parts = re.split(r"^\.\.\.\n", shown, flags=re.M)
    return re.fullmatch(".*?".join(map(re.escape, parts)), found, re.S) is not None


def shortened(shown, found):
    """What is printed, cut as the page cut it: the same number of lines before and after `...`."""
    if "...\n" not in shown.splitlines(keepends=True):
        return found
    before, after = (p.count("\n") for p in re.split(r"^\.\.\.\n", shown, maxsplit=1, flags=re.M))
    lines = found.splitlines(keepends=True)
    return "".join(lines[:before] + ["...\n"] + (lines[-after:] if after else []))


def page_faults(page, program, source):
    text, faults, count = page.read_text(encoding="utf-8"), [], 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        environment = prepare(folder, source, program)

        def run(match):
            nonlocal count
            count += 1
            command, shown = match.groups()
            found = printed(command, folder, environment)
            if not fits(shown, found):
                faults.append(f"{page.name}: $ {command}shown:\n{shown}printed:\n{found}")
            return f"$ {command}{shortened(shown, found)}"

        updated = BLOCK.sub(lambda block: COMMAND.sub(run, block.group(0)), text)
    if os.environ.get("UPDATE"):
        page.write_text(updated, encoding="utf-8")
    return count, faults


def main():
    program, source = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
    failed = False
    for page in map(pathlib.Path, sys.argv[3:]):
        count, faults = page_faults(page, program, source)
        print(f"{page}: {count} commands, {len(faults)} faults")
        print("\n".join(faults))
        failed = failed or bool(faults) or count == 0
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
