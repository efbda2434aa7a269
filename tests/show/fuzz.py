#!/usr/bin/python3
"""tests/show/fuzz.py BUILD (as `make show-fuzz`): the totals of all libFuzzer campaigns, by target.

`make fuzz` runs campaigns and adds to BUILD/fuzz/sums.json; `make fuzz-keep` moves that to tests/fuzz/sums.json.
Nothing is run here. The edges column counts those that some input reached, out of all edges linked into the target,
including those of other readers and of the sanitizers.
"""
import json
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
HOURS, STATE_EDGES = 8, 12_000


def main(build):
    sums = {}
    for path in (ROOT / "tests/fuzz/sums.json", build / "fuzz/sums.json"):
        for target, row in (json.loads(path.read_text()) if path.exists() else {}).items():
            all_of = sums.setdefault(target, dict.fromkeys(row, 0))
            for name, value in row.items():
                all_of[name] = max(all_of[name], value) if name in ("edges", "of") else all_of[name] + value
    print(f"{'target':<12} {'processor s':>12} {'runs':>12} {'edges':>8} {'of':>8} {'findings':>9}")
    for target, row in sorted(sums.items()):
        print(
            f"{target:<12} {row['seconds']:>12.0f} {row['runs']:>12.0f} {row['edges']:>8} {row['of']:>8} "
            f"{row['findings']:>9.0f}"
        )
    hours = sum(row["seconds"] for row in sums.values()) / 3600
    edges = max((sums[t]["edges"] for t in ("calls", "replay", "snapshot") if t in sums), default=0)
    missing = {path.stem[5:] for path in (ROOT / "tests/fuzz").glob("fuzz_*.c")} - set(sums)
    rows = [{
        "what": "processor hours over all targets", "figure": round(hours, 2), "bar": HOURS, "peer": None,
        "passed": hours >= HOURS
    }, {
        "what": "edges of the state machine", "figure": edges, "bar": STATE_EDGES, "peer": None, "passed": edges
        >= STATE_EDGES
    }, {
        "what": "targets that no campaign has run", "figure": " ".join(sorted(missing)) or 0, "bar": 0, "peer": None,
        "passed": not missing
    }]
    for row in rows:
        print(f"{'holds' if row['passed'] else 'FALLS SHORT'}  {row['what']}: {row['figure']} (bar {row['bar']})")
    (build / "show").mkdir(exist_ok=True)
    (build / "show/fuzz.json").write_text(
        json.dumps({"name": "fuzz", "command": "make show-fuzz", "rows": rows}, indent=1))
    return any(not row["passed"] for row in rows)


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1])))
