#include "replay/glsl/operators.h"

const uint32_t *glsl_spread(struct glsl_writer *w, const struct glsl_value *v, uint32_t n)
{
	uint32_t *at;

	if (v->n == n || glsl_stopped(w))
		return v->at;
	if (v->n != 1) {
		glsl_fail(w, "a shader has operands of different sizes");
		return NULL;
	}
	at = glsl_alloc(w, n * sizeof(*at));
	for (uint32_t i = 0; at && i < n; i++)
		at[i] = v->at[0];
	return at;
}

struct glsl_value glsl_by_component(struct glsl_writer *w, enum scene_operation operation, uint32_t flags,
                                    uint32_t type, const struct glsl_value *a, const struct glsl_value *b)
{
	struct glsl_value v = glsl_fresh(w, type);
	const uint32_t *x = glsl_spread(w, a, v.n), *y = b ? glsl_spread(w, b, v.n) : NULL;

	if (!glsl_stopped(w))
		glsl_write(w, operation, flags, v.at[0], v.n, x, y, NULL);
	return v;
}

static struct glsl_value divide(struct glsl_writer *w, uint32_t type, const struct glsl_value *a,
                                const struct glsl_value *b)
{
	const struct glsl_value v = glsl_by_component(w, SCENE_OP_DIVIDE, 0, type, a, b);

	if (glsl_type_of(w, type)->kind == GLSL_FLOAT)
		return v;
	return glsl_by_component(w, SCENE_OP_TRUNCATE, 0, type, &v, NULL);
}

/* a - b floor(a / b); for integers, a - b trunc(a / b). */
static struct glsl_value modulo(struct glsl_writer *w, uint32_t type, const struct glsl_value *a,
                                const struct glsl_value *b)
{
	struct glsl_value v = divide(w, type, a, b);

	if (glsl_type_of(w, type)->kind == GLSL_FLOAT)
		v = glsl_by_component(w, SCENE_OP_FLOOR, 0, type, &v, NULL);
	v = glsl_by_component(w, SCENE_OP_MULTIPLY, 0, type, b, &v);
	return glsl_by_component(w, SCENE_OP_ADD, SCENE_NEGATE_B, type, a, &v);
}

/* True if all numbers are equal. */
static struct glsl_value all_equal(struct glsl_writer *w, uint32_t type, const struct glsl_value *a,
                                   const struct glsl_value *b, bool negated)
{
	struct glsl_value v = glsl_fresh(w, type);
	uint32_t all = GLSL_NONE;

	if (a->n != b->n)
		glsl_fail(w, "a shader has operands of different sizes");
	for (uint32_t i = 0; i < a->n && !glsl_stopped(w); i++) {
		const uint32_t one = glsl_one(w, SCENE_OP_EQUAL, a->at[i], b->at[i], 0);

		all = all == GLSL_NONE ? one : glsl_one(w, SCENE_OP_AND, all, one, 0);
	}
	if (!glsl_stopped(w) && negated)
		all = glsl_one(w, SCENE_OP_EQUAL, all, glsl_number(w, 0), 0);
	if (!glsl_stopped(w))
		v.at[0] = all;
	return v;
}

/* Sums from the last number to the first, as Mesa does. */
static uint32_t dot(struct glsl_writer *w, const uint32_t *a, const uint32_t *b, uint32_t n)
{
	const uint32_t to = glsl_registers(w, 1);

	for (uint32_t i = n; i-- > 0;)
		glsl_write(w, i + 1 < n ? SCENE_OP_MAD : SCENE_OP_MULTIPLY, 0, to, 1, &a[i], &b[i], i + 1 < n ? &to : NULL);
	return to;
}

/* to = the sum of the matrix' columns, each times its number. */
static void combine(struct glsl_writer *w, uint32_t to, const struct glsl_value *m, const uint32_t *numbers)
{
	const struct glsl_type *t = glsl_type_of(w, m->type);

	for (uint32_t c = 0; c < t->columns; c++) {
		uint32_t factor[4], sum[4];

		for (uint32_t r = 0; r < t->rows; r++) {
			factor[r] = numbers[c];
			sum[r] = to + r;
		}
		glsl_write(w, c ? SCENE_OP_MAD : SCENE_OP_MULTIPLY, 0, to, t->rows, m->at + c * t->rows, factor, c ? sum : NULL);
	}
}

static struct glsl_value of_matrices(struct glsl_writer *w, uint32_t operation, uint32_t type,
                                     const struct glsl_value *a, const struct glsl_value *b)
{
	const struct glsl_type *x = glsl_type_of(w, a->type), *y = glsl_type_of(w, b->type);
	struct glsl_value v = glsl_fresh(w, type);

	if (glsl_stopped(w))
		return v;
	if (operation == GLSL_MATRIX_TIMES_VECTOR && x->columns == b->n && x->rows == v.n)
		combine(w, v.at[0], a, b->at);
	else if (operation == GLSL_VECTOR_TIMES_MATRIX && y->rows == a->n && y->columns == v.n)
		for (uint32_t c = 0; c < v.n; c++)
			v.at[c] = dot(w, a->at, b->at + c * y->rows, y->rows);
	else if (operation == GLSL_MATRIX_TIMES_MATRIX && x->columns == y->rows && x->rows * y->columns == v.n)
		for (uint32_t c = 0; c < y->columns; c++)
			combine(w, v.at[0] + c * x->rows, a, b->at + c * y->rows);
	else
		glsl_fail(w, "a shader has operands of different sizes");
	return v;
}

struct glsl_value glsl_binary(struct glsl_writer *w, uint32_t operation, uint32_t type, const struct glsl_value *a,
                              const struct glsl_value *b)
{
	static const struct {
		uint32_t operation, flags, turned; /* enum scene_operation; turned: operands are swapped */
	} plain[N_GLSL_OPERATORS] = {
		[GLSL_ADD] = { SCENE_OP_ADD, 0, 0 }, [GLSL_SUBTRACT] = { SCENE_OP_ADD, SCENE_NEGATE_B, 0 },
		[GLSL_MULTIPLY] = { SCENE_OP_MULTIPLY, 0, 0 }, [GLSL_VECTOR_EQUAL] = { SCENE_OP_EQUAL, 0, 0 },
		[GLSL_VECTOR_NOT_EQUAL] = { SCENE_OP_NOT_EQUAL, 0, 0 }, [GLSL_LESS] = { SCENE_OP_LESS, 0, 0 },
		[GLSL_GREATER] = { SCENE_OP_LESS, 0, 1 }, [GLSL_LESS_EQUAL] = { SCENE_OP_GREATER_EQUAL, 0, 1 },
		[GLSL_GREATER_EQUAL] = { SCENE_OP_GREATER_EQUAL, 0, 0 }, [GLSL_OR] = { SCENE_OP_MAXIMUM, 0, 0 },
		[GLSL_XOR] = { SCENE_OP_NOT_EQUAL, 0, 0 }, [GLSL_AND] = { SCENE_OP_AND, 0, 0 },
		[GLSL_MIN] = { SCENE_OP_MINIMUM, 0, 0 }, [GLSL_MAX] = { SCENE_OP_MAXIMUM, 0, 0 },
		[GLSL_POW] = { SCENE_OP_POWER, 0, 0 },
	};

	if (glsl_stopped(w))
		return *a;
	switch (operation) {
	case GLSL_DIVIDE: return divide(w, type, a, b);
	case GLSL_MODULO: return modulo(w, type, a, b);
	case GLSL_EQUAL: return all_equal(w, type, a, b, false);
	case GLSL_NOT_EQUAL: return all_equal(w, type, a, b, true);
	case GLSL_MATRIX_TIMES_VECTOR:
	case GLSL_VECTOR_TIMES_MATRIX:
	case GLSL_MATRIX_TIMES_MATRIX: return of_matrices(w, operation, type, a, b);
	default: break;
	}
	if (operation >= N_GLSL_OPERATORS || !plain[operation].operation) {
		glsl_fail(w, "a shader has an unsupported operator");
		return *a;
	}
	return glsl_by_component(w, plain[operation].operation, plain[operation].flags, type,
	                         plain[operation].turned ? b : a, plain[operation].turned ? a : b);
}
