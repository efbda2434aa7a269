#!/usr/bin/python3
"""Consistency of a release: one version everywhere, working links in documents, CI files that run `make check` and
`make lint`."""
import pathlib
import re
import shutil
import subprocess
import sys
import tomllib
import unittest

import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SUITES = {"bookworm", "trixie"}
LINT_IMAGE = "debian:bookworm"
README_LINES = 120
PAGES = [ROOT / name
         for name in ("README.md", "HACKING.md", "CONTRIBUTING.md", "SECURITY.md", "CHANGELOG.md")] + sorted(
             (ROOT / "docs").glob("*.md"))


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


def anchors(page):
    """GitHub's anchors for a page's headings."""
    headings = re.findall(r"^#+ (.*)$", page.read_text(encoding="utf-8"), re.M)
    return {re.sub(r"[^\w -]", "", heading.lower()).replace(" ", "-") for heading in headings}


class Version(unittest.TestCase):
    def test_it_is_a_semantic_version_in_one_line(self):
        self.assertRegex(text("VERSION"), r"\A(0|[1-9]\d*)\.(0|[1-9]\d*)\.(0|[1-9]\d*)\n\Z")

    def test_changelogs_begin_with_it(self):
        version = text("VERSION").strip()
        self.assertTrue(text("packaging/debian/changelog").startswith(f"relume ({version}) "))
        sections = re.findall(r"^## \[(.*?)\](.*)$", text("CHANGELOG.md"), re.M)
        self.assertEqual([name for name, _ in sections][:2], ["Unreleased", version])
        for name, day in sections[1:]:
            self.assertRegex(day, r"^ - 20\d\d-\d\d-\d\d$", name)

    def test_no_other_file_states_it(self):
        for name in ("base/version.h", "Makefile", "packaging/install.sh", "packaging/deb.sh", "packaging/relume.pc.in",
                     "packaging/relume-rays.pc.in"):
            self.assertNotIn(text("VERSION").strip(), text(name), name)


class Documents(unittest.TestCase):
    def test_the_readme_is_short(self):
        self.assertLessEqual(text("README.md").count("\n"), README_LINES)

    def test_links_lead_somewhere(self):
        for page in PAGES:
            for target, anchor in re.findall(r"\]\((?!https?:)([^)#\s]*)(?:#([^)\s]*))?\)",
                                             page.read_text(encoding="utf-8")):
                there = (page.parent / target).resolve() if target else page
                self.assertTrue(there.exists(), f"{page.name} links {target}")
                if anchor:
                    self.assertIn(anchor, anchors(there), f"{page.name} links {target}#{anchor}")

    def test_named_files_exist(self):
        for page in PAGES:
            for name in re.findall(r"`((?:[a-z_-]+/)+[\w.-]+\.(?:h|c|cl|py|md|json|txt|yaml|yml|sh|jpg))`",
                                   page.read_text(encoding="utf-8")):
                self.assertTrue("NAME" in name or name.startswith(("ci/", "build/")) or (ROOT / name).exists(),
                                f"{page.name} names {name}")

    def test_files_of_a_pictures_parts_exist(self):
        rows = re.findall(r"^\| [^`|]+ \| ((?:`\w+\.h`(?:, )?)+) \| `(\w+\.c)` \|$", text("docs/architecture.md"), re.M)
        self.assertGreater(len(rows), 4)
        for kernels, launches in rows:
            for folder, names in (("kernels/frame", re.findall(r"`(.*?)`", kernels)), ("tracer/frame", [launches])):
                for name in names:
                    self.assertTrue(any((ROOT / folder).rglob(name)), f"docs/architecture.md names {folder}/.../{name}")

    def test_each_document_is_in_the_readme(self):
        for page in PAGES[1:]:
            self.assertIn(f"]({page.relative_to(ROOT)})", text("README.md"))

    def test_issue_templates_say_what_they_are_for(self):
        found = sorted((ROOT / ".github/ISSUE_TEMPLATE").glob("*.md"))
        self.assertEqual([page.stem for page in found], ["bug", "feature"])
        for page in found:
            head = re.match(r"---\n(.*?)\n---\n", page.read_text(encoding="utf-8"), re.S)
            self.assertTrue(head, page.name)
            self.assertTrue({"name", "about"} <= set(yaml.safe_load(head[1])), page.name)


class Licence(unittest.TestCase):
    def test_one_annotation_covers_the_tree(self):
        annotation, = tomllib.loads(text("REUSE.toml"))["annotations"]
        self.assertEqual((annotation["path"], annotation["SPDX-License-Identifier"]), ("**", "MIT"))
        self.assertIn(annotation["SPDX-FileCopyrightText"], text("LICENSE"))
        self.assertEqual(text("LICENSES/MIT.txt"), text("LICENSE"))

    def test_headers_that_are_installed_name_it(self):
        headers = re.findall(r"^place \d+ (\S+\.h) ", text("packaging/install.sh"), re.M)
        self.assertGreaterEqual(len(headers), 2)
        for name in headers:
            self.assertRegex(text(name), r"\A/\* SPDX-License-Identifier\: MIT \*/\n")


class Servers(unittest.TestCase):
    def check_suites(self, image, variable, suites):
        self.assertEqual(image, f"debian:{variable}")
        self.assertEqual(set(suites), SUITES)

    def test_suites_are_those_that_the_readme_supports(self):
        supported = re.findall(r"^\| Debian \d+ \((\w+)\) .*\| supported:", text("README.md"), re.M)
        self.assertEqual(set(supported), SUITES)

    def test_github(self):
        jobs = yaml.safe_load(text(".github/workflows/check.yml"))
        self.assertEqual(set(jobs[True]), {"push", "pull_request"}, "YAML 1.1 reads the key `on` as true")
        self.assertEqual(jobs["permissions"], {"contents": "read"}, "a check needs to write nothing")
        self.assertTrue(jobs["jobs"])
        self.assertEqual(set(jobs["jobs"]), {"check", "lint"})
        for name, job in jobs["jobs"].items():
            if name == "lint":
                self.assertEqual(job["container"]["image"], LINT_IMAGE)
            else:
                self.check_suites(job["container"]["image"], "${{ matrix.suite }}", job["strategy"]["matrix"]["suite"])
                self.assertFalse(job["strategy"]["fail-fast"], name)
            steps = [step.get("run", step.get("uses", "")) for step in job["steps"]]
            self.assertEqual(steps[-1], f"make {name}", name)
            checkout = next(i for i, step in enumerate(steps) if step.startswith("actions/checkout@"))
            self.assertTrue(any(re.search(r"apt-get install .*\bgit make$", step) for step in steps[:checkout]),
                            "bare images have no git and no make")

    def test_gitlab(self):
        jobs = yaml.safe_load(text(".gitlab-ci.yml"))
        self.assertEqual(set(jobs), {"check", "lint"})
        for name, job in jobs.items():
            if name == "lint":
                self.assertEqual(job["image"], LINT_IMAGE)
            else:
                matrix = job["parallel"]["matrix"]
                self.check_suites(job["image"], "$SUITE", [suite for row in matrix for suite in row["SUITE"]])
            self.assertEqual(job["script"], [f"make {name}"], name)
            self.assertTrue(any(re.search(r"apt-get install .*\bgit make$", line) for line in job["before_script"]),
                            name)
            self.assertNotIn("allow_failure", job, name)

    @unittest.skipUnless(shutil.which("check-jsonschema"), "check-jsonschema (PyPI) is not installed; make lint has it")
    def test_schemas(self):
        for files, options in (((".github/workflows/check.yml", "packaging/recipes/github.yml"),
                                ("--builtin-schema", "vendor.github-workflows")),
                               ((".gitlab-ci.yml", "packaging/recipes/gitlab-ci.yml"),
                                ("--builtin-schema", "vendor.gitlab-ci", "--data-transform", "gitlab-ci"))):
            done = subprocess.run(["check-jsonschema", *options, *files], cwd=ROOT, capture_output=True, text=True,
                                  check=False)
            self.assertEqual(done.returncode, 0, done.stdout)


if __name__ == "__main__":
    program = unittest.main(exit=False)
    failed = len(program.result.failures) + len(program.result.errors)
    print(f"{0 if failed else 100}%: Checks: {program.result.testsRun}, Failures: {failed}, Errors: 0")
    sys.exit(1 if failed else 0)
