/* What rules matched, over all frames of a run: a mistyped hash matches nothing, and shows nothing either. */
#pragma once

#include <stdint.h>

struct look;
struct matched; /* counts of all rules for surfaces; threads may share it */

/** For the rules of one file. @param name  what messages call it @return 0 or ERR_SYSTEM (reported) */
int matched_create(const char *name, uint32_t n_rules, struct matched **out);
void matched_destroy(struct matched **matched);

/** Add the rules of a later file. @return 0, and `more` is freed; or ERR_SYSTEM (reported), and nothing is changed */
int matched_append(struct matched *to, struct matched **more);

/** A frame's counts. @param draws  [rules]: how many draws each rule matched */
void matched_add(struct matched *matched, const uint32_t *draws);

/**
 * Say on standard error what each rule of a file matched, and warn of those that matched nothing. Silent about rules
 * that nobody wrote (`--look auto`), and where no frame was under the rules.
 * @param quiet  1: warnings alone
 */
void matched_report(const struct look *look, int quiet);
