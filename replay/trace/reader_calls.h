/* Events: calls being entered and calls returning. */
#pragma once

#include "replay/trace/reader_bytes.h"

/** The next call that has returned, or, at the end, one that never did; NULL: there is none, or reading failed. */
struct reader_call *reader_next_call(struct trace_reader *r);

/** Allow a call's memory to be reused. */
void reader_release_call(struct reader_call *p);
