/*
 * A JSON writer: streams indented text and keeps nothing. NaN and infinities, which JSON lacks, become null.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

struct json {
	FILE *out;
	unsigned depth;
	int has_items;  /* in the open object or array */
	int after_key;
	int flat;       /* arrays of numbers stay on one line */
};

/** '{' or '['. */
void json_begin(struct json *j, char bracket);
/** '}' or ']'. */
void json_end(struct json *j, char bracket);
void json_key(struct json *j, const char *name);
void json_string(struct json *j, const char *text);
void json_uint(struct json *j, uint64_t value);

void json_key_begin(struct json *j, const char *name, char bracket);
void json_key_string(struct json *j, const char *name, const char *text);
void json_key_uint(struct json *j, const char *name, uint64_t value);
void json_key_bool(struct json *j, const char *name, int value);
void json_key_float(struct json *j, const char *name, double value);
void json_key_floats(struct json *j, const char *name, const float *values, size_t n);
void json_key_uints(struct json *j, const char *name, const uint32_t *values, size_t n);
void json_key_ints(struct json *j, const char *name, const int32_t *values, size_t n);
