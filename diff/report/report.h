/*
 * The report: one HTML file that needs nothing else, and a contact sheet.
 */
#pragma once

#include "diff/report/pictures.h"

/**
 * Write DIR/index.html (pictures as data URIs) and DIR/sheet.png (a few frames: the approved one, what it is now, and
 * the difference; reference, gl, beauty and difference where there is no baseline or these differ). Every compared
 * frame has a thumbnail. The page holds whole pictures of the frames that did not pass, and of a sample of those that
 * passed, up to about 64 MB; of all others up to 16 MB.
 * @return 0 or ERR_SYSTEM (reported; a file that is not whole does not appear)
 */
int report_write(const struct picture_sources *from, const char *dir);

/** The contact sheet alone. @return 0 or ERR_SYSTEM (reported) */
int sheet_write(const struct picture_sources *from, const char *path);

/** The page without its data (page.html with page.js in it, made into C when building). */
extern const char report_page[];
