/* Names of the types that GLSL itself has. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

/* Samplers: enum glsl_texture, and these. */
#define PARSE_SHADOW 8u
#define PARSE_LAYERED 16u /* an array of textures */
#define PARSE_INT_TEXTURE 32u
#define PARSE_UINT_TEXTURE 64u
#define PARSE_DIMENSION 7u

struct parse_type_name {
	uint32_t kind, rows, columns, texture; /* as of struct glsl_type, texture with the bits above */
	uint32_t version;                      /* that it comes with; 0: any */
};

/** @return false: it is no type's name */
bool parse_type_name(const char *text, struct parse_type_name *found);
