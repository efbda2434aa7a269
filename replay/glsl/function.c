#include "replay/glsl/function.h"

#include <math.h>

#include "replay/glsl/operators.h"
#include "replay/machine/state.h"

/* Number i of a value; a scalar's only number for any i. */
static uint32_t part(const struct glsl_value *v, uint32_t i)
{
	return v->at[v->n == 1 ? 0 : i];
}

static uint32_t num(struct glsl_writer *w, double value)
{
	return glsl_number(w, (float)value);
}
static uint32_t neg(struct glsl_writer *w, uint32_t a)
{
	const uint32_t to = glsl_registers(w, 1);

	glsl_write(w, SCENE_OP_MOVE, SCENE_NEGATE_A, to, 1, &a, NULL, NULL);
	return to;
}
static uint32_t one(struct glsl_writer *w, enum scene_operation operation, uint32_t a)
{
	return glsl_one(w, operation, a, 0, 0);
}
static uint32_t two(struct glsl_writer *w, enum scene_operation operation, uint32_t a, uint32_t b)
{
	return glsl_one(w, operation, a, b, 0);
}
static uint32_t add(struct glsl_writer *w, uint32_t a, uint32_t b) { return two(w, SCENE_OP_ADD, a, b); }
static uint32_t mul(struct glsl_writer *w, uint32_t a, uint32_t b) { return two(w, SCENE_OP_MULTIPLY, a, b); }
static uint32_t mad(struct glsl_writer *w, uint32_t a, uint32_t b, uint32_t c)
{
	return glsl_one(w, SCENE_OP_MAD, a, b, c);
}
static uint32_t sub(struct glsl_writer *w, uint32_t a, uint32_t b)
{
	const uint32_t to = glsl_registers(w, 1);

	glsl_write(w, SCENE_OP_ADD, SCENE_NEGATE_B, to, 1, &a, &b, NULL);
	return to;
}

/* Sums from the last number to the first, as Mesa does. */
static uint32_t dot(struct glsl_writer *w, const struct glsl_value *a, const struct glsl_value *b)
{
	const uint32_t last = (a->n < b->n ? a->n : b->n) - 1;
	uint32_t sum = mul(w, a->at[last], b->at[last]);

	for (uint32_t i = last; i-- > 0;)
		sum = mad(w, a->at[i], b->at[i], sum);
	return sum;
}

/* --- Functions of one number ------------------------------------------------------------------------------------ */

/* The sign of x: -1, 0 or 1. */
static uint32_t sign_of(struct glsl_writer *w, uint32_t x)
{
	const uint32_t zero = num(w, 0);

	return sub(w, two(w, SCENE_OP_LESS, zero, x), two(w, SCENE_OP_LESS, x, zero));
}

/* Mesa's asin_expr, builtin_functions.cpp */
static uint32_t arc_sine(struct glsl_writer *w, uint32_t x, double p0, double p1)
{
	const uint32_t far = one(w, SCENE_OP_ABSOLUTE, x), half = num(w, M_PI_2);
	uint32_t sum = mad(w, far, num(w, p1), num(w, p0));

	sum = mad(w, far, sum, num(w, M_PI_4 - 1));
	sum = mad(w, far, sum, half);
	sum = mul(w, one(w, SCENE_OP_SQUARE_ROOT, sub(w, num(w, 1), far)), sum);
	return mul(w, sign_of(w, x), sub(w, half, sum));
}

/* Mesa's do_atan, builtin_functions.cpp */
static uint32_t arc_tangent(struct glsl_writer *w, uint32_t x)
{
	static const double factors[] = { 0.0536813784310406, -0.1173503194786851, 0.1938924977115610,
		                          -0.3326756418091246, 0.9999793128310355 };
	const uint32_t far = one(w, SCENE_OP_ABSOLUTE, x), limit = num(w, 1);
	const uint32_t u = two(w, SCENE_OP_DIVIDE, two(w, SCENE_OP_MINIMUM, far, limit), two(w, SCENE_OP_MAXIMUM, far, limit));
	const uint32_t square = mul(w, u, u);
	uint32_t sum = num(w, -0.0121323213173444);

	for (unsigned i = 0; i < sizeof(factors) / sizeof(factors[0]); i++)
		sum = mad(w, sum, square, num(w, factors[i]));
	sum = mul(w, sum, u);
	sum = glsl_one(w, SCENE_OP_CHOOSE, two(w, SCENE_OP_LESS, limit, far), sub(w, num(w, M_PI_2), sum), sum);
	return mul(w, sum, sign_of(w, x));
}

static uint32_t exponential(struct glsl_writer *w, uint32_t x)
{
	return one(w, SCENE_OP_EXP2, mul(w, x, num(w, M_LOG2E)));
}

static uint32_t logarithm(struct glsl_writer *w, uint32_t x)
{
	return mul(w, one(w, SCENE_OP_LOG2, x), num(w, M_LN2));
}

/* (exp(x) + sign exp(-x)) / 2 */
static uint32_t hyperbolic(struct glsl_writer *w, uint32_t x, double sign)
{
	return mul(w, num(w, 0.5), mad(w, exponential(w, neg(w, x)), num(w, sign), exponential(w, x)));
}

static uint32_t of_one(struct glsl_writer *w, uint32_t operation, uint32_t x)
{
	uint32_t y;

	switch (operation) {
	case GLSL_RADIANS: return mul(w, x, num(w, M_PI / 180));
	case GLSL_DEGREES: return mul(w, x, num(w, 180 / M_PI));
	case GLSL_SIN: return one(w, SCENE_OP_SINE, x);
	case GLSL_COS: return one(w, SCENE_OP_COSINE, x);
	case GLSL_TAN: return two(w, SCENE_OP_DIVIDE, one(w, SCENE_OP_SINE, x), one(w, SCENE_OP_COSINE, x));
	case GLSL_ASIN: return arc_sine(w, x, 0.086566724, -0.03102955);
	case GLSL_ACOS: return sub(w, num(w, M_PI_2), arc_sine(w, x, 0.08132463, -0.02363318));
	case GLSL_ATAN: return arc_tangent(w, x);
	case GLSL_SINH: return hyperbolic(w, x, -1);
	case GLSL_COSH: return hyperbolic(w, x, 1);
	case GLSL_TANH:
		y = two(w, SCENE_OP_MINIMUM, two(w, SCENE_OP_MAXIMUM, x, num(w, -10)), num(w, 10));
		return two(w, SCENE_OP_DIVIDE, hyperbolic(w, y, -1), hyperbolic(w, y, 1));
	case GLSL_ASINH:
		y = one(w, SCENE_OP_ABSOLUTE, x);
		return mul(w, sign_of(w, x), logarithm(w, add(w, y, one(w, SCENE_OP_SQUARE_ROOT, mad(w, x, x, num(w, 1))))));
	case GLSL_ACOSH: return logarithm(w, add(w, x, one(w, SCENE_OP_SQUARE_ROOT, mad(w, x, x, num(w, -1)))));
	case GLSL_ATANH:
		y = two(w, SCENE_OP_DIVIDE, add(w, num(w, 1), x), sub(w, num(w, 1), x));
		return mul(w, num(w, 0.5), logarithm(w, y));
	case GLSL_EXP: return exponential(w, x);
	case GLSL_LOG: return logarithm(w, x);
	case GLSL_EXP2: return one(w, SCENE_OP_EXP2, x);
	case GLSL_LOG2: return one(w, SCENE_OP_LOG2, x);
	case GLSL_SQRT: return one(w, SCENE_OP_SQUARE_ROOT, x);
	case GLSL_INVERSE_SQRT: return one(w, SCENE_OP_INVERSE_ROOT, x);
	case GLSL_ABS: return one(w, SCENE_OP_ABSOLUTE, x);
	case GLSL_SIGN: return sign_of(w, x);
	case GLSL_FLOOR: return one(w, SCENE_OP_FLOOR, x);
	case GLSL_TRUNC: return one(w, SCENE_OP_TRUNCATE, x);
	case GLSL_ROUND:
	case GLSL_ROUND_EVEN: return one(w, SCENE_OP_ROUND, x);
	case GLSL_CEIL: return neg(w, one(w, SCENE_OP_FLOOR, neg(w, x)));
	case GLSL_FRACT: return one(w, SCENE_OP_FRACTION, x);
	case GLSL_IS_NAN: return two(w, SCENE_OP_NOT_EQUAL, x, x);
	case GLSL_IS_INF: return two(w, SCENE_OP_EQUAL, one(w, SCENE_OP_ABSOLUTE, x), num(w, INFINITY));
	case GLSL_DPDX: return one(w, SCENE_OP_DX, x);
	case GLSL_DPDY: return one(w, SCENE_OP_DY, x);
	case GLSL_FWIDTH:
		return add(w, one(w, SCENE_OP_ABSOLUTE, one(w, SCENE_OP_DX, x)),
		           one(w, SCENE_OP_ABSOLUTE, one(w, SCENE_OP_DY, x)));
	default: return GLSL_NONE;
	}
}

/* --- Functions of several numbers, component by component ------------------------------------------------------- */

/* atan(y, x), as in builtin_functions.cpp except for its treatment of numbers near the largest ones. */
static uint32_t arc_tangent_of_two(struct glsl_writer *w, uint32_t y, uint32_t x)
{
	const uint32_t zero = num(w, 0), left = two(w, SCENE_OP_GREATER_EQUAL, zero, x);
	const uint32_t s = glsl_one(w, SCENE_OP_CHOOSE, left, one(w, SCENE_OP_ABSOLUTE, x), y);
	const uint32_t t = glsl_one(w, SCENE_OP_CHOOSE, left, y, one(w, SCENE_OP_ABSOLUTE, x));
	const uint32_t quotient = mul(w, s, one(w, SCENE_OP_RECIPROCAL, t));
	uint32_t arc = arc_tangent(w, one(w, SCENE_OP_ABSOLUTE, quotient)), below;

	arc = glsl_one(w, SCENE_OP_CHOOSE,
	               two(w, SCENE_OP_EQUAL, one(w, SCENE_OP_ABSOLUTE, x), one(w, SCENE_OP_ABSOLUTE, y)),
	               num(w, M_PI_4), arc);
	arc = mad(w, left, num(w, M_PI_2), arc);
	below = two(w, SCENE_OP_LESS, two(w, SCENE_OP_MINIMUM, y, one(w, SCENE_OP_RECIPROCAL, t)), zero);
	return glsl_one(w, SCENE_OP_CHOOSE, below, neg(w, arc), arc);
}

static uint32_t of_several(struct glsl_writer *w, const struct glsl_node *node, const struct glsl_value *a, uint32_t n,
                           uint32_t i)
{
	const uint32_t x = part(&a[0], i), y = part(&a[1], i), z = n > 2 ? part(&a[2], i) : 0;
	const uint32_t zero = num(w, 0), unit = num(w, 1);
	uint32_t t;

	switch (node->operation) {
	case GLSL_ATAN: return arc_tangent_of_two(w, x, y);
	case GLSL_MIN: return two(w, SCENE_OP_MINIMUM, x, y);
	case GLSL_MAX: return two(w, SCENE_OP_MAXIMUM, x, y);
	case GLSL_POW: return two(w, SCENE_OP_POWER, x, y);
	case GLSL_STEP: return two(w, SCENE_OP_GREATER_EQUAL, y, x);
	case GLSL_CLAMP: return two(w, SCENE_OP_MINIMUM, two(w, SCENE_OP_MAXIMUM, x, y), z);
	case GLSL_MIX:
		if (glsl_type_of(w, a[2].type)->kind == GLSL_BOOL)
			return glsl_one(w, SCENE_OP_CHOOSE, z, y, x);
		return mad(w, y, z, mul(w, x, sub(w, unit, z)));
	case GLSL_SMOOTH_STEP:
		t = two(w, SCENE_OP_DIVIDE, sub(w, z, x), sub(w, y, x));
		t = two(w, SCENE_OP_MINIMUM, two(w, SCENE_OP_MAXIMUM, t, zero), unit);
		return mul(w, t, mul(w, t, sub(w, num(w, 3), mul(w, num(w, 2), t))));
	default: return GLSL_NONE;
	}
}

/* --- Geometry ---------------------------------------------------------------------------------------------------- */

static uint32_t length_of(struct glsl_writer *w, const struct glsl_value *v)
{
	return v->n == 1 ? one(w, SCENE_OP_ABSOLUTE, v->at[0]) : one(w, SCENE_OP_SQUARE_ROOT, dot(w, v, v));
}

static struct glsl_value difference(struct glsl_writer *w, const struct glsl_value *a, const struct glsl_value *b)
{
	return glsl_binary(w, GLSL_SUBTRACT, a->type, a, b);
}

static void cross(struct glsl_writer *w, struct glsl_value *v, const struct glsl_value *a, const struct glsl_value *b)
{
	for (uint32_t i = 0; i < 3; i++) {
		const uint32_t k = (i + 1) % 3, l = (i + 2) % 3;

		v->at[i] = sub(w, mul(w, a->at[k], b->at[l]), mul(w, b->at[k], a->at[l]));
	}
}

static void refract(struct glsl_writer *w, struct glsl_value *v, const struct glsl_value *i, const struct glsl_value *n,
                    uint32_t eta)
{
	const uint32_t d = dot(w, n, i), zero = num(w, 0), unit = num(w, 1);
	const uint32_t k = sub(w, unit, mul(w, mul(w, eta, eta), sub(w, unit, mul(w, d, d))));
	const uint32_t factor = mad(w, eta, d, one(w, SCENE_OP_SQUARE_ROOT, k)), none = two(w, SCENE_OP_LESS, k, zero);

	for (uint32_t c = 0; c < v->n; c++)
		v->at[c] = glsl_one(w, SCENE_OP_CHOOSE, none, zero, sub(w, mul(w, eta, i->at[c]), mul(w, factor, n->at[c])));
}

/* @return 1 if the operation is a geometric one */
static int of_vectors(struct glsl_writer *w, uint32_t operation, struct glsl_value *v, const struct glsl_value *a)
{
	struct glsl_value d;
	uint32_t factor;

	switch (operation) {
	case GLSL_LENGTH: v->at[0] = length_of(w, &a[0]); return 1;
	case GLSL_DISTANCE:
		d = difference(w, &a[0], &a[1]);
		if (!glsl_stopped(w))
			v->at[0] = length_of(w, &d);
		return 1;
	case GLSL_DOT: v->at[0] = dot(w, &a[0], &a[1]); return 1;
	case GLSL_CROSS: cross(w, v, &a[0], &a[1]); return 1;
	case GLSL_NORMALIZE:
		factor = a[0].n == 1 ? sign_of(w, a[0].at[0]) : one(w, SCENE_OP_INVERSE_ROOT, dot(w, &a[0], &a[0]));
		for (uint32_t i = 0; i < v->n; i++)
			v->at[i] = a[0].n == 1 ? factor : mul(w, a[0].at[i], factor);
		return 1;
	case GLSL_FACE_FORWARD:
		factor = two(w, SCENE_OP_LESS, dot(w, &a[2], &a[1]), num(w, 0));
		for (uint32_t i = 0; i < v->n; i++)
			v->at[i] = glsl_one(w, SCENE_OP_CHOOSE, factor, a[0].at[i], neg(w, a[0].at[i]));
		return 1;
	case GLSL_REFLECT:
		factor = mul(w, num(w, 2), dot(w, &a[1], &a[0]));
		for (uint32_t i = 0; i < v->n; i++)
			v->at[i] = sub(w, a[0].at[i], mul(w, factor, a[1].at[i]));
		return 1;
	case GLSL_REFRACT: refract(w, v, &a[0], &a[1], a[2].at[0]); return 1;
	default: return 0;
	}
}

/* --- Matrices ---------------------------------------------------------------------------------------------------- */

/* The determinant of the submatrix of m (n_all x n_all) that has the n rows and n columns in the bit sets. */
static uint32_t determinant(struct glsl_writer *w, const struct glsl_value *m, uint32_t n_all, uint32_t rows,
                            uint32_t columns)
{
	uint32_t column = 0, sum = GLSL_NONE, sign = 0;

	while (!(columns >> column & 1))
		column++;
	for (uint32_t row = 0; row < n_all; row++) {
		uint32_t product;

		if (!(rows >> row & 1))
			continue;
		product = m->at[column * n_all + row];
		if (columns & (columns - 1))
			product = mul(w, product, determinant(w, m, n_all, rows & ~(1u << row), columns & ~(1u << column)));
		sum = sum == GLSL_NONE ? product : sign & 1 ? sub(w, sum, product) : add(w, sum, product);
		sign++;
	}
	return sum;
}

static void invert(struct glsl_writer *w, struct glsl_value *v, const struct glsl_value *m, uint32_t n)
{
	const uint32_t all = (1u << n) - 1, factor = one(w, SCENE_OP_RECIPROCAL, determinant(w, m, n, all, all));

	for (uint32_t c = 0; c < n; c++)
		for (uint32_t r = 0; r < n; r++) {
			const uint32_t minor = mul(w, factor, determinant(w, m, n, all & ~(1u << c), all & ~(1u << r)));

			v->at[c * n + r] = (c + r) & 1 ? neg(w, minor) : minor;
		}
}

static int of_matrices(struct glsl_writer *w, uint32_t operation, struct glsl_value *v, const struct glsl_value *a)
{
	const struct glsl_type *t = glsl_type_of(w, a[0].type);

	switch (operation) {
	case GLSL_OUTER_PRODUCT:
		for (uint32_t c = 0; c < a[1].n; c++)
			for (uint32_t r = 0; r < a[0].n; r++)
				v->at[c * a[0].n + r] = mul(w, a[0].at[r], a[1].at[c]);
		return 1;
	case GLSL_TRANSPOSE:
		for (uint32_t c = 0; c < t->columns; c++)
			for (uint32_t r = 0; r < t->rows; r++)
				v->at[r * t->columns + c] = a[0].at[c * t->rows + r];
		return 1;
	case GLSL_DETERMINANT:
		v->at[0] = determinant(w, &a[0], t->rows, (1u << t->rows) - 1, (1u << t->rows) - 1);
		return 1;
	case GLSL_INVERSE: invert(w, v, &a[0], t->rows); return 1;
	default: return 0;
	}
}

/* --- All of them ------------------------------------------------------------------------------------------------- */

/* ANY, ALL: reduce a vector with an operation. */
static uint32_t folded(struct glsl_writer *w, enum scene_operation operation, const struct glsl_value *v)
{
	uint32_t all = v->at[0];

	for (uint32_t i = 1; i < v->n; i++)
		all = two(w, operation, all, v->at[i]);
	return all;
}

/* The fixed-function position of a vertex. */
static void transform(struct glsl_writer *w, struct glsl_value *v)
{
	for (uint32_t r = 0; r < 4; r++) {
		const uint32_t row = glsl_constant(
			w, &(struct program_constant){ .source = PROGRAM_MATRIX, .index = PROGRAM_MVP, .row = r });
		uint32_t sum = mul(w, row, 4 * SCENE_VERTEX_POSITION);

		for (uint32_t c = 1; c < 4; c++)
			sum = mad(w, row + c, 4 * SCENE_VERTEX_POSITION + c, sum);
		v->at[r] = sum;
	}
}

struct glsl_value glsl_call_builtin(struct glsl_writer *w, const struct glsl_node *node, const struct glsl_value *a,
                                    uint32_t n)
{
	struct glsl_value v = glsl_value_of(w, node->type, glsl_type_of(w, node->type)->numbers);
	uint32_t made = GLSL_NONE;

	if (glsl_stopped(w))
		return v;
	if (node->operation == GLSL_FTRANSFORM && v.n == 4) {
		transform(w, &v);
		return v;
	}
	if (node->operation == GLSL_OTHER || !n || !v.n || (n > 1 && !a[1].n)) {
		glsl_fail(w, "a shader calls an unsupported function");
		return v;
	}
	if (node->operation == GLSL_ANY || node->operation == GLSL_ALL) {
		v.at[0] = folded(w, node->operation == GLSL_ANY ? SCENE_OP_MAXIMUM : SCENE_OP_AND, &a[0]);
		return v;
	}
	if (of_vectors(w, node->operation, &v, a) || of_matrices(w, node->operation, &v, a))
		return v;
	for (uint32_t i = 0; i < v.n && !glsl_stopped(w); i++) {
		made = node->operation == GLSL_NOISE ? num(w, 0) :
		       n == 1                        ? of_one(w, node->operation, part(&a[0], i)) :
		                                       of_several(w, node, a, n, i);
		if (made == GLSL_NONE)
			glsl_fail(w, "a shader calls an unsupported function");
		v.at[i] = made;
	}
	return v;
}

/* --- Textures ---------------------------------------------------------------------------------------------------- */

/* The index of a sampler in the code; new ones are appended. */
static uint32_t sampler_of(struct glsl_writer *w, const struct glsl_value *v)
{
	static const uint32_t targets[] = { [GLSL_TEXTURE_1D] = GLS_TEXTURE_1D,
		                            [GLSL_TEXTURE_2D] = GLS_TEXTURE_2D,
		                            [GLSL_TEXTURE_3D] = GLS_TEXTURE_3D,
		                            [GLSL_TEXTURE_CUBE] = GLS_TEXTURE_CUBE,
		                            [GLSL_TEXTURE_RECTANGLE] = GLS_TEXTURE_RECTANGLE,
		                            [GLSL_TEXTURE_2D_ARRAY] = GLS_TEXTURE_2D_ARRAY };
	const struct glsl_type *t = glsl_type_of(w, v->type);
	struct program_code *code = w->code;
	const uint32_t number = v->at[0] - SCENE_PROGRAM_CONSTANT;

	if (t->kind != GLSL_SAMPLER || t->texture >= GLSL_TEXTURE_OTHER || v->at[0] < SCENE_PROGRAM_CONSTANT ||
	    number >= w->uniforms->n_values) {
		glsl_fail(w, "a shader samples an unsupported kind of texture");
		return 0;
	}
	for (uint32_t i = 0; i < code->n_samplers; i++)
		if (code->samplers[i].uniform == number)
			return i;
	if (code->n_samplers == PROGRAM_MAX_SAMPLERS) {
		glsl_fail(w, "a shader has too many samplers");
		return 0;
	}
	code->samplers[code->n_samplers] = (struct program_sampler){ number, targets[t->texture] };
	return code->n_samplers++;
}

struct glsl_value glsl_sample(struct glsl_writer *w, const struct glsl_node *node, const struct glsl_value *a,
                              uint32_t n)
{
	static const uint32_t dimensions[] = { [GLSL_TEXTURE_1D] = 1,
		                               [GLSL_TEXTURE_2D] = 2,
		                               [GLSL_TEXTURE_3D] = 3,
		                               [GLSL_TEXTURE_CUBE] = 3,
		                               [GLSL_TEXTURE_RECTANGLE] = 2,
		                               [GLSL_TEXTURE_2D_ARRAY] = 3 };
	const bool divided = node->operation == GLSL_TEXTURE_PROJ || node->operation == GLSL_TEXTURE_PROJ_LOD;
	/* no neighbouring pixels: level 0, unless the call gives one */
	const bool of_vertices = w->stage == GLSL_VERTEX_STAGE;
	const bool levelled = of_vertices || node->operation == GLSL_TEXTURE_LOD || node->operation == GLSL_TEXTURE_PROJ_LOD;
	const bool fourth = n > 2 || of_vertices; /* the level */
	struct glsl_value v = glsl_value_of(w, node->type, glsl_type_of(w, node->type)->numbers);
	struct scene_instruction in = { .operation = SCENE_OP_TEXTURE, .n = 1 };
	const uint32_t zero = glsl_number(w, 0);
	uint32_t from[4] = { zero, zero, zero, zero }, factor;

	if (glsl_stopped(w) || n < 2)
		return v;
	in.b = sampler_of(w, &a[0]);
	if (glsl_stopped(w))
		return v;
	for (uint32_t i = 0; i < 3 && i < a[1].n - divided; i++)
		if (i < dimensions[glsl_type_of(w, a[0].type)->texture] || (i == 2 && glsl_type_of(w, a[0].type)->columns == 0))
			from[i] = a[1].at[i];
	if (divided && fourth) {
		factor = one(w, SCENE_OP_RECIPROCAL, a[1].at[a[1].n - 1]);
		for (uint32_t i = 0; i < 3; i++)
			from[i] = from[i] == zero ? zero : mul(w, from[i], factor);
	} else if (divided) {
		from[3] = a[1].at[a[1].n - 1];
		in.c |= SCENE_TEXTURE_DIVIDED;
	}
	if (n > 2)
		from[3] = a[2].at[0];
	if (fourth)
		in.c |= levelled ? SCENE_TEXTURE_LEVEL : SCENE_TEXTURE_BIASED;
	in.a = glsl_registers(w, 4);
	in.to = glsl_registers(w, 4);
	glsl_write(w, SCENE_OP_MOVE, 0, in.a, 4, from, NULL, NULL);
	glsl_append(w, &in);
	for (uint32_t i = 0; i < v.n && i < 4; i++)
		v.at[i] = in.to + i;
	return v;
}
