#!/usr/bin/python3
"""Of the calls of tests/real/errors.c the replay refuses those that OpenGL does, and no other ones: what is refused
changes nothing, and what is done all the same would be seen later. How many of each command are wrong is compared.
"""
import collections
import json

from helpers import BUILD, SCRATCH, check, finish, must, record, relume

trace = SCRATCH / "errors.trace"
lines = [line.split() for line in record(trace, BUILD / "tests/real/errors", options=()).stdout.splitlines()]
told = collections.Counter(call for call, error in lines if error != "0")
found = {row["call"]: row["count"] for row in json.loads(must(relume("info", "--json", trace)).stdout)["gl_errors"]}
check(len(lines) > 350 and sum(told.values()) > 130, f"{len(lines)} calls, {sum(told.values())} of them wrong")
for call in sorted({call for call, _ in lines} | set(found)):
    check(told[call] == found.get(call, 0), f"{call}: {found.get(call, 0)} calls refused, by OpenGL {told[call]}")
finish()
