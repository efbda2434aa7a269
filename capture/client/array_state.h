/*
 * Runs inside the traced program. The driver's array state, queried again after any command that may have changed it.
 * It cannot be queried between Begin and End.
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

/** Enumerants to query and set the fixed-function arrays. 0: not queried; the size is `fixed_size`, the type a byte. */
struct array_names {
	unsigned enable, size, type, stride, buffer, pointer, command;
	int fixed_size;
	unsigned feature;
};

/** The array state of this thread's context, as of array_state_refresh. */
extern __thread struct array_state {
	struct array arrays[N_ARRAYS];
	int known;      /* 1: nothing that may change it was called since */
	unsigned turn;  /* the context's (context_turn) */
	int n_client;   /* enabled arrays without a buffer */
	int n_buffered; /* enabled arrays with one */
} array_state __attribute__((tls_model("initial-exec"), visibility("hidden")));

/** Array state may have changed. */
void array_state_changed(void);
void array_state_attributes_used(void);
void array_state_unit_used(unsigned texture);

/** Query the state unless it is known. Outside Begin/End only. */
void array_state_refresh(void);

/** 1 if a pointer set now would be an offset in a bound buffer. */
int array_state_pointer_is_offset(void);
/** The buffer that such an offset refers to. */
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

/** The names of an array that is not a generic attribute. */
const struct array_names *array_names_of(int slot);

/** Bytes of one element; 0 if its size or type is invalid. */
long array_element_bytes(const struct array *a);

/** 1 if the array is enabled and in client memory. */
int array_is_client(const struct array *a);
