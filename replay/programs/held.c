#include "replay/programs/held.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "base/memory.h"

static struct gls_held *find(const struct gls_stages *p, uint64_t context, enum gls_stage stage)
{
	for (uint32_t i = 0; i < p->n_held; i++)
		if (p->held[i].context == context && p->held[i].stage == stage)
			return &p->held[i];
	return NULL;
}

static int reads_state(const struct program_code *code)
{
	for (uint32_t i = 0; i < code->n_constants; i++)
		if (code->constants[i].source != PROGRAM_LITERAL && code->constants[i].source != PROGRAM_LOCAL)
			return 1;
	return 0;
}

int gls_held_keep(struct gls_stages *p, uint64_t context, enum gls_stage stage)
{
	float (*values)[4];

	if (!p->n_uniforms || find(p, context, stage) || reads_state(&p->code[stage]))
		return 0;
	values = malloc(p->n_uniforms * sizeof(*values));
	if (!values || MEMORY_GROW(p->held, p->held_room, p->n_held + 1)) {
		free(values);
		return err_report(ERR_SYSTEM, NULL, "out of memory for uniforms");
	}
	memcpy(values, p->uniforms, p->n_uniforms * sizeof(*values));
	p->held[p->n_held++] = (struct gls_held){ context, stage, values };
	return 0;
}

void gls_held_drop(struct gls_stages *p, uint64_t context, enum gls_stage stage)
{
	struct gls_held *held = find(p, context, stage);

	if (!held)
		return;
	free(held->values);
	*held = p->held[--p->n_held];
}

int gls_held_reads(const struct gls_stages *p, enum gls_stage stage, uint32_t first, uint32_t n)
{
	const struct program_code *code = &p->code[stage];

	for (uint32_t i = 0; i < code->n_instructions; i++) {
		const struct scene_instruction *in = &code->instructions[i];
		const uint32_t operands[] = { in->a, in->b, in->c };

		for (uint32_t k = 0; k < program_operands(in->operation); k++) {
			const uint32_t number = operands[k] - SCENE_PROGRAM_CONSTANT; /* huge if the operand is a register */
			const struct program_constant *c = number / 4 < code->n_constants ? &code->constants[number / 4] : NULL;
			const uint32_t width = in->operation == SCENE_OP_TEXTURE ? 4 : in->flags & SCENE_STEP_A << k ? in->n : 1;
			const uint32_t from = c ? c->index * 4 + number % 4 : 0;

			if (c && c->source == PROGRAM_LOCAL &&
			    (in->operation == SCENE_OP_FETCH || (from < first + n && first < from + width)))
				return 1;
		}
	}
	return 0;
}

const float (*gls_held_values(const struct gls_stages *p, uint64_t context, enum gls_stage stage))[4]
{
	const struct gls_held *held = find(p, context, stage);

	return held ? (const float (*)[4])held->values : p->uniforms;
}

void gls_held_free(struct gls_stages *p)
{
	for (uint32_t i = 0; i < p->n_held; i++)
		free(p->held[i].values);
	free(p->held);
	p->held = NULL;
	p->n_held = p->held_room = 0;
}
