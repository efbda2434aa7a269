#!/usr/bin/python3
"""`relume help`, --help of every verb, and messages for wrong usage."""
import re

from helpers import ROOT, check, finish, relume

COLUMNS = 120
overview = relume("help")
verbs = re.findall(r"^  (\w+) ", overview.stdout, re.M)
check(overview.returncode == 0 and not overview.stderr, "help goes to standard output and exits with 0")
check({"record", "info", "index", "dump", "scene", "render", "raster", "diff", "devices", "bench"} <= set(verbs),
      f"help lists the verbs: {verbs}")
groups = {
    title: re.findall(r"^  (\w+) ", body, re.M)
    for title, body in re.findall(r"^(\w[\w ]*):\n\n((?:  \w+ .*\n)+)", overview.stdout, re.M)
}
check(
    list(groups) == ["First steps", "Record and inspect", "Render", "Compare", "Farm", "Research", "Help"],
    f"the verbs are in groups: {list(groups)}")
check(groups["First steps"] == ["record", "info", "render", "look", "film", "diff", "approve", "ci"],
      f"the first group has eight verbs: {groups['First steps']}")
check(sum(groups.values(), []) == verbs and len(set(verbs)) == len(verbs), f"each verb is in one group: {groups}")
check(relume("help", "help").stdout == overview.stdout, "`help help` prints the help")
check(relume().returncode == 2, "no verb is wrong usage")
check(relume("paint").returncode == 2, "an unknown verb is wrong usage")
near, far = relume("rendr"), relume("paint")
check("unknown command 'rendr'; did you mean 'render'? 'relume help' lists them\n" in near.stderr
      and "did you mean" not in far.stderr,
      f"a similar verb is suggested: {near.stderr}{far.stderr}")
version = relume("--version")
check(version.returncode == 0 and version.stdout == f"relume {(ROOT / 'VERSION').read_text()}",
      f"--version: {version.stdout}")
for words, said in ((("render", "--frmes", "1"), "render has no option '--frmes', but --frames;"),
                    (("render", "--zzz"), "render has no option '--zzz';"), (("render", "--samples", "0"),
                                                                             "--samples takes a number from 1 to "),
                    (("render", "--samples", "many"), "--samples takes a number from 1 to "),
                    (("render", "--rays", "0"), "--rays takes a number from 1 to "), (("render", "-y"),
                                                                                      "render has no option '-y';"),
                    (("render", "--frames"), "render: --frames takes a value;"), (("render", "-f"),
                                                                                  "render: -f takes a value;"),
                    (("render", "--no-cache=2"), "render: --no-cache takes no value"), (("render", "--no-cache", "-yq"),
                                                                                        "render has no option '-y';")):
    wrong = relume(*words)
    check(wrong.returncode == 2 and said in wrong.stderr and wrong.stderr.count("\n") == 1,
          f"{' '.join(words)}: {wrong.stderr}")

for verb in verbs:
    if verb == "help":
        continue
    by_option, by_help = relume(verb, "--help"), relume("help", verb)
    check(by_option.returncode == 0 and not by_option.stderr, f"{verb} --help exits with 0, silent on standard error")
    check(by_option.stdout.startswith(f"usage: relume {verb}"), f"{verb} --help prints its usage:\n{by_option.stdout}")
    check(by_option.stdout == by_help.stdout, f"help {verb} prints the same")
    wrong = relume(verb, "--no-such-option")
    check(wrong.returncode == 2 and wrong.stderr, f"{verb} refuses an unknown option: exit code {wrong.returncode}")
    check("--no-such-option" in wrong.stderr, f"{verb} names the unknown option: {wrong.stderr}")

formats = re.findall(r"^  (\w+-file) ", overview.stdout, re.M)
check(len(formats) >= 5, f"help lists the formats of files: {formats}")
for topic in verbs + formats:
    wide = [line for line in relume("help", topic).stdout.split("\n") if len(line) > COLUMNS]
    check(not wide, f"help {topic} has lines wider than {COLUMNS} columns: {wide}")
finish()
