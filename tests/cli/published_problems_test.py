# SPDX-License-Identifier: Apache-2.0
"""Problems that others published (corpus/formats/published.md): read, judged and solved as that table says.

They are no part of this project: STICTION_DATA names the folder that has them.
"""

import os
import pathlib
import subprocess
import sys
import unittest

import cli

# file: contacts, dimension, order of magnitude of the largest abs(A - A')
FILES = {
    "lcp/lcp_CPS_1.dat": (2, 2, 0), "lcp/lcp_CPS_2.dat": (3, 2, 3), "lcp/lcp_CPS_3.dat": (4, 2, 10),
    "lcp/lcp_CPS_4.dat": (4, 2, 2), "lcp/lcp_CPS_4bis.dat": (4, 2, 2), "lcp/lcp_CPS_5.dat": (2, 2, 0),
    "lcp/lcp_deudeu.dat": (2, 2, 0), "lcp/lcp_exp_murty.dat": (6, 2, 2), "lcp/lcp_trivial.dat": (9, 2, 0),
    "friction/FC2D_SliderCrankLagrangian00000.dat": (2, 2, 3e-4),
    "friction/FrictionContactProblem00031.dat": (11, 2, 3e-17),
    "friction/FC3D_Example1.dat": (3, 3, 0), "friction/FC3D_Example1_SBM.dat": (3, 3, 0),
    "friction/FrictionContact3D_1c.dat": (1, 3, 0), "friction/NESpheres_10_1.dat": (9, 3, 1e-16),
    "friction/Rover11035.dat": (1, 3, 1.2e-6), "friction/Rover4396.dat": (2, 3, 2.7e-6),
    "friction/Rover1039.dat": (4, 3, 1e-6), "friction/Confeti-ex13-4contact-Fc3D-SBM.dat": (4, 3, 0),
    "fclib/CubeH8.hdf5": (1, 3, 2e-14),
}
# In space, more contacts.
LARGER = {
    "friction/OneObject-i100000-316.hdf5.dat": 25, "friction/Confeti-ex03-Fc3D-SBM.dat": 54,
    "fclib/fclib_local_problem_test.hdf5": 48, "fclib/Spheres-i099-356-679.hdf5": 356,
    "friction/Capsules-i100-889.dat": 276, "fclib/Capsules-i125-1213.hdf5": 286,
}
RESIDUAL = 1e-8


class PublishedProblems(cli.TestCase):
    def survey(self, names):
        folder = pathlib.Path(os.environ["STICTION_DATA"])
        entries = self.succeeds("survey", *(folder / name for name in names), "--json", timeout=900).json()
        return dict(zip(names, entries, strict=True))

    def test_every_file_is_read_as_what_it_is(self):
        for name, entry in self.survey(FILES).items():
            contacts, dimension, asymmetry = FILES[name]
            with self.subTest(file=name):
                self.assertEqual((entry["contacts"], entry["dimension"]), (contacts, dimension))
                found = entry["asymmetry"]["difference"]
                self.assertTrue(0.8 * asymmetry <= found <= 1.2 * asymmetry, found)

    def test_all_planar_ones_are_solved_exactly(self):
        planar = [name for name in FILES if FILES[name][1] == 2]
        for name, entry in self.survey(planar).items():
            for variant in (entry, entry.get("symmetrized", entry)):
                with self.subTest(file=name):
                    exact = variant["runs"][-1]
                    self.assertEqual((exact["arithmetic"], exact["certificate"]), ("exact", "solution-exists"))

    def is_certified(self, name, contacts):
        """Within the limits of both checkers, which refuse it once a force is altered."""
        proof = self.folder / "proof.json"
        self.succeeds("certify", pathlib.Path(os.environ["STICTION_DATA"]) / "friction" / f"{name}.dat", "-o", proof)
        certificate = cli.json.loads(proof.read_text())
        self.assertEqual(certificate["claim"], "solution-exists")
        self.assertEqual(len(certificate["problem"]["contacts"]), contacts)
        f = certificate["witness"]["f"]
        loaded = next(i for i in reversed(range(len(f))) if f[i] != "0")
        f[loaded] = f[loaded] + "1" if "/" not in f[loaded] else "1" + f[loaded].lstrip("-")
        altered = self.file("altered.json", cli.json.dumps(certificate))
        checker = [sys.executable, cli.ROOT / "certify/check_certificate.py"]
        for file, code in ((proof, 0), (altered, 1)):
            self.assertEqual(cli.run("check", file).code, code, file)
            done = subprocess.run([*checker, file], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, code, done.stdout)

    def test_many_contacts_are_certified(self):
        self.is_certified("fc2d_granularflowonwall_00667_00000", 667)

    @unittest.skipUnless(cli.ALL, "long")
    def test_long_forces_are_certified(self):
        self.is_certified("FrictionContactProblem00237", 376)

    @unittest.skipUnless(cli.ALL, "long")
    def test_large_planar_ones_are_solved_with_a_verified_residual(self):
        large = {"friction/FrictionContactProblem00237.dat": 376,
                 "friction/fc2d_granularflowonwall_00667_00000.dat": 667,
                 "friction/fc2d_granularflowonwall_07002_00801.dat": 7002}
        folder = pathlib.Path(os.environ["STICTION_DATA"])
        paths = [folder / name for name in large]
        entries = self.succeeds("survey", *paths, "--rows", 0, "--json", timeout=600).json()
        for contacts, entry in zip(large.values(), entries, strict=True):
            with self.subTest(contacts=contacts):
                self.assertEqual(entry["contacts"], contacts)
                [run] = entry["runs"]
                self.assertEqual((run["method"], run["outcome"]), ("proximal", "solved"))
                self.assertLess(run["residual"], 1e-8)  # of every contact in its own units

    def test_all_in_space_obey_coulombs_law(self):
        spatial = [name for name in FILES if FILES[name][1] == 3] + (list(LARGER) if cli.ALL else [])
        for name, entry in self.survey(spatial).items():
            if name in LARGER:
                self.assertEqual(entry["contacts"], LARGER[name])
            for variant in (entry, entry.get("symmetrized", entry)):
                with self.subTest(file=name):
                    doubles, *exact = variant["runs"]
                    self.assertEqual(doubles["outcome"], "solved")
                    self.assertLessEqual(doubles["residual"], RESIDUAL)
                    if name in FILES:
                        self.assertEqual([run["certificate"] for run in exact], ["coulomb-solution"])
                        self.assertLess(exact[0]["cosine gap"], RESIDUAL)

    def test_two_storages_of_one_problem_are_the_same_problem(self):
        folder = pathlib.Path(os.environ["STICTION_DATA"]) / "friction"
        problems = []
        for name in ("FC3D_Example1", "FC3D_Example1_SBM"):
            out = self.folder / f"{name}.json"
            self.succeeds("import", folder / f"{name}.dat", "-o", out)
            problem = cli.json.loads(out.read_text())
            problems.append([problem[key] for key in ("contacts", "A", "b")])
        self.assertEqual(*problems)


if __name__ == "__main__":
    if "STICTION_DATA" not in os.environ:
        print(f"SKIPPED: STICTION_DATA does not name the folder of {len(FILES)} published problems")
        sys.exit(0)
    cli.main()
