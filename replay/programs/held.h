/*
 * Uniforms as contexts hold them. Mesa (22.3.6, st_upload_constants) hands a stage's uniforms to the driver where
 * another program drew last, or where this context has set one of the stage to another value. What contexts that share
 * the program set is not among that: such a value is there already when this context sets it, too, so that it goes on
 * drawing with the older ones. OpenGL does not want that (GL 2.1 appendix D); what programs showed was so. softpipe
 * reads the new ones.
 *
 * Stages that read state of OpenGL are left out: they are handed over whenever it changes.
 */
#pragma once

#include "replay/programs/stages.h"

/** What a context that drew with a program last goes on drawing with, though it changes now. @return 0 or ERR_SYSTEM
 * (reported) */
int gls_held_keep(struct gls_stages *p, uint64_t context, enum gls_stage stage);

/** The context takes what there is. */
void gls_held_drop(struct gls_stages *p, uint64_t context, enum gls_stage stage);

/** Whether a stage reads some of the numbers. */
int gls_held_reads(const struct gls_stages *p, enum gls_stage stage, uint32_t first, uint32_t n);

/** What a context draws with. */
const float (*gls_held_values(const struct gls_stages *p, uint64_t context, enum gls_stage stage))[4];

/** All contexts take what there is. */
void gls_held_free(struct gls_stages *p);
