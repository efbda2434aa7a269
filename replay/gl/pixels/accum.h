/* The accumulation buffer (GL 2.1 sec. 4.2.4). */
#pragma once

struct gls_exec;
struct gls_state;

/** Clear the accumulation buffer within the scissor, to the value of ClearAccum. */
void gls_accum_clear(struct gls_exec *x, struct gls_state *st);
