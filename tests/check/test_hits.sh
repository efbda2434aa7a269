#!/bin/sh
# limit: 300 s
# Hits of the kernels against Embree's, ray by ray: a short form of make show-hits, on rays by chance.
"$RELUME_BUILD/tests/bench/hits" --rays 140000 --models "${MODELS:-../shared/models}" --seed "$(date +%s)"
