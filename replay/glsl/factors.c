#include "replay/glsl/factors.h"

#include <stdlib.h>

#include "base/err.h"
#include "replay/glsl/makers.h"

/* A product of two numbers. */
struct product {
	uint32_t at; /* the instruction that computes it */
	uint32_t factors[2];
};

/* The factored form of a sum of two terms: shared * (others[0] + others[1]). */
struct sharing {
	uint32_t shared, others[2];
};

static bool is_negated(const struct scene_instruction *in)
{
	return !(in->flags & SCENE_NEGATE_A) != !(in->flags & SCENE_NEGATE_B);
}

/* True if an operand has the same value before instructions `since` and `at`. */
static bool is_kept(const struct program_code *code, uint32_t since, uint32_t at, uint32_t operand)
{
	for (; since < at; since++)
		if (glsl_writes(&code->instructions[since], operand))
			return false;
	return true;
}

/* Find the product that operand r holds before instruction `at`. @return true if it is one */
static bool find_product(const struct program_code *code, const uint8_t *targets, uint32_t at, uint32_t r,
                         struct product *p)
{
	const struct glsl_maker made = glsl_find_maker(code, targets, at, r);
	const struct scene_instruction *in = &code->instructions[made.at];

	if (!made.is_made || in->operation != SCENE_OP_MULTIPLY || in->flags & SCENE_SATURATE || is_negated(in))
		return false;
	p->at = made.at;
	for (unsigned k = 0; k < 2; k++)
		p->factors[k] = glsl_operand(in, k, made.r - in->to);
	return true;
}

/* Find the two products that result i of an instruction is the sum of. */
static bool find_products(const struct program_code *code, const uint8_t *targets, uint32_t at, uint32_t i,
                          struct product p[2])
{
	const struct scene_instruction *in = &code->instructions[at];

	if (in->operation == SCENE_OP_ADD)
		return !(in->flags & (SCENE_NEGATE_A | SCENE_NEGATE_B)) &&
		       find_product(code, targets, at, glsl_operand(in, 0, i), &p[0]) &&
		       find_product(code, targets, at, glsl_operand(in, 1, i), &p[1]);
	if (in->operation != SCENE_OP_MAD || in->flags & SCENE_NEGATE_C || is_negated(in))
		return false;
	p[1] = (struct product){ at, { glsl_operand(in, 0, i), glsl_operand(in, 1, i) } };
	return find_product(code, targets, at, glsl_operand(in, 2, i), &p[0]);
}

/*
 * Find the factor shared by the products in result i of an instruction. @return true if there is one, and all operands
 * are still available there
 */
static bool find_sharing(const struct program_code *code, const uint8_t *targets, uint32_t at, uint32_t i,
                         struct sharing *s)
{
	struct glsl_maker made[2][2];
	struct product p[2];

	if (!find_products(code, targets, at, i, p))
		return false;
	for (unsigned k = 0; k < 4; k++)
		made[k / 2][k % 2] = glsl_find_maker(code, targets, p[k / 2].at, p[k / 2].factors[k % 2]);
	for (unsigned k = 0; k < 4; k++) {
		const uint32_t first = p[0].factors[k / 2], second = p[1].factors[k % 2];

		if (made[0][k / 2].at != made[1][k % 2].at || made[0][k / 2].r != made[1][k % 2].r)
			continue;
		s->shared = is_kept(code, p[0].at, at, first) ? first : second;
		s->others[0] = p[0].factors[1 - k / 2];
		s->others[1] = p[1].factors[1 - k % 2];
		return (s->shared == first || is_kept(code, p[1].at, at, second)) &&
		       is_kept(code, p[0].at, at, s->others[0]) && is_kept(code, p[1].at, at, s->others[1]);
	}
	return false;
}

/*
 * Turn an instruction's first result, whose factor is known, into the product. The sum gets a register of its own, so
 * that sums of it can be factored as well.
 */
static int share(struct program_code *code, uint32_t at, const struct sharing *s)
{
	const uint32_t flags = code->instructions[at].flags, sum = code->n_registers;
	struct scene_instruction *in;
	int err = 0;

	if (sum == SCENE_PROGRAM_REGISTERS)
		return ERR_INPUT;
	if (code->instructions[at].n > 1)
		err = glsl_split(code, at, 1);
	if (!err)
		err = glsl_insert(code, at,
		                  (struct scene_instruction){ .operation = SCENE_OP_ADD,
		                                              .n = 1,
		                                              .flags = flags & SCENE_UNMASKED,
		                                              .to = sum,
		                                              .a = s->others[0],
		                                              .b = s->others[1] });
	if (err)
		return err;
	code->n_registers++;
	in = &code->instructions[at + 1];
	*in = (struct scene_instruction){ .operation = SCENE_OP_MULTIPLY,
		                          .n = 1,
		                          .flags = flags & (SCENE_UNMASKED | SCENE_SATURATE),
		                          .to = in->to,
		                          .a = s->shared,
		                          .b = sum };
	return 0;
}

int glsl_share_factors(struct program_code *code)
{
	uint8_t *targets;
	int err;

	if (code->n_instructions > GLSL_MAX_SEARCHED)
		return 0;
	targets = malloc(SCENE_PROGRAM_INSTRUCTIONS + 1);
	err = targets ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory");
	if (!err)
		glsl_note_targets(code, targets);
	for (uint32_t i = 0; !err && i < code->n_instructions; i++) {
		struct sharing s;
		uint32_t k = 0;

		while (k < code->instructions[i].n && !find_sharing(code, targets, i, k, &s))
			k++;
		if (k == code->instructions[i].n)
			continue;
		err = k ? glsl_split(code, i, k) : share(code, i++, &s);
		glsl_note_targets(code, targets);
	}
	free(targets);
	return err == ERR_INPUT ? 0 : err; /* if there is no room for more instructions, the rest is left unchanged */
}
