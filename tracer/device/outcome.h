/*
 * What `relume devices --check` found out about the families of traversal kernels on a device, kept for later runs, and which family a
 * device runs because of it.
 *
 * One file a device, in a cache folder (base/kept.h). It counts for the device's name, platform, driver and version, and for the text
 * of the kernels: with another driver or other kernels nothing is known again, and the next check takes the file's place. A file
 * that is cut or damaged counts as none.
 */
#pragma once

#include "tracer/device/device.h"

enum outcome_state {
	OUTCOME_RIGHT,
	OUTCOME_WRONG,  /* it draws something else than the C twins */
	OUTCOME_FAILED, /* it ends in an error, or the driver ends the process */
	OUTCOME_LATE,   /* it was not done in time */
	OUTCOME_PASSED_OVER, /* it is not for such devices */
	N_OUTCOME_STATES
};

struct outcome_family {
	uint32_t state;    /* enum outcome_state */
	char where[60];    /* the scenes that are not right, "mirror, glass"; "" where all are */
	double compile_s;  /* of all its kernels, nothing kept */
	double frame_s;    /* of a frame, once all is compiled; 0: not measured */
};

struct outcome {
	struct outcome_family families[N_DEVICE_FAMILIES];
};

/** @return 1: *out is what is known of the device; 0: nothing is */
int outcome_read(const char *folder, const struct device_description *device, struct outcome *out);

/** Keep an outcome. Where the folder cannot be written, one warning says so. */
void outcome_write(const char *folder, const struct device_description *device, const struct outcome *outcome);

/** The fastest family that is right; -1: none is. */
int outcome_fastest(const struct outcome *outcome);

/** "draws wrong pictures (mirror, glass)" and the like. @return text */
const char *outcome_words(const struct outcome_family *family, char *text, size_t size);

/**
 * Have a device run the fastest family that is right, as far as a folder tells; say so where that is not the one that suits its kind.
 * @param asked   a family to take whatever is known (it is said where it is not right); -1: none
 * @param folder  NULL: nothing is known
 * @return 0, or ERR_SYSTEM (reported): no family is right
 */
int outcome_choose(struct device *dev, int asked, const char *folder);
