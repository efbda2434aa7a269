/* The report: one self-contained HTML file, and a contact sheet. */
#pragma once

#include "diff/report/pictures.h"

/**
 * Write DIR/index.html (pictures as data URIs) and DIR/sheet.png. The sheet shows a few frames: approved, now and their
 * difference; or reference, gl, beauty and difference if there is no baseline or the frames differ from the reference.
 * On the page every compared frame has a thumbnail. Full-size pictures are included of the frames that did not pass and
 * a sample of those that passed, up to about 64 MB, and of all others up to 16 MB.
 * @return 0 or ERR_SYSTEM (reported; an incomplete file does not appear)
 */
int report_write(const struct picture_sources *from, const char *dir);

/** The contact sheet alone. @return 0 or ERR_SYSTEM (reported) */
int sheet_write(const struct picture_sources *from, const char *path);

/** The page without its data (page.html including page.js, converted to C by the build). */
extern const char report_page[];
