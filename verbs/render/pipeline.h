/*
 * Renders frames in parallel: one thread decodes the recording into scenes, workers trace them, writers pack and write
 * pictures. Queues between them are bounded, so memory does not grow with the number of frames.
 *
 *     replay -> [shots] -> workers (one tracer each, several to a device) -> [pictures] -> writers -> files
 *
 * Workers start as scenes need them. Where memory would be short for a third frame, fewer are under way than --jobs
 * allows. Devices take scenes as they become free, so faster ones do more. A frame depends on its scene alone: files
 * are the same bytes whatever the number of workers. Of a turntable (look/camera/camera.h), all pictures come from one
 * scene. A device that fails hands its scene to the others and is not used again; with the last device the run fails.
 */
#pragma once

#include "replay/replay.h"
#include "verbs/render/carried.h"
#include "verbs/render/settings.h"
#include "verbs/render/stamp.h"
#include "verbs/render/watch.h"

struct pipeline {
	const struct settings *settings;
	struct replay *replay;
	struct watch *watch;
	struct device **devices; /* [n_devices] */
	size_t n_devices;
	unsigned jobs;           /* workers on each device */
	uint64_t end;            /* frames of the recording */
	double start_s;          /* when the run began (progress_clock_s) */
	struct stamp stamp;
	struct carried *carried; /* filled in: progress, for this process or the next */
	uint64_t *shares;        /* [n_devices], filled in: frames that each device traced; the caller frees it */
	struct display *display; /* how to make display pictures; NULL: the files are OpenEXR */
	const char *outcomes;    /* folder of known outcomes of devices' families; NULL: none */
	const char *remembered;  /* the same for this run's faults; also NULL if a user's hook may be to blame */
};

/**
 * Render the frames that the settings ask for.
 * @return 0, also if a signal ended the run early (watch_signal); ERR_INPUT, ERR_SYSTEM (reported)
 */
int pipeline_run(struct pipeline *p);
