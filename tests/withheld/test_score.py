#!/usr/bin/env python3
"""Self-test of the scorer: perfect, silent and broken diagnoses of a small collection."""
import contextlib
import io
import json
import os
import shutil
import tempfile
import unittest

import generate
import score
from all_claims import is_right
from statistics_table import wilson


def answer(verdict, claims, shrink):
    """A diagnosis in the contract's form."""
    return {"schema": "trunnion.diagnosis/1", "verdict": verdict, "noise_source": "given",
            "causes": [{"effect": c, "probability": 0.99, "rivals": []} for c in claims],
            "after": {"heldout_shrink": shrink, "ci95": [shrink - 0.1, shrink + 0.1]}}


class Scorer(unittest.TestCase):
    """One collection, several answers."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()
        generate.main([os.path.join(cls.folder, "seed0"), "--seed", "3", "--sets", "14"])
        cls.truths = []
        place = os.path.join(cls.folder, "seed0", "truth")
        for name in sorted(os.listdir(place)):
            with open(os.path.join(place, name)) as handle:
                cls.truths.append(json.load(handle))

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def figures(self, give):
        """Writes give(truth) -> (answer, predictions) for every set and scores them."""
        results = os.path.join(self.folder, "seed0", "results")
        shutil.rmtree(results, ignore_errors=True)
        os.makedirs(results)
        for truth in self.truths:
            said, values = give(truth)
            with open(os.path.join(results, truth["name"] + ".json"), "w") as out:
                out.write(said if isinstance(said, str) else json.dumps(said))
            with open(os.path.join(results, truth["name"] + ".csv"), "w") as out:
                out.write("index,value_mm\n" + "".join(f"{i},{v!r}\n" for i, v in enumerate(values)))
        target = os.path.join(self.folder, "score.json")
        with contextlib.redirect_stdout(io.StringIO()):
            score.main([self.folder, "--json", target])
        with open(target) as handle:
            return json.load(handle)["figures"]

    def test_perfect(self):
        def give(truth):
            if truth["kind"] == "null":
                return answer("no-gap", [], 0.0), truth["holdout_clean"]
            if truth["kind"] in ("outsider", "foreign"):
                return answer("unexplained", ["unknown"], 1.0), truth["holdout_clean"]
            return answer("explained", truth["effects"], 1.0), truth["holdout_clean"]
        found = self.figures(give)
        for key in ("verdicts", "null.right_or_repeats", "single.first", "single.first_or_rival", "multi.all",
                    "outsider.admitted"):
            self.assertEqual(found[key]["rate"], 1.0, key)
        self.assertGreater(found["shrink.ratio"]["median"], 1.0)
        self.assertAlmostEqual(found["shrink.claim_error"]["median"], 0.0)

    def test_always_silent(self):
        found = self.figures(lambda truth: (answer("no-gap", [], 0.0), truth["holdout"]))
        self.assertEqual(found["null.right_or_repeats"]["rate"], 1.0)
        for key in ("single.first", "multi.all", "outsider.admitted"):
            self.assertEqual(found[key]["rate"], 0.0, key)
        self.assertAlmostEqual(found["shrink.z_after"]["median"], 0.0)

    def test_rivals_count_apart(self):
        def give(truth):
            said = answer("ambiguous", ["unknown"], 0.5)
            said["causes"][0]["rivals"] = truth["effects"]
            return said, truth["holdout_clean"]
        found = self.figures(give)
        self.assertEqual((found["single.first"]["rate"], found["single.first_or_rival"]["rate"]), (0.0, 1.0))

    def test_broken_answers_fail(self):
        found = self.figures(lambda truth: ("not json", [1.0, 2.0]))
        self.assertEqual(found["verdicts"]["rate"], 0.0)
        self.assertEqual(found["null.right_or_repeats"]["rate"], 0.0)
        self.assertIsNone(found["shrink.ratio"]["median"])
        self.assertGreater(found["shrink.ratio"]["missing"], 0)

    def test_claims_beside_forms(self):
        truth, forms = ["C.backlash", "Y.cyclic"], {"X.straightness": 2.0, "X.scale": 0.3, "Z.positioning": 0.69}
        for claim, free in (("C.backlash", False), ("X.straightness", True), ("X.straightness", False),
                            ("Y.positioning", True), ("free form of X", True), ("free form of Y", True)):
            self.assertTrue(is_right(claim, free, truth, forms), claim)
        for claim, free in (("X.angular", True), ("X.scale", False), ("Z.positioning", True), ("free form of Z", True),
                            ("Y.positioning", False), ("C.positioning", True), ("free form of C", True)):
            self.assertFalse(is_right(claim, free, truth, forms), claim)

    def test_true_errors_may_be_named_before_the_effect(self):
        record = {"truth": ["C.backlash"], "forms": {"X.scale": 3.0, "Y.scale": 0.2}, "free": [False, False]}
        for before, right in (("X.scale", True), ("Y.scale", False), ("Z.angular", False)):
            self.assertEqual(score.first_but_true({**record, "claimed": [before, "C.backlash"]}), right, before)
        self.assertFalse(score.first_but_true({**record, "claimed": ["X.scale", "Z.angular"]}))

    def test_every_false_claim_counts(self):
        def give(truth):
            said = answer("explained", ["Q.angular", *truth["effects"]], 1.0)
            said["causes"][0]["form"] = "table"
            return said, truth["holdout_clean"]
        found = self.figures(give)
        self.assertEqual(found["claims.0.95.free form"]["rate"], 0.0)
        self.assertEqual(found["claims.0.95.named"]["hits"],
                         sum(len(t["effects"]) for t in self.truths if t["kind"] in ("single", "multi", "outliers")))

    def test_wilson(self):
        low, high = wilson(0, 162)
        self.assertEqual(low, 0.0)
        self.assertAlmostEqual(high, 0.0232, places=3)


if __name__ == "__main__":
    unittest.main()
