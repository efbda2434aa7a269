#!/bin/sh
# limit: 300 s
# Hits of the kernels against Embree's, ray by ray, with new rays in each run: a short form of make show-hits. HITS_SEED
# repeats a run.
seed=${HITS_SEED:-$(date +%s)}
echo "HITS_SEED=$seed"
"$RELUME_BUILD/tests/bench/hits" --rays 140000 --models "${MODELS:-../shared/models}" --seed "$seed"
