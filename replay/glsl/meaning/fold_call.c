#include "replay/glsl/meaning/fold_call.h"

#include <math.h>

#include "replay/glsl/meaning/fold.h"

#define PI 3.14159265358979323846f

/* --- Functions of one number -------------------------------------------------------------------------------------- */

static float sign_of(float x)
{
	return (float)(x > 0) - (float)(x < 0);
}

/* builtin_functions.cpp: asin_expr */
static float arc_sine(float x, float p0, float p1)
{
	const float far = fabsf(x), sum = PI / 2 + far * (PI / 4 - 1 + far * (p0 + far * p1));

	return sign_of(x) * (PI / 2 - sqrtf(1 - far) * sum);
}

/* do_atan */
static float arc_tangent(float x)
{
	static const float factors[] = { 0.0536813784310406f, -0.1173503194786851f, 0.1938924977115610f,
		                         -0.3326756418091246f, 0.9999793128310355f };
	const float far = fabsf(x), u = fminf(far, 1) / fmaxf(far, 1), square = u * u;
	float sum = -0.0121323213173444f;

	for (unsigned i = 0; i < sizeof(factors) / sizeof(factors[0]); i++)
		sum = sum * square + factors[i];
	sum *= u;
	return (far > 1 ? PI / 2 - sum : sum) * sign_of(x);
}

static float arc_tangent_of_two(float y, float x)
{
	const float arc = fabsf(x) == fabsf(y) ? PI / 4 : arc_tangent(x > 0 ? fabsf(y / x) : fabsf(x / y));

	if (x > 0)
		return y < 0 ? -arc : arc;
	return (y < 0 ? -1.0f : 1.0f) * (arc + PI / 2);
}

static float of_one(enum glsl_operator operation, float x)
{
	switch (operation) {
	case GLSL_RADIANS: return x * (PI / 180);
	case GLSL_DEGREES: return x * (180 / PI);
	case GLSL_SIN: return sinf(x);
	case GLSL_COS: return cosf(x);
	case GLSL_TAN: return sinf(x) / cosf(x);
	case GLSL_ASIN: return arc_sine(x, 0.086566724f, -0.03102955f);
	case GLSL_ACOS: return PI / 2 - arc_sine(x, 0.08132463f, -0.02363318f);
	case GLSL_ATAN: return arc_tangent(x);
	case GLSL_SINH: return 0.5f * (expf(x) - expf(-x));
	case GLSL_COSH: return 0.5f * (expf(x) + expf(-x));
	case GLSL_TANH: x = fmaxf(fminf(x, 10), -10); return (expf(x) - expf(-x)) / (expf(x) + expf(-x));
	case GLSL_ASINH: return sign_of(x) * logf(fabsf(x) + sqrtf(x * x + 1));
	case GLSL_ACOSH: return logf(x + sqrtf(x * x - 1));
	case GLSL_ATANH: return 0.5f * logf((1 + x) / (1 - x));
	case GLSL_EXP: return expf(x);
	case GLSL_LOG: return logf(x);
	case GLSL_EXP2: return exp2f(x);
	case GLSL_LOG2: return log2f(x);
	case GLSL_SQRT: return sqrtf(x);
	case GLSL_INVERSE_SQRT: return 1 / sqrtf(x);
	case GLSL_FLOOR: return floorf(x);
	case GLSL_TRUNC: return truncf(x);
	case GLSL_ROUND:
	case GLSL_ROUND_EVEN: return rintf(x);
	case GLSL_CEIL: return ceilf(x);
	case GLSL_FRACT: return x - floorf(x);
	case GLSL_IS_NAN: return isnan(x) != 0;
	case GLSL_IS_INF: return isinf(x) != 0;
	default: return 0; /* derivatives of a constant */
	}
}

/* --- Functions of several numbers, by component; integers are exact in doubles ------------------------------------ */

static float smooth_step(float x, float y, float z)
{
	const float t = fmaxf(fminf((z - x) / (y - x), 1), 0);

	return t * t * (3 - 2 * t);
}

static double of_several(enum glsl_operator operation, double x, double y, double z)
{
	switch (operation) {
	case GLSL_ABS: return fabs(x);
	case GLSL_SIGN: return (x > 0) - (x < 0);
	case GLSL_MIN: return y < x ? y : x;
	case GLSL_MAX: return y > x ? y : x;
	case GLSL_CLAMP: return fmin(fmax(x, y), z);
	case GLSL_POW: return powf((float)x, (float)y);
	case GLSL_STEP: return y >= x;
	case GLSL_MODULO: return (float)x - (float)y * floorf((float)x / (float)y);
	case GLSL_SMOOTH_STEP: return smooth_step((float)x, (float)y, (float)z);
	case GLSL_ATAN: return arc_tangent_of_two((float)x, (float)y);
	default: return of_one(operation, (float)x);
	}
}

static double mixed(const struct parse_type *by, double x, double y, double z)
{
	if (by->kind == GLSL_BOOL)
		return z != 0 ? y : x;
	return (float)x * (1 - (float)z) + (float)y * (float)z;
}

/* --- Geometry ----------------------------------------------------------------------------------------------------- */

static float dot(const double *a, const double *b, uint32_t n)
{
	float sum = 0;

	for (uint32_t i = 0; i < n; i++)
		sum += (float)a[i] * (float)b[i];
	return sum;
}

static void refract(const double *i, const double *n, float eta, uint32_t size, double *to)
{
	const float d = dot(n, i, size), k = 1 - eta * eta * (1 - d * d), factor = eta * d + sqrtf(fmaxf(k, 0));

	for (uint32_t c = 0; c < size; c++)
		to[c] = k < 0 ? 0 : eta * (float)i[c] - factor * (float)n[c];
}

/* @return false: not a geometric function */
static bool of_vectors(enum glsl_operator operation, double *to, const struct parse_nodes *arguments)
{
	const uint32_t n = arguments->at[0]->type->numbers;
	const double *const a = arguments->at[0]->numbers, *const b = arguments->n > 1 ? arguments->at[1]->numbers : a;
	const double *const c = arguments->n > 2 ? arguments->at[2]->numbers : a;
	double difference[4];
	float factor;

	switch (operation) {
	case GLSL_LENGTH: to[0] = n == 1 ? fabsf((float)a[0]) : sqrtf(dot(a, a, n)); return true;
	case GLSL_DISTANCE:
		for (uint32_t i = 0; i < n; i++)
			difference[i] = (float)a[i] - (float)b[i];
		to[0] = sqrtf(dot(difference, difference, n));
		return true;
	case GLSL_DOT: to[0] = dot(a, b, n); return true;
	case GLSL_CROSS:
		for (uint32_t i = 0; i < 3; i++)
			to[i] = (float)a[(i + 1) % 3] * (float)b[(i + 2) % 3] -
			        (float)b[(i + 1) % 3] * (float)a[(i + 2) % 3];
		return true;
	case GLSL_NORMALIZE:
		factor = 1 / sqrtf(dot(a, a, n));
		for (uint32_t i = 0; i < n; i++)
			to[i] = n == 1 ? sign_of((float)a[0]) : (float)a[i] * factor;
		return true;
	case GLSL_FACE_FORWARD:
		factor = dot(c, b, n) < 0 ? 1 : -1;
		for (uint32_t i = 0; i < n; i++)
			to[i] = factor * (float)a[i];
		return true;
	case GLSL_REFLECT:
		factor = 2 * dot(b, a, n);
		for (uint32_t i = 0; i < n; i++)
			to[i] = (float)a[i] - factor * (float)b[i];
		return true;
	case GLSL_REFRACT: refract(a, b, (float)c[0], n, to); return true;
	default: return false;
	}
}

/* The determinant of the submatrix of m (n x n) that has the rows and columns in the bit sets. */
static float determinant(const double *m, uint32_t n, uint32_t rows, uint32_t columns)
{
	uint32_t column = 0;
	float sum = 0, sign = 1;

	while (!(columns >> column & 1))
		column++;
	for (uint32_t row = 0; row < n; row++)
		if (rows >> row & 1) {
			const uint32_t left = columns & ~(1u << column);

			sum += sign * (float)m[column * n + row] *
			       (left ? determinant(m, n, rows & ~(1u << row), left) : 1);
			sign = -sign;
		}
	return sum;
}

static void invert(const struct parse_node *m, double *to)
{
	const uint32_t n = m->type->rows, all = (1u << n) - 1;
	const float whole = determinant(m->numbers, n, all, all);

	for (uint32_t c = 0; c < n; c++)
		for (uint32_t r = 0; r < n; r++)
			to[c * n + r] = ((c + r) & 1 ? -1 : 1) *
			                determinant(m->numbers, n, all & ~(1u << c), all & ~(1u << r)) / whole;
}

static void transpose(const struct parse_node *m, double *to)
{
	for (uint32_t c = 0; c < m->type->columns; c++)
		for (uint32_t r = 0; r < m->type->rows; r++)
			to[r * m->type->columns + c] = m->numbers[c * m->type->rows + r];
}

static void outer_product(const struct parse_node *c, const struct parse_node *r, double *to)
{
	for (uint32_t i = 0; i < c->type->rows * r->type->rows; i++)
		to[i] = (float)c->numbers[i % c->type->rows] * (float)r->numbers[i / c->type->rows];
}

/* @return false: not a matrix function */
static bool of_matrices(enum glsl_operator operation, double *to, const struct parse_nodes *arguments)
{
	const struct parse_node *m = arguments->at[0];

	switch (operation) {
	case GLSL_TRANSPOSE: transpose(m, to); return true;
	case GLSL_INVERSE: invert(m, to); return true;
	case GLSL_OUTER_PRODUCT: outer_product(m, arguments->at[1], to); return true;
	case GLSL_DETERMINANT:
		to[0] = determinant(m->numbers, m->type->rows, (1u << m->type->rows) - 1, (1u << m->type->rows) - 1);
		return true;
	default: return false;
	}
}

static bool any_or_all(const struct parse_node *v, bool all)
{
	for (uint32_t i = 0; i < v->type->numbers; i++)
		if ((v->numbers[i] != 0) != all)
			return !all;
	return all;
}

/* --- All of them -------------------------------------------------------------------------------------------------- */

static bool is_left(enum glsl_operator operation)
{
	return operation == GLSL_FTRANSFORM || operation == GLSL_NOISE || operation >= GLSL_TEXTURE;
}

struct parse_node *parse_fold_call(struct parse *p, enum glsl_operator operation, const struct parse_type *type,
                                   const struct parse_nodes *arguments)
{
	double *numbers;

	if (is_left(operation) || !arguments->n)
		return NULL;
	if ((operation >= GLSL_ADD && operation <= GLSL_AND && operation != GLSL_MODULO) || operation == GLSL_NOT)
		return parse_fold(p, operation, PARSE_NO_BITS, type, arguments->at[0],
		                  arguments->n > 1 ? arguments->at[1] : NULL);
	numbers = parse_alloc(p, type->numbers * sizeof(*numbers));
	if (operation == GLSL_ANY || operation == GLSL_ALL)
		numbers[0] = any_or_all(arguments->at[0], operation == GLSL_ALL);
	else if (!of_vectors(operation, numbers, arguments) && !of_matrices(operation, numbers, arguments))
		for (uint32_t i = 0; i < type->numbers; i++) {
			double part[3] = { 0 };

			for (uint32_t k = 0; k < arguments->n && k < 3; k++)
				part[k] = arguments->at[k]->numbers[arguments->at[k]->type->numbers > 1 ? i : 0];
			numbers[i] = operation == GLSL_MIX ? mixed(arguments->at[2]->type, part[0], part[1], part[2]) :
			             operation == GLSL_ATAN && arguments->n == 1 ?
			                                     arc_tangent((float)part[0]) :
			                                     of_several(operation, part[0], part[1], part[2]);
			numbers[i] = parse_fold_rounded(type->kind, numbers[i]);
		}
	return parse_node_numbers(p, type, numbers);
}
