/*
 * Signatures: the names of calls, enums, bitmasks and structs. A trace defines each where it is first used, and refers
 * to it by number from then on.
 */
#pragma once

#include "replay/trace/reader_bytes.h"

/** A signature that was read before, or NULL. */
static inline void *reader_known_sig(const struct trace_reader *r, enum trace_sig_kind kind, uint64_t id)
{
	const struct reader_sigs *t = &r->tables[kind];

	return __builtin_expect(id < t->n && r->status == 0, 1) ? t->items[id] : NULL;
}

/** Read a reference to a signature, and its definition if this is its first use. @return NULL: failed */
const struct call_sig *reader_call_sig(struct trace_reader *r);
const struct trace_struct_sig *reader_struct_sig(struct trace_reader *r);
/** @param kind  TRACE_SIG_ENUM or TRACE_SIG_BITMASK */
const struct trace_values_sig *reader_values_sig(struct trace_reader *r, enum trace_sig_kind kind);

/** Read a reference to a stack frame. @return 1 if it is the first: the definition follows; 0 if not, or failed */
int reader_frame_sig(struct trace_reader *r);

/** Read a tagged number, as in enums. */
int64_t reader_tagged_int(struct trace_reader *r);

/**
 * Restore exactly the signatures that are defined before a place.
 * @param signatures  as written by trace_reader_signatures
 * @return 0, ERR_INPUT or ERR_SYSTEM (reported)
 */
int reader_learn_sigs(struct trace_reader *r, const uint8_t *signatures, size_t n, uint64_t offset);
