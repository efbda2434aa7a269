/*
 * What is known of the families of traversal kernels on a device: what `relume devices --check` found out, and what
 * crashed, hung or was refused in an earlier run. It is kept for later runs, and decides which family a device runs.
 *
 * One file a device, in a cache folder (base/kept.h). It counts for the device's name, platform, driver and version,
 * and for the text of the kernels: with another driver or other kernels nothing is known again, and the next outcome
 * takes the file's place. A file that is cut or damaged counts as none.
 */
#pragma once

#include "tracer/device/device.h"
#include "tracer/device/fault.h"

enum outcome_state {
	OUTCOME_UNTRIED,
	OUTCOME_RIGHT,
	OUTCOME_WRONG,  /* it draws something else than the C twins */
	OUTCOME_FAILED, /* it ends in an error, or the driver ends the process */
	OUTCOME_LATE,   /* it was not done in time */
	OUTCOME_PASSED_OVER, /* it is not for such devices */
	N_OUTCOME_STATES
};

struct outcome_family {
	uint32_t state;    /* enum outcome_state */
	char where[120]; /* the scenes that are not right, "mirror, glass", or what failed, "SIGABRT in camera_packet";
	                    "" where all is right */
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

/** The fastest family that is right. Where none is: `preferred`, else the next one, that nothing is known against. -1:
 * there is none */
int outcome_best(const struct outcome *outcome, enum device_family preferred);

/** "draws wrong pictures (mirror, glass)" and the like. @return text */
const char *outcome_words(const struct outcome_family *family, char *text, size_t size);

/* Faults of this run, in the order of its processes. */
struct outcome_run {
	struct fault faults[32];
	size_t n;
};

/**
 * Have a device run the best family, as far as a folder and this run's faults tell; say so where that is not the one
 * that suits its kind. Where a fault of this run is the reason, outcome_confirm says it later.
 * @param asked   a family to take whatever is known (it is said where it is not right); -1: none
 * @param folder  NULL: nothing is known
 * @return 0, or ERR_SYSTEM (reported): no family is right
 */
int outcome_choose(struct device *dev, int asked, const char *folder, const struct outcome_run *run);

/** As outcome_choose, for what is not `relume render`: the user's folder, no faults. */
int outcome_choose_known(struct device *dev);

/** 1: faults of this run have left outcome_choose nothing. */
int outcome_is_hopeless(const struct device *dev, int asked, const char *folder, const struct outcome_run *run);

/** The device has made a picture with the family that outcome_choose took after a fault of this run: say why that one,
 * and remember the faults. */
void outcome_confirm(struct device *dev, const char *folder, const struct outcome_run *run);

/** Remember what a device's compiler did to programs in this run. Other faults may be a frame's: outcome_confirm. */
void outcome_remember_builds(const struct device *dev, const char *folder, const struct outcome_run *run);
