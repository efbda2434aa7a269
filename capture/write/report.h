/* Runs inside the traced program. Reports: statistics shared with the command (stats.h), messages on standard error. */
#pragma once

struct stats_process;

/** Say something on standard error: "relume: ...". Keeps errno. */
void report_say(const char *fmt, ...) __attribute__((format(printf, 1, 2)));

/**
 * Map the statistics from the file at `path`, or, if a sandbox hides that, from the descriptor that the command left
 * open. Without this call, or if it fails, the statistics are kept in private memory, which nobody reads.
 * @param descriptor  its number, as text; NULL: there is none
 */
void report_open(const char *path, const char *descriptor);

/** Statistics of a new process. Never NULL. */
struct stats_process *report_new_process(void);

/** Count a command that was passed through and not recorded. */
void report_unknown(unsigned command);

/** Count a key of `record --press`: one that a window received, or that none did. */
void report_key(int is_taken);

/** How often the command's signal or key switched recording on or off. */
unsigned report_toggles(void);
