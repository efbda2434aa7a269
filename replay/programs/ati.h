/*
 * Fragment shaders of ATI_fragment_shader: the calls between Begin and End are stored, and translated to code like
 * assembly programs.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#define ATI_CONSTANTS 8u

enum ati_kind { ATI_PASS, ATI_SAMPLE, ATI_COLOR, ATI_ALPHA, ATI_CONSTANT };

struct ati_argument {
	uint32_t source, component, change; /* as passed in the call: GL tokens, and bit masks */
};

/* One call. Tokens as passed, not trusted. */
struct ati_call {
	uint32_t kind;      /* enum ati_kind */
	uint32_t operation; /* ATI_COLOR, ATI_ALPHA: GL_MOV_ATI ...; ATI_PASS, ATI_SAMPLE: the swizzle */
	uint32_t to;        /* number of a register or constant */
	uint32_t mask, change;
	struct ati_argument arguments[3]; /* ATI_PASS, ATI_SAMPLE: only the source */
	uint32_t n_arguments;
	float value[4];     /* ATI_CONSTANT */
};

struct program_code;

/**
 * Translate calls. Constants that no call sets become PROGRAM_ENV, by number.
 * @param calls  n bytes of struct ati_call, aligned
 * @return as program_translate_arb
 */
int program_translate_ati(const struct ati_call *calls, size_t n, struct program_code *code, const char **why);
