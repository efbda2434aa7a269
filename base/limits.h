/*
 * Limits on the memory and processor time that a recording may cost, by its size. A few bytes that ask for all of the
 * machine's memory, or for hours, end only the verb.
 */
#pragma once

#include <stdint.h>

struct limits {
	uint64_t memory_bytes; /* touched by the process, without mapped files */
	double processor_s;    /* all threads together; 0: no limit */
};

/**
 * Limits of a verb that only reads: 2 GiB plus 256 times the recording's size; ten minutes plus one second for each
 * 4 KiB of it. Honest recordings stay far below: Snappy compresses at most 21 times, and a byte of a texture becomes at
 * most four floats. The time is for display lists: a few bytes can draw a large one.
 */
struct limits limits_of_reader(uint64_t recording_bytes);

/**
 * Limits of a verb that traces rays: 4 GiB plus 256 times the recording's size, or nine tenths of the machine's memory,
 * whichever is more. No time limit.
 */
struct limits limits_of_tracer(uint64_t recording_bytes);

/**
 * Watch this process from now on, in a thread that takes no signals. If a limit is reached, print one line, remove this
 * run's unfinished files and empty folders, and exit with code 5. If the thread cannot be started, there are no limits.
 * @param recording  for the message; borrowed
 */
void limits_begin(const char *recording, const struct limits *limits);
