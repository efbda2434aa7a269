/*
 * The tag bytes of a trace, named once for the recorder, the reader and trace_out. Their grammar is in trace.md; the
 * numbers are apitrace's.
 */
#pragma once

/** The version of the format written, and of the meaning of its calls. */
enum { TRACE_VERSION = 6, TRACE_SEMANTICS = 6 };

/** The first byte of an event. */
enum trace_event { TRACE_ENTER, TRACE_LEAVE };

/** The first byte of a detail: what an event holds, up to TRACE_DETAIL_END. */
enum trace_detail {
	TRACE_DETAIL_END = 0, TRACE_DETAIL_ARGUMENT = 1, TRACE_DETAIL_RESULT = 2,
	TRACE_DETAIL_BACKTRACE = 4, /* only other recorders write it */
	TRACE_DETAIL_FLAGS = 5      /* CALL_* */
};

/** The flags of a call. */
enum { CALL_FAKE = 1 }; /* made up by the recorder; executed like any other */

/** The first byte of what a stack frame in a backtrace holds; texts up to the file, then numbers. */
enum trace_frame_detail {
	TRACE_FRAME_END, TRACE_FRAME_MODULE, TRACE_FRAME_FUNCTION, TRACE_FRAME_FILE, TRACE_FRAME_LINE, TRACE_FRAME_OFFSET
};

/** The first byte of a value. */
enum trace_type {
	TRACE_NULL, TRACE_FALSE, TRACE_TRUE, TRACE_SINT, TRACE_UINT, TRACE_FLOAT, TRACE_DOUBLE, TRACE_STRING,
	TRACE_BLOB, TRACE_ENUM, TRACE_BITMASK, TRACE_ARRAY, TRACE_STRUCT, TRACE_OPAQUE, TRACE_REPR, TRACE_WSTRING,
	N_TRACE_TYPES,
	TRACE_NONE = -1 /* in memory only: an argument that was not recorded */
};

/**
 * Signatures are written in full only at the first use of their id. Each kind has its own ids. Indexes store these
 * numbers; traces do not.
 */
enum trace_sig_kind {
	TRACE_SIG_CALL, TRACE_SIG_STRUCT, TRACE_SIG_ENUM, TRACE_SIG_BITMASK, TRACE_SIG_FRAME, N_TRACE_SIG_KINDS
};
