/* Events: calls that are entered and that return. */
#pragma once

#include "replay/trace/reader_bytes.h"

/** The next call that has returned, or at the end one that never did; NULL: there is none, or failed. */
struct reader_call *reader_next_call(struct trace_reader *r);

/** Its memory may hold another call. */
void reader_release_call(struct reader_call *p);
