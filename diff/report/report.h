/*
 * The report: one HTML file that needs nothing else, and a contact sheet.
 */
#ifndef DIFF_REPORT_REPORT_H
#define DIFF_REPORT_REPORT_H

#include "diff/report/output.h"
#include "diff/pictures/set.h"

/**
 * Write DIR/index.html (what did not pass first, pictures as data URIs) and DIR/sheet.png (a few frames: reference,
 * gl, beauty, difference side by side). Every compared frame has a thumbnail. Whole pictures of all frames that did not
 * pass are in the page as long as these are no more than about 64 MB, and of a sample of those that passed.
 * @return 0 or ERR_SYSTEM (reported; files that were not whole are not there)
 */
int report_write(const struct output_run *run, struct set *ref, struct set *traced, const char *dir);

/** The contact sheet alone. @return 0 or ERR_SYSTEM (reported) */
int sheet_write(const struct output_run *run, struct set *ref, struct set *traced, const char *path);

/** The page without its data (page.html, made into C when building). */
extern const char report_page[];

#endif
