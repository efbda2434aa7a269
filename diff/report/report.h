/*
 * The report: one HTML file that needs nothing else, and a contact sheet.
 */
#pragma once

#include "diff/report/output.h"
#include "diff/pictures/set.h"

/**
 * Write DIR/index.html (pictures as data URIs) and DIR/sheet.png (a few frames: reference, gl, beauty, difference side by side).
 * Every compared frame has a thumbnail. The page holds whole pictures of the frames that did not pass, up to about 64 MB, and of
 * a sample of those that passed.
 * @return 0 or ERR_SYSTEM (reported; a file that is not whole does not appear)
 */
int report_write(const struct output_run *run, struct set *ref, struct set *traced, const char *dir);

/** The contact sheet alone. @return 0 or ERR_SYSTEM (reported) */
int sheet_write(const struct output_run *run, struct set *ref, struct set *traced, const char *path);

/** The page without its data (page.html, made into C when building). */
extern const char report_page[];
