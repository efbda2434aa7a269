/*
 * Checks whether a family of traversal kernels is right on a device, and how fast it is: it draws all scenes of
 * check_scene.h, and the pictures are compared with those of the C twins.
 *
 * A picture is right if every channel is: at all pixels but one in a thousand (a ray that grazes an edge may fall on
 * either side of it), within 0.002 of the twins' picture, or within 0.2 % for values above 1. tests/check/test_shade.c
 * has the same bounds.
 */
#pragma once

#include "tracer/device/outcome.h"
#include "verbs/render/check/check_scene.h"

/* Pictures that the C twins draw. */
struct check_truth {
	struct image pictures[N_CHECK_SCENES];
};

/* Results of a family. */
struct check_result {
	struct {
		int state;         /* enum outcome_state; -1: not tried, because the process had ended */
		uint32_t n_differ; /* pixels that differ, in the worst channel */
		char channel[32];
	} scenes[N_CHECK_SCENES];
	struct outcome_family all;
};

/** @param truth  check_truth_free, also after an error. @return 0 or ERR_SYSTEM (reported) */
int check_truth_make(struct check_truth *truth);
void check_truth_free(struct check_truth *truth);

/**
 * Compare a picture with that of the twins.
 * @param n_differ  pixels that differ in the worst channel, and its name; left alone if they are already worse. All 0
 * at first
 * @return OUTCOME_RIGHT or OUTCOME_WRONG
 */
enum outcome_state check_compare(const struct image *want, const struct image *found, uint32_t *n_differ,
                                 char channel[32]);

/** As device_list, in a separate process. */
int check_list(struct device_description **out, size_t *n);

/**
 * Draw all scenes with a family, in a separate process. Kernels are recompiled: no cache is used, neither ours nor
 * PoCL's (unless POCL_KERNEL_CACHE says so).
 * @param device   its index in the list
 * @param seconds  limit for one scene
 * @return 0, or ERR_SYSTEM (reported): no result
 */
int check_family(const struct check_truth *truth, size_t device, enum device_family family, double seconds,
                 struct check_result *out);
