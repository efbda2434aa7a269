/* Counts the draws that rules match over all frames of a run, since a rule with a mistyped hash would fail silently. */
#pragma once

#include <stdint.h>

struct look;
struct matched; /* counts of all rules for surfaces; threads may share it */

/** Create counts for the rules of one file. @param name  its name in messages @return 0 or ERR_SYSTEM (reported) */
int matched_create(const char *name, uint32_t n_rules, struct matched **out);
void matched_destroy(struct matched **matched);

/** Append the counts of a later file. @return 0, and `more` is freed; or ERR_SYSTEM (reported), and nothing changes */
int matched_append(struct matched *to, struct matched **more);

/** Add a frame. @param draws  [rules]: the number of draws that each rule matched */
void matched_add(struct matched *matched, const uint32_t *draws);

/**
 * Print to standard error what each rule of a file matched, and warn about rules that matched nothing. Rules from a
 * study (`--look auto`) are not reported, and neither are rules that no frame used.
 * @param quiet  1: warnings alone
 */
void matched_report(const struct look *look, int quiet);
