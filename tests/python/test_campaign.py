"""docs/scripts/campaign.py: shards merge to the bytes of one process; the sigmas are honest."""
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(os.environ["TRUNNION_SOURCE"]) / "docs/scripts/campaign.py"
MACHINES = 24


class Campaign(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)

    def call(self, *words, code=0):
        done = subprocess.run([sys.executable, SCRIPT, *map(str, words)],
                              cwd=self.folder.name, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout

    def bytes_of(self, name):
        return (pathlib.Path(self.folder.name) / name).read_bytes()

    def test_shards_merge_to_the_same_bytes(self):
        self.call("run", "--machines", MACHINES, "--threads", 2, "--out", "all.csv")
        parts = [f"part-{k}.csv" for k in (3, 1, 2)]
        for part, k in zip(parts, (3, 1, 2)):
            self.call("run", "--machines", MACHINES, "--threads", 1, "--shard", f"{k}/3",
                      "--out", part)
        self.call("merge", *parts, "--out", "merged.csv")
        self.assertEqual(self.bytes_of("merged.csv"), self.bytes_of("all.csv"))
        self.call("merge", *parts[:2], "--out", "none.csv", code=1)
        lines = self.bytes_of("all.csv").decode().splitlines()
        self.assertEqual(len(lines), MACHINES + 2)
        pulls = [float(c) for line in lines[2:] for c in line.split(",")[1:] if c]
        rms = math.sqrt(sum(p * p for p in pulls) / len(pulls))
        self.assertGreater(len(pulls), 4 * MACHINES)
        self.assertTrue(0.75 < rms < 1.25, rms)
        self.assertIn(f"{MACHINES} machines", self.call("show", "all.csv"))


if __name__ == "__main__":
    unittest.main()
