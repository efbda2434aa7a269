/* Registers, constants and instructions of the code being written. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"
#include "replay/glsl/writer.h"

#define MAX_MEMORY ((size_t)64 << 20) /* for operands */

void glsl_fail(struct glsl_writer *w, const char *why)
{
	if (!glsl_stopped(w))
		w->why = why;
}

void glsl_fail_at(struct glsl_writer *w, const char *before, const char *name, const char *after)
{
	if (glsl_stopped(w))
		return;
	snprintf(w->message, GLSL_MESSAGE, "%s%s%s", before, name, after);
	w->why = w->message;
}

void *glsl_alloc(struct glsl_writer *w, size_t n)
{
	void *block;

	if (n > MAX_MEMORY - w->memory) {
		glsl_fail(w, "a shader is too large");
		return NULL;
	}
	w->memory += n;
	block = calloc(1, n + 1);
	if (!block || MEMORY_GROW(w->blocks, w->block_room, w->n_blocks + 1)) {
		free(block);
		w->err = err_report(ERR_SYSTEM, NULL, "out of memory for a shader");
		return NULL;
	}
	return w->blocks[w->n_blocks++] = block;
}

uint32_t glsl_registers(struct glsl_writer *w, uint32_t n)
{
	const uint32_t first = w->top;

	if (n > SCENE_PROGRAM_REGISTERS - first) {
		glsl_fail(w, "a shader uses too many registers");
		return SCENE_PROGRAM_FIRST;
	}
	w->top += n;
	if (w->top > w->code->n_registers)
		w->code->n_registers = w->top;
	return first;
}

struct glsl_value glsl_value_of(struct glsl_writer *w, uint32_t type, uint32_t n)
{
	return (struct glsl_value){ type, n, glsl_alloc(w, n * sizeof(uint32_t)) };
}

struct glsl_value glsl_row(struct glsl_writer *w, uint32_t type, uint32_t first)
{
	struct glsl_value v = glsl_value_of(w, type, glsl_type_of(w, type)->numbers);

	for (uint32_t i = 0; v.at && i < v.n; i++)
		v.at[i] = first + i;
	return v;
}

struct glsl_value glsl_fresh(struct glsl_writer *w, uint32_t type)
{
	return glsl_row(w, type, glsl_registers(w, glsl_type_of(w, type)->numbers));
}

/* --- Constants --------------------------------------------------------------------------------------------------- */

static int is_number(const struct glsl_writer *w, uint32_t place, float value)
{
	const struct program_constant *c = place < 4 * w->code->n_constants ? &w->code->constants[place / 4] : NULL;

	return c && c->source == PROGRAM_LITERAL && place % 4 < c->part &&
	       memcmp(&c->value[place % 4], &value, sizeof(value)) == 0;
}

/*
 * Append to the last constant if that is a literal with room (its part is the number of used components), otherwise to
 * a new constant.
 */
static uint32_t add_number(struct glsl_writer *w, float value)
{
	struct program_constant *last = w->code->n_constants ? &w->code->constants[w->code->n_constants - 1] : NULL;

	if (!last || last->source != PROGRAM_LITERAL || last->part == 4) {
		if (program_constant_append(w->code, &(struct program_constant){ .source = PROGRAM_LITERAL }) == UINT32_MAX) {
			w->err = ERR_SYSTEM;
			return 0;
		}
		last = &w->code->constants[w->code->n_constants - 1];
	}
	last->value[last->part++] = value;
	return 4 * (w->code->n_constants - 1) + last->part - 1;
}

void glsl_numbers(struct glsl_writer *w, const float *values, uint32_t n, uint32_t *at)
{
	uint32_t place, i;

	for (place = 0; place < 4 * w->code->n_constants; place++) {
		for (i = 0; i < n && is_number(w, place + i, values[i]); i++)
			;
		if (i == n)
			break;
	}
	if (place == 4 * w->code->n_constants)
		for (i = 0; i < n && !glsl_stopped(w); i++) {
			const uint32_t added = add_number(w, values[i]);

			place = i ? place : added;
		}
	for (i = 0; i < n; i++)
		at[i] = SCENE_PROGRAM_CONSTANT + place + i;
}

uint32_t glsl_number(struct glsl_writer *w, float value)
{
	uint32_t at = SCENE_PROGRAM_CONSTANT;

	glsl_numbers(w, &value, 1, &at);
	return at;
}

uint32_t glsl_constant(struct glsl_writer *w, const struct program_constant *c)
{
	const uint32_t number = program_constant_append(w->code, c);

	if (number == UINT32_MAX) {
		w->err = ERR_SYSTEM;
		return SCENE_PROGRAM_CONSTANT;
	}
	return SCENE_PROGRAM_CONSTANT + 4 * number;
}

/* --- Instructions ------------------------------------------------------------------------------------------------ */

uint32_t glsl_append(struct glsl_writer *w, const struct scene_instruction *in)
{
	int err;

	if (glsl_stopped(w))
		return 0;
	err = program_append(w->code, in);
	if (err == ERR_INPUT)
		glsl_fail(w, "a shader has too many instructions");
	else
		w->err = err;
	return w->code->n_instructions - 1;
}

/* The stride of operands: 1 consecutive, 0 all the same, -1 neither. */
static int step_of(const uint32_t *at, uint32_t n)
{
	int row = 1, alike = 1;

	for (uint32_t i = 1; i < n; i++) {
		row &= at[i] == at[0] + i;
		alike &= at[i] == at[0];
	}
	return alike ? 0 : row ? 1 : -1;
}

void glsl_write(struct glsl_writer *w, enum scene_operation operation, uint32_t flags, uint32_t to, uint32_t n,
                const uint32_t *a, const uint32_t *b, const uint32_t *c)
{
	const uint32_t *const sources[3] = { a, b, c };

	for (uint32_t i = 0, run; i < n && !glsl_stopped(w); i += run) {
		struct scene_instruction in = { .operation = operation, .flags = flags, .to = to + i };
		uint32_t *const operands[3] = { &in.a, &in.b, &in.c };

		for (run = n - i; run > 1; run--) {
			int good = 1;

			for (unsigned k = 0; k < 3; k++)
				good &= !sources[k] || step_of(sources[k] + i, run) >= 0;
			if (good)
				break;
		}
		in.n = run;
		for (unsigned k = 0; k < 3 && sources[k]; k++) {
			*operands[k] = sources[k][i];
			in.flags |= step_of(sources[k] + i, run) == 1 ? SCENE_STEP_A << k : 0;
		}
		glsl_append(w, &in);
	}
}

uint32_t glsl_one(struct glsl_writer *w, enum scene_operation operation, uint32_t a, uint32_t b, uint32_t c)
{
	const uint32_t to = glsl_registers(w, 1);

	glsl_write(w, operation, 0, to, 1, &a, operation >= SCENE_OP_ADD ? &b : NULL, operation >= SCENE_OP_MAD ? &c : NULL);
	return to;
}

/* 1 if the last instruction computed exactly these operands, so that it can write to registers from `to` on instead. */
static int is_last_made(const struct glsl_writer *w, uint32_t to, const uint32_t *from, uint32_t n)
{
	struct scene_instruction *in;

	if (w->code->n_instructions <= w->barrier || w->code->n_instructions == 0)
		return 0;
	in = &w->code->instructions[w->code->n_instructions - 1];
	if (in->n != n || from[0] != in->to || step_of(from, n) < (n > 1) || in->operation >= SCENE_OP_KILL ||
	    from[0] < w->top - n)
		return 0;
	for (unsigned k = 0; k < 3; k++) {
		const uint32_t operand = k == 0 ? in->a : k == 1 ? in->b : in->c, span = in->flags & SCENE_STEP_A << k ? n : 1;

		if (operand < SCENE_PROGRAM_CONSTANT && operand < to + n && operand + span > to &&
		    !(operand == to && span == n) && n > 1)
			return 0;
	}
	return 1;
}

void glsl_settle(struct glsl_writer *w, uint32_t top, struct glsl_value *v)
{
	if (glsl_stopped(w) || !v->n || v->at[0] <= top || v->at[0] >= SCENE_PROGRAM_CONSTANT ||
	    !is_last_made(w, top, v->at, v->n))
		return;
	w->code->instructions[w->code->n_instructions - 1].to = top;
	for (uint32_t i = 0; i < v->n; i++)
		v->at[i] = top + i;
	w->top = top + v->n;
}

void glsl_copy(struct glsl_writer *w, const uint32_t *to, const uint32_t *from, uint32_t n)
{
	uint32_t aside = 0;

	if (glsl_stopped(w) || !n)
		return;
	if (step_of(to, n) == 1 || n == 1) {
		if (from[0] >= SCENE_PROGRAM_FIRST && from[0] < SCENE_PROGRAM_CONSTANT && is_last_made(w, to[0], from, n)) {
			w->code->instructions[w->code->n_instructions - 1].to = to[0];
			return;
		}
	}
	for (uint32_t i = 0; i < n; i++)
		for (uint32_t k = 0; k < n; k++)
			aside |= k != i && from[i] == to[k];
	if (aside) {
		const uint32_t first = glsl_registers(w, n);
		uint32_t *row = glsl_alloc(w, n * sizeof(*row));

		glsl_write(w, SCENE_OP_MOVE, 0, first, n, from, NULL, NULL);
		for (uint32_t i = 0; row && i < n; i++)
			row[i] = first + i;
		from = row;
	}
	for (uint32_t i = 0, run; i < n && !glsl_stopped(w); i += run) {
		for (run = 1; i + run < n && to[i + run] == to[i] + run; run++)
			;
		if (run != 1 || from[i] != to[i])
			glsl_write(w, SCENE_OP_MOVE, 0, to[i], run, from + i, NULL, NULL);
	}
}
