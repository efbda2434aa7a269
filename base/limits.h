/*
 * What reading a recording may cost: memory and processor time that go by its size. A recording of a few bytes that asks for all of a
 * machine's memory, or for hours, ends the verb and nothing else.
 */
#pragma once

#include <stdint.h>

struct limits {
	uint64_t memory_bytes; /* that the process has touched, files it has mapped not among them */
	double processor_s;    /* of all its threads; 0: no limit */
};

/**
 * Limits of a verb that only reads: 2 GiB and 256 times the recording; ten minutes and a second for each 4 KiB of it. Honest recordings stay far
 * below: Snappy packs at most 21 times, and a byte of a texture becomes at most four floats. Time is for display lists, which a few bytes draw.
 */
struct limits limits_of_reader(uint64_t recording_bytes);

/** Limits of a verb that traces rays: 4 GiB and 256 times the recording, or nine tenths of the machine's memory where that is more. No limit of time. */
struct limits limits_of_tracer(uint64_t recording_bytes);

/**
 * Watch this process from now on, in a thread that takes no signals. Where it reaches a limit, one line says so, files that are not whole and empty
 * folders of this run go, and the process ends with exit code 5. A process that cannot have the thread runs without limits.
 * @param recording  named by the line; borrowed
 */
void limits_begin(const char *recording, const struct limits *limits);
