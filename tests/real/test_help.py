#!/usr/bin/python3
"""`relume help`, --help of every verb, and what wrong usage looks like."""
import re

from helpers import check, finish, relume

overview = relume("help")
verbs = re.findall(r"^  (\w+) ", overview.stdout, re.M)
check(overview.returncode == 0 and not overview.stderr, "help goes to standard output and exits with 0")
check({"record", "info", "index", "dump", "scene", "render", "raster", "diff", "devices", "bench"} <= set(verbs),
      f"help lists the verbs: {verbs}")
check(relume().returncode == 2, "no verb is wrong usage")
check(relume("paint").returncode == 2, "an unknown verb is wrong usage")

for verb in verbs:
    if verb == "help":
        continue
    by_option, by_help = relume(verb, "--help"), relume("help", verb)
    check(by_option.returncode == 0 and not by_option.stderr, f"{verb} --help exits with 0, silent on standard error")
    check(by_option.stdout.startswith(f"usage: relume {verb}"), f"{verb} --help says its usage:\n{by_option.stdout}")
    check(by_option.stdout == by_help.stdout, f"help {verb} prints the same")
    wrong = relume(verb, "--no-such-option")
    check(wrong.returncode == 2 and wrong.stderr, f"{verb} refuses an unknown option: exit code {wrong.returncode}")
    check("--no-such-option" in wrong.stderr, f"{verb} names the unknown option: {wrong.stderr}")
finish()
