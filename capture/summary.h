/* The closing report of `relume record`: what was recorded, or why nothing was and what to do. */
#pragma once

#include "capture/stats.h"
#include "capture/watching.h"

/** Rows of the figures that are in use. */
static inline uint32_t stats_processes(const struct recorder_stats *stats)
{
	return stats->n_processes < STATS_MAX_PROCESSES ? stats->n_processes : STATS_MAX_PROCESSES;
}

/** One line for each process that drew, then the commands that were not recorded. */
void summary_print(const struct recorder_stats *stats);

/** Nothing was recorded: why. @param program  as typed */
void summary_explain_nothing(const char *program, const struct recorder_stats *stats, const struct watching *watching);
