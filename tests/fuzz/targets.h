/* The targets in drive.c, one fuzz_NAME.c each. `replay` and `calls` have tests of their own. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#define TARGETS(X) \
	X(container) X(verbs) X(index) X(snapshot) X(ref) X(exr) X(oiio) X(look) X(rules) X(baseline) X(json) X(gltf) \
	X(tree) X(outcome) X(farm) X(recorder) X(glsl) X(arb)
