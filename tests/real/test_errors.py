#!/usr/bin/python3
"""The replay must refuse exactly those calls of tests/real/errors.c that OpenGL refuses. A refused call changes
nothing; one executed by mistake would show in later errors. Compares the number of errors per command.
"""
import collections
import json

from helpers import BUILD, SCRATCH, check, finish, must, record, relume

trace = SCRATCH / "errors.trace"
lines = [line.split() for line in record(trace, BUILD / "tests/real/errors", options=()).stdout.splitlines()]
printed = collections.Counter(call for call, error in lines if error != "0")
found = {row["call"]: row["count"] for row in json.loads(must(relume("info", "--json", trace)).stdout)["gl_errors"]}
check(len(lines) > 350 and sum(printed.values()) > 130, f"{len(lines)} calls, {sum(printed.values())} of them wrong")
for call in sorted({call for call, _ in lines} | set(found)):
    check(printed[call] == found.get(call, 0), f"{call}: {found.get(call, 0)} refused, expected {printed[call]}")
finish()
