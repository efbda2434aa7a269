/*
 * Uniform values held by contexts. Mesa (22.3.6, st_upload_constants) passes a stage's uniforms to the driver only if
 * another program drew last, or if this context has set one of the stage's uniforms to a different value. Values set by
 * other contexts that share the program do not trigger this: even when this context then sets the same value, it finds
 * no difference, and keeps drawing with the older values. This violates OpenGL (GL 2.1 appendix D), but it is what
 * recorded programs showed. softpipe reads the new values.
 *
 * Stages that read OpenGL state are excluded: their constants are passed on whenever that state changes.
 */
#pragma once

#include "replay/programs/stages.h"

/**
 * Before uniforms change, save the values that a context uses if it last drew with this program. @return 0 or
 * ERR_SYSTEM (reported)
 */
int gls_held_keep(struct gls_stages *p, uint64_t context, enum gls_stage stage);

/** Drop a context's saved values, so that it uses the current ones. */
void gls_held_drop(struct gls_stages *p, uint64_t context, enum gls_stage stage);

/** 1 if a stage reads any of n uniforms from `first` on. */
int gls_held_reads(const struct gls_stages *p, enum gls_stage stage, uint32_t first, uint32_t n);

/** The values that a context draws with. */
const float (*gls_held_values(const struct gls_stages *p, uint64_t context, enum gls_stage stage))[4];

/** Drop the saved values of all contexts. */
void gls_held_free(struct gls_stages *p);
