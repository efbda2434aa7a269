#include "replay/glsl/fixed.h"

#include "replay/glsl/makers.h"

/* Mark the instructions that jumps skip or repeat. conditional: [n_instructions], all 0 */
static void mark_conditional(const struct program_code *code, uint8_t *conditional)
{
	for (uint32_t i = 0; i < code->n_instructions; i++) {
		const uint32_t target = glsl_is_jump(&code->instructions[i]) ? code->instructions[i].to : i;

		for (uint32_t k = target < i ? target : i; k < target || k < i; k++)
			conditional[k] = 1;
	}
}

/* Number of registers that an instruction changes from `to` on. */
static uint32_t changed_by(const struct scene_instruction *in)
{
	switch (in->operation) {
	case SCENE_OP_TEXTURE: return 4;
	case SCENE_OP_STORE: return (in->c >> 16) * (in->c & 0xffff);
	case SCENE_OP_KILL:
	case SCENE_OP_MASK:
	case SCENE_OP_JUMP:
	case SCENE_OP_JUMP_NONE: return 0;
	default: return in->n;
	}
}

/* The constants that registers hold at an instruction. */
struct held {
	const struct program_code *code;
	uint32_t operand[SCENE_PROGRAM_REGISTERS]; /* 0: none */
	int is_masked; /* 1: only some vertices may be active */
};

/* The constant that an operand has; 0: none. */
static uint32_t constant_of(const struct held *h, uint32_t operand)
{
	return operand >= SCENE_PROGRAM_CONSTANT ? operand : h->operand[operand];
}

static int is_number(const struct held *h, uint32_t operand, float value)
{
	const uint32_t at = constant_of(h, operand);
	const struct program_constant *c = at ? &h->code->constants[(at - SCENE_PROGRAM_CONSTANT) / 4] : NULL;

	return c && c->source == PROGRAM_LITERAL && c->value[at % 4] == value;
}

/* The constant that result i of an instruction has: Mesa simplifies x 1 and x + 0 before. 0: none */
static uint32_t result_of(const struct held *h, const struct scene_instruction *in, uint32_t i)
{
	const uint32_t a = glsl_operand(in, 0, i), b = glsl_operand(in, 1, i);
	const float neutral = in->operation == SCENE_OP_MULTIPLY ? 1 : 0;

	if (in->flags & (SCENE_NEGATE_A | SCENE_NEGATE_B | SCENE_SATURATE))
		return 0;
	if (in->operation == SCENE_OP_MOVE)
		return constant_of(h, a);
	if (in->operation != SCENE_OP_MULTIPLY && in->operation != SCENE_OP_ADD)
		return 0;
	return is_number(h, b, neutral) ? constant_of(h, a) : is_number(h, a, neutral) ? constant_of(h, b) : 0;
}

/* Execute an instruction. skips: 1 if a jump may skip it */
static void execute(struct held *h, const struct scene_instruction *in, int skips)
{
	const int is_certain = !skips && (!h->is_masked || in->flags & SCENE_UNMASKED);

	if (in->operation == SCENE_OP_MASK)
		h->is_masked = !constant_of(h, in->a); /* a mask that is constant is that of all vertices */
	for (uint32_t i = 0, n = changed_by(in); i < n && in->to + i < SCENE_PROGRAM_REGISTERS; i++)
		h->operand[in->to + i] = is_certain ? result_of(h, in, i) : 0;
}

void glsl_fix(struct glsl_writer *w, struct glsl_fixed *fixed, uint32_t n)
{
	const struct program_code *code = w->code;
	uint8_t *conditional = glsl_alloc(w, code->n_instructions);
	struct held h = { .code = code };

	if (glsl_stopped(w))
		return;
	mark_conditional(code, conditional);
	for (uint32_t i = 0; i < code->n_instructions; i++)
		execute(&h, &code->instructions[i], conditional[i]);
	for (uint32_t k = 0; k < n; k++) {
		const uint32_t at = h.operand[SCENE_VERTEX_RESULTS + 4 * SCENE_RESULT_TEXCOORD + k];

		if (at)
			fixed[k] = (struct glsl_fixed){ code->constants[(at - SCENE_PROGRAM_CONSTANT) / 4], 1 + at % 4 };
	}
}
