/*
 * Runs inside the traced program. Markers: facts that the format has no place for are written as the text of a fake
 * glStringMarkerGREMEDY (trace.md). marker.c also has the functions of relume.h, which programs find by name at run
 * time.
 */
#pragma once

void marker_write(const char *text);

/** A context was made current for the first time: write its drawable's bits per pixel, and the GL that draws. */
void marker_write_bits(void);
