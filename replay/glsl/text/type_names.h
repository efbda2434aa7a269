/* Names of GLSL's built-in types. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

/* Samplers: enum glsl_texture, and these bits. */
#define PARSE_SHADOW 8u
#define PARSE_LAYERED 16u /* an array texture */
#define PARSE_INT_TEXTURE 32u
#define PARSE_UINT_TEXTURE 64u
#define PARSE_DIMENSION 7u

struct parse_type_name {
	uint32_t kind, rows, columns, texture; /* as in struct glsl_type, texture with the bits above */
	uint32_t version;                      /* first version that has it; 0: any */
};

/** @return false: not the name of a type */
bool parse_type_name(const char *text, struct parse_type_name *found);
