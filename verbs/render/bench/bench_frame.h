/* relume bench TRACE: the time that each kernel of one frame takes. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#include "tracer/device/device.h"
#include "tracer/frame/trace.h"

struct look;

/* The frame to render, and how often. */
struct bench_frame {
	const char *trace;
	uint64_t frame;
	const struct look *look; /* rules; NULL: none */
	enum tracer_mode mode;
	size_t n;
	int json;
};

/**
 * Render a frame of a recording 1 + n times and print the means of the last n: the whole frame, each kernel, copies,
 * and the rest, which is the host's own work (trees, matrices, composing). Waits for each kernel.
 * @return 0 or ERR_* (reported)
 */
int bench_frame(struct device *dev, const struct bench_frame *what);
