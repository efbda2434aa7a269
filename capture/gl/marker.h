/*
 * Runs inside the traced program. Markers: what the format has no place for travels as the text of a glStringMarkerGREMEDY that
 * the recorder makes up (trace.md). marker.c also has the functions of relume.h, which programs find by name at run time.
 */
#pragma once

void marker_write(const char *text);

/** A context was made current for the first time: how many bits a pixel of its drawable has, and which GL draws. */
void marker_write_bits(void);
