#!/bin/sh
# limit: 300 s
# Answers of relume-rays.h against tests of all triangles, with new ones in each run, on OpenCL and on the C twins: a
# short form of make show-query. QUERIES_SEED repeats a run.
seed=${QUERIES_SEED:-$(date +%s)}
echo "QUERIES_SEED=$seed"
"$RELUME_BUILD/tests/bench/queries" --count 3000 --rates 0 --seed "$seed" &&
	"$RELUME_BUILD/tests/bench/queries" --count 1000 --rates 0 --seed "$seed" --device reference
