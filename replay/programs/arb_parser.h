/* Shared by the files that translate ARB programs: a program being translated, and the operands of its statements. */
#pragma once

#include "replay/programs/arb_words.h"
#include "replay/programs/emit.h"

#define ARB_MAX_SYMBOLS 512u
#define ARB_MAX_ELEMENTS 2048u /* parameters, including those of arrays */

struct arb_symbol {
	const char *name;
	size_t n;
	enum { ARB_IS_REGISTER, ARB_IS_PARAMETER, ARB_IS_ADDRESS } kind;
	uint32_t first, count; /* the first of four registers; or a range of arb_parser.elements */
	int is_array;
};

struct arb_parser {
	struct arb_words words;
	struct emitter emitter;
	struct arb_symbol symbols[ARB_MAX_SYMBOLS];
	uint32_t elements[ARB_MAX_ELEMENTS]; /* numbers of constants; those of an array are adjacent */
	struct program_constant bound[ARB_MAX_ELEMENTS]; /* constants of the current binding */
	uint32_t n_symbols, n_elements;
	uint32_t fetched[3], n_fetched;      /* registers that hold the instruction's operands fetched by address */
	uint32_t numbered, named; /* bits: vertex attributes used by number, 1 << number; by name, as inputs */
	int is_vertex, is_invariant;         /* 1: a vertex program; 1: one that leaves the position to fixed function */
	enum { ARB_NO_FOG, ARB_FOG_LINEAR, ARB_FOG_EXP, ARB_FOG_EXP2 } fog;
};

/** Allocate four registers of the program. */
uint32_t arb_new_registers(struct arb_parser *p);

/** The operand for a constant's first number. */
uint32_t arb_constant(struct arb_parser *p, const struct program_constant *c);
uint32_t arb_literal(struct arb_parser *p, float x, float y, float z, float w);

/** @return NULL: no symbol has this name */
const struct arb_symbol *arb_find_symbol(const struct arb_parser *p, const char *name, size_t n);

/** Parse a name, which must be new. Never NULL. */
struct arb_symbol *arb_new_symbol(struct arb_parser *p);

/** After `fragment` or `vertex`, and after `result`: parse an input or output. @return its first register */
uint32_t arb_take_input(struct arb_parser *p);
uint32_t arb_take_output(struct arb_parser *p);

/**
 * Parse a binding, and append its constants to the elements. in_array: add each as a new constant, so that they are
 * adjacent. @return number of constants
 */
uint32_t arb_take_binding(struct arb_parser *p, int in_array);

/** Parse an operand, before any swizzle. @return the first of its four numbers */
uint32_t arb_take_vector(struct arb_parser *p);
struct emit_source arb_take_source(struct arb_parser *p);
struct emit_target arb_take_target(struct arb_parser *p, int saturates);

/** Parse ADDRESS.x as a target. @return its register */
uint32_t arb_take_address(struct arb_parser *p);

/** The component that a swizzle letter selects; -1: not a swizzle letter. */
int arb_component_of(const struct arb_parser *p, char c);

/** Translate an instruction whose name has been parsed. */
void arb_take_instruction(struct arb_parser *p, const char *name, size_t n);
