"""docs/python.md is one script: its blocks run in order and print what the page shows.

test_page.py update writes what they print into the page.
"""
import contextlib
import io
import os
import pathlib
import re
import sys
import tempfile

SOURCE = pathlib.Path(os.environ["TRUNNION_SOURCE"]).resolve()
PAGE = SOURCE / "docs/python.md"
BLOCK = re.compile(r"```python\n(.*?)```\n(?:\n```text\n(.*?)```\n)?", re.S)


def printed(code, names, line):
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile("\n" * line + code, str(PAGE), "exec"), names)
    return out.getvalue()


def main():
    page = PAGE.read_text(encoding="utf-8")
    names, faults = {}, 0
    folder = tempfile.TemporaryDirectory()
    for shipped in ("machines", "programs"):
        os.symlink(SOURCE / shipped, pathlib.Path(folder.name) / shipped)
    os.chdir(folder.name)

    def replaced(match):
        nonlocal faults
        code, shown = match.group(1), match.group(2) or ""
        line = page[: match.start(1)].count("\n")
        found = printed(code, names, line)
        if found != shown:
            faults += 1
            print(f"{PAGE}:{line}: shown\n{shown}printed\n{found}")
        if match.group(2) is None:
            return match.group(0)
        return f"```python\n{code}```\n\n```text\n{found}```\n"

    updated = BLOCK.sub(replaced, page)
    if sys.argv[1:] == ["update"]:
        PAGE.write_text(updated, encoding="utf-8")
        return 0
    print(f"{len(BLOCK.findall(page))} blocks, {faults} faults")
    return 1 if faults or not names else 0


if __name__ == "__main__":
    sys.exit(main())
