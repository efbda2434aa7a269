/* What the files that translate ARB programs share: a program on its way, and the operands of its statements. */
#pragma once

#include "replay/programs/arb_words.h"
#include "replay/programs/emit.h"

#define ARB_MAX_SYMBOLS 512u
#define ARB_MAX_ELEMENTS 2048u /* of parameters, arrays' included */

struct arb_symbol {
	const char *name;
	size_t n;
	enum { ARB_IS_REGISTER, ARB_IS_PARAMETER, ARB_IS_ADDRESS } kind;
	uint32_t first, count; /* the first of four registers; elements of arb_parser.elements */
	int is_array;
};

struct arb_parser {
	struct arb_words words;
	struct emitter emitter;
	struct arb_symbol symbols[ARB_MAX_SYMBOLS];
	uint32_t elements[ARB_MAX_ELEMENTS]; /* numbers of constants; an array's follow each other */
	struct program_constant bound[ARB_MAX_ELEMENTS]; /* those of one binding */
	uint32_t n_symbols, n_elements;
	uint32_t fetched[3], n_fetched;      /* where an instruction's operands are that an address has found */
	uint32_t numbered, named; /* bits: attributes of vertices that are called by number, 1 << it; by name, as inputs
	                           */
	int is_vertex, is_invariant;         /* a vertex program; one that leaves the position to fixed function */
	enum { ARB_NO_FOG, ARB_FOG_LINEAR, ARB_FOG_EXP, ARB_FOG_EXP2 } fog;
};

/** Four registers of the program's own. */
uint32_t arb_new_registers(struct arb_parser *p);

/** The operand that stands for a constant's first number. */
uint32_t arb_constant(struct arb_parser *p, const struct program_constant *c);
uint32_t arb_literal(struct arb_parser *p, float x, float y, float z, float w);

/** NULL: there is none of this name. */
const struct arb_symbol *arb_find_symbol(const struct arb_parser *p, const char *name, size_t n);

/** A name that comes, which must be new. Never NULL. */
struct arb_symbol *arb_new_symbol(struct arb_parser *p);

/** After `fragment` or `vertex`, and after `result`: the first register of an input or output. */
uint32_t arb_take_input(struct arb_parser *p);
uint32_t arb_take_output(struct arb_parser *p);

/** Constants that a binding names, into elements. in_array: each is there for itself, behind the last. @return how
 * many */
uint32_t arb_take_binding(struct arb_parser *p, int in_array);

/** The first of an operand's four numbers, before any swizzle. */
uint32_t arb_take_vector(struct arb_parser *p);
struct emit_source arb_take_source(struct arb_parser *p);
struct emit_target arb_take_target(struct arb_parser *p, int saturates);

/** ADDRESS.x, to be written: its register. */
uint32_t arb_take_address(struct arb_parser *p);

/** Bit i of a swizzle's component i; -1 where it is no letter of one. */
int arb_component_of(const struct arb_parser *p, char c);

/** An instruction whose name has been taken. */
void arb_take_instruction(struct arb_parser *p, const char *name, size_t n);
