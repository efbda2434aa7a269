/*
 * Runs inside the traced program. Array state as the driver has it: it is asked again after any command that can have changed it.
 * Not between Begin and End, where it cannot be asked.
 */
#pragma once

#include <stdint.h>

enum { ARRAY_MAX_UNITS = 8, ARRAY_MAX_ATTRIBUTES = 16 };

enum array_slot {
	ARRAY_NORMAL, ARRAY_COLOR, ARRAY_INDEX, ARRAY_EDGE_FLAG, ARRAY_FOG_COORD, ARRAY_SECONDARY_COLOR, ARRAY_POINT_SIZE,
	ARRAY_TEXTURE,
	ARRAY_ATTRIBUTE = ARRAY_TEXTURE + ARRAY_MAX_UNITS,
	ARRAY_VERTEX = ARRAY_ATTRIBUTE + ARRAY_MAX_ATTRIBUTES, /* last: with ArrayElement it makes the vertex */
	N_ARRAYS
};

struct array {
	int enabled, size, stride, buffer, normalized, integer, divisor;
	unsigned type;
	const uint8_t *pointer;
};

/** How the fixed-function arrays are asked for and set. 0: not asked, the value is `fixed_size` or the type is a byte. */
struct array_names {
	unsigned enable, size, type, stride, buffer, pointer, command;
	int fixed_size;
	unsigned feature;
};

/** What array_state_refresh has found, for this thread's context. */
extern __thread struct array_state {
	struct array arrays[N_ARRAYS];
	int known;      /* since nothing that changes it was called */
	unsigned turn;  /* of the context (context_turn) */
	int n_client;   /* enabled arrays without a buffer */
	int n_buffered; /* enabled arrays with one */
} array_state __attribute__((tls_model("initial-exec"), visibility("hidden")));

/** Array state can have changed. */
void array_state_changed(void);
void array_state_attributes_used(void);
void array_state_unit_used(unsigned texture);

/** Ask where it is not known. Outside Begin/End only. */
void array_state_refresh(void);

/** 1 where pointers that are set now are offsets in a bound buffer. */
int array_state_pointer_is_offset(void);
/** The buffer that they are offsets in. */
unsigned array_state_buffer(void);
/** The client's active texture unit. */
unsigned array_state_unit(void);

static inline int array_is_unit(int slot)
{
	return slot >= ARRAY_TEXTURE && slot < ARRAY_ATTRIBUTE;
}

static inline int array_is_attribute(int slot)
{
	return slot >= ARRAY_ATTRIBUTE && slot < ARRAY_VERTEX;
}

/** Of an array that is no attribute. */
const struct array_names *array_names_of(int slot);

/** Bytes of one element; 0 for a size or type that is none. */
long array_element_bytes(const struct array *a);

/** 1 where the array is enabled and lies in client memory. */
int array_is_client(const struct array *a);
