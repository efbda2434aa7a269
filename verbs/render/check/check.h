/*
 * Whether a family of traversal kernels is right on a device, and how fast: it draws all scenes of check_scene.h there,
 * and they are compared with what the C twins draw.
 *
 * A picture is right where each channel is: at all pixels but one in a thousand (a ray that grazes an edge may fall on
 * either side of it) within 0.002, or 0.2 % of numbers above 1, of the twins' picture. tests/check/test_shade.c has the
 * same bounds.
 */
#pragma once

#include "tracer/device/outcome.h"
#include "verbs/render/check/check_scene.h"

/* What the C twins draw. */
struct check_truth {
	struct image pictures[N_CHECK_SCENES];
};

/* What a family draws. */
struct check_result {
	struct {
		int state;         /* enum outcome_state; -1: not tried, as the process had ended */
		uint32_t n_differ; /* pixels, in the channel that differs most */
		char channel[32];
	} scenes[N_CHECK_SCENES];
	struct outcome_family all;
};

/** @param truth  check_truth_free, also after an error. @return 0 or ERR_SYSTEM (reported) */
int check_truth_make(struct check_truth *truth);
void check_truth_free(struct check_truth *truth);

/**
 * Compare a picture with what the twins draw.
 * @param n_differ  pixels in the channel that differs most, and its name; both are kept where they are worse already.
 * All 0 at first
 * @return OUTCOME_RIGHT or OUTCOME_WRONG
 */
enum outcome_state check_compare(const struct image *want, const struct image *found, uint32_t *n_differ,
                                 char channel[32]);

/** As device_list, in a process of its own. */
int check_list(struct device_description **out, size_t *n);

/**
 * Draw all with a family, in a process of its own. Kernels are compiled anew: nothing is taken from a cache, ours or
 * PoCL's (unless POCL_KERNEL_CACHE says so).
 * @param device   its place in the list
 * @param seconds  that a scene may take
 * @return 0 or ERR_SYSTEM (reported): nothing could be found out
 */
int check_family(const struct check_truth *truth, size_t device, enum device_family family, double seconds,
                 struct check_result *out);
