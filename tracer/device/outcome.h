/*
 * Known results of the families of traversal kernels on a device: those of `relume devices --check`, and the crashes,
 * hangs and refusals of earlier runs. They are kept for later runs and decide which family a device runs.
 *
 * Each device has one file in a cache folder (base/kept.h). It is valid for one device name, platform, driver, version
 * and source text of the kernels. With another driver or other kernels it is ignored, and the next outcome replaces it.
 * A truncated or damaged file is treated as missing.
 */
#pragma once

#include "tracer/device/device.h"
#include "tracer/device/fault.h"

enum outcome_state {
	OUTCOME_UNTRIED,
	OUTCOME_RIGHT,
	OUTCOME_WRONG,  /* its picture differs from that of the C twins */
	OUTCOME_FAILED, /* it ended in an error, or the driver ended the process */
	OUTCOME_LATE,   /* it did not finish in time */
	OUTCOME_PASSED_OVER, /* it is not meant for such devices */
	N_OUTCOME_STATES
};

struct outcome_family {
	uint32_t state;    /* enum outcome_state */
	char where[120]; /* wrong scenes ("mirror, glass") or the failure ("SIGABRT in camera_packet"); "": all right */
	double compile_s;  /* time to compile all its kernels without a cache */
	double frame_s;    /* time of a frame, once all is compiled; 0: not measured */
};

struct outcome {
	struct outcome_family families[N_DEVICE_FAMILIES];
};

/** Read the outcome of a device. @return 1: found; 0: nothing is known of the device */
int outcome_read(const char *folder, const struct device_description *device, struct outcome *out);

/** Store an outcome. If the folder cannot be written, one warning is printed. */
void outcome_write(const char *folder, const struct device_description *device, const struct outcome *outcome);

/** The fastest family known to be right. If there is none: `preferred`, or else the next family without a known
 * problem. -1: there is none */
int outcome_best(const struct outcome *outcome, enum device_family preferred);

/** "draws wrong pictures (mirror, glass)" and the like. @return text */
const char *outcome_words(const struct outcome_family *family, char *text, size_t size);

/* Faults of this run, in the order that its processes ran. */
struct outcome_run {
	struct fault faults[32];
	size_t n;
};

/**
 * Choose the best family for a device, from the outcomes in a folder and the faults of this run. Prints a message if it
 * is not the default for the type of device, unless a fault of this run is the reason: outcome_confirm then prints it
 * later.
 * @param asked   a family to use whatever is known, with a message if it is not right; -1: none
 * @param folder  folder of outcomes; NULL: nothing is known
 * @return 0, or ERR_SYSTEM (reported): no family is right
 */
int outcome_choose(struct device *dev, int asked, const char *folder, const struct outcome_run *run);

/** As outcome_choose, with the user's folder and no faults: for commands other than `relume render`. */
int outcome_choose_known(struct device *dev);

/** 1: after the faults of this run, outcome_choose has no family left. */
int outcome_is_hopeless(const struct device *dev, int asked, const char *folder, const struct outcome_run *run);

/** Call once the device has made a picture with the family chosen after a fault of this run. Prints why that family was
 * chosen, and stores the faults. */
void outcome_confirm(struct device *dev, const char *folder, const struct outcome_run *run);

/** Store the faults of a device's compiler in this run. Other faults may be caused by a frame: outcome_confirm stores
 * those. */
void outcome_remember_builds(const struct device *dev, const char *folder, const struct outcome_run *run);
