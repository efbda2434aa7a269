/*
 * Fragment shaders of ATI_fragment_shader: what is called between Begin and End is kept, call by call, and becomes code
 * like programs in assembly.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

#define ATI_CONSTANTS 8u

enum ati_kind { ATI_PASS, ATI_SAMPLE, ATI_COLOR, ATI_ALPHA, ATI_CONSTANT };

struct ati_argument {
	uint32_t source, component, change; /* as the call has them: GL tokens, and bits of them */
};

/* One call. Tokens as given; nothing about them is believed. */
struct ati_call {
	uint32_t kind;      /* enum ati_kind */
	uint32_t operation; /* ATI_COLOR, ATI_ALPHA: GL_MOV_ATI ...; ATI_PASS, ATI_SAMPLE: the swizzle */
	uint32_t to;        /* register, or constant */
	uint32_t mask, change;
	struct ati_argument arguments[3]; /* ATI_PASS, ATI_SAMPLE: the source alone */
	uint32_t n_arguments;
	float value[4];     /* ATI_CONSTANT */
};

struct program_code;

/**
 * Translate calls. Constants that none of them sets are PROGRAM_ENV, by number.
 * @param calls  n bytes of struct ati_call, aligned
 * @return as program_translate_arb
 */
int program_translate_ati(const struct ati_call *calls, size_t n, struct program_code *code, const char **why);
