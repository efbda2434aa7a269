#include "replay/glsl/meaning/fold.h"

#include <math.h>
#include <string.h>

double parse_fold_rounded(enum glsl_kind kind, double value)
{
	switch (kind) {
	case GLSL_FLOAT: return (float)value;
	case GLSL_BOOL: return value != 0;
	case GLSL_INT:
	case GLSL_UINT:
		value = fmod(trunc(isfinite(value) ? value : 0), 4294967296.0);
		if (value < 0)
			value += 4294967296.0;
		return kind == GLSL_INT && value >= 2147483648.0 ? value - 4294967296.0 : value;
	default: return value;
	}
}

struct parse_node *parse_fold_convert(struct parse *p, const struct parse_node *node, const struct parse_type *to)
{
	double *numbers = parse_alloc(p, to->numbers * sizeof(*numbers));

	for (uint32_t i = 0; i < to->numbers; i++)
		numbers[i] = parse_fold_rounded(to->kind, node->numbers[i]);
	return parse_node_numbers(p, to, numbers);
}

static double of_bits(enum parse_bits bits, enum glsl_kind kind, double a, double b)
{
	const uint32_t x = (uint32_t)(int64_t)a, y = (uint32_t)(int64_t)b;

	switch (bits) {
	case PARSE_BIT_AND: return x & y;
	case PARSE_BIT_OR: return x | y;
	case PARSE_BIT_XOR: return x ^ y;
	case PARSE_BIT_NOT: return ~x;
	case PARSE_SHIFT_LEFT: return x << (y & 31);
	default: return kind == GLSL_INT ? floor(ldexp(a, -(int)(y & 31))) : x >> (y & 31);
	}
}

/* Products of integers fit into 64 bits, but are not exact as doubles. */
static double product(enum glsl_kind kind, double a, double b)
{
	return kind == GLSL_FLOAT ? a * b : (double)(uint32_t)((uint64_t)(int64_t)a * (uint64_t)(int64_t)b);
}

static double of_two(enum glsl_operator operation, enum glsl_kind kind, double a, double b)
{
	switch (operation) {
	case GLSL_ADD: return a + b;
	case GLSL_SUBTRACT: return a - b;
	case GLSL_MULTIPLY: return product(kind, a, b);
	case GLSL_DIVIDE: return kind == GLSL_FLOAT ? (double)((float)a / (float)b) : b == 0 ? 0 : trunc(a / b);
	case GLSL_MODULO: return b == 0 ? 0 : fmod(a, b);
	case GLSL_LESS: return a < b;
	case GLSL_GREATER: return a > b;
	case GLSL_LESS_EQUAL: return a <= b;
	case GLSL_GREATER_EQUAL: return a >= b;
	case GLSL_VECTOR_EQUAL: return a == b;
	case GLSL_VECTOR_NOT_EQUAL: return a != b;
	case GLSL_OR: return a != 0 || b != 0;
	case GLSL_XOR: return (a != 0) != (b != 0);
	case GLSL_AND: return a != 0 && b != 0;
	case GLSL_NEGATE: return -a;
	case GLSL_NOT: return a == 0;
	default: return 0;
	}
}

/* Sums of products, in the shader's order: by a matrix' columns, or as a dot product. */
static void times(const struct parse_type *x, const double *a, const struct parse_type *y, const double *b, double *to)
{
	const uint32_t rows = x->columns ? x->rows : 1, inner = x->columns ? x->columns : x->rows,
	               columns = y->columns ? y->columns : 1;

	for (uint32_t c = 0; c < columns; c++)
		for (uint32_t r = 0; r < rows; r++) {
			float sum = 0;

			for (uint32_t k = 0; k < inner; k++)
				sum += (float)a[k * rows + r] * (float)b[c * inner + k];
			to[c * rows + r] = sum;
		}
}

static double all_equal(const struct parse_node *a, const struct parse_node *b)
{
	for (uint32_t i = 0; i < a->type->numbers; i++)
		if (!(a->numbers[i] == b->numbers[i]))
			return 0;
	return 1;
}

struct parse_node *parse_fold(struct parse *p, enum glsl_operator operation, enum parse_bits bits,
                              const struct parse_type *type, const struct parse_node *a, const struct parse_node *b)
{
	double *numbers = parse_alloc(p, type->numbers * sizeof(*numbers));
	const enum glsl_kind kind = type->kind;

	if (operation == GLSL_EQUAL || operation == GLSL_NOT_EQUAL)
		numbers[0] = all_equal(a, b) == (operation == GLSL_EQUAL);
	else if (operation == GLSL_MATRIX_TIMES_VECTOR || operation == GLSL_VECTOR_TIMES_MATRIX ||
	         operation == GLSL_MATRIX_TIMES_MATRIX)
		times(a->type, a->numbers, b->type, b->numbers, numbers);
	else
		for (uint32_t i = 0; i < type->numbers; i++) {
			const double x = a->numbers[a->type->numbers > 1 ? i : 0],
			             y = b ? b->numbers[b->type->numbers > 1 ? i : 0] : 0;

			numbers[i] = parse_fold_rounded(kind, bits ? of_bits(bits, kind, x, y) :
			                                             of_two(operation, kind, x, y));
		}
	return parse_node_numbers(p, type, numbers);
}

static void construct_matrix(const struct parse_type *t, const struct parse_node *from, double *to)
{
	const struct parse_type *f = from->type;

	for (uint32_t c = 0; c < t->columns; c++)
		for (uint32_t r = 0; r < t->rows; r++) {
			const double plain = c != r ? 0 : f->columns ? 1 : from->numbers[0];

			to[c * t->rows + r] = c < f->columns && r < f->rows ? from->numbers[c * f->rows + r] : plain;
		}
}

struct parse_node *parse_fold_construct(struct parse *p, const struct parse_type *type,
                                        const struct parse_nodes *values)
{
	double *numbers = parse_alloc(p, type->numbers * sizeof(*numbers));
	const struct parse_type *only = values->n == 1 ? values->at[0]->type : NULL;
	uint32_t at = 0;

	if (only && type->columns && (only->columns || only->numbers == 1)) {
		construct_matrix(type, values->at[0], numbers);
		return parse_node_numbers(p, type, numbers);
	}
	if (only && only->numbers == 1 && type->kind <= GLSL_BOOL)
		while (at < type->numbers)
			numbers[at++] = values->at[0]->numbers[0];
	for (uint32_t i = 0; i < values->n; i++)
		for (uint32_t k = 0; k < values->at[i]->type->numbers && at < type->numbers; k++)
			numbers[at++] = values->at[i]->numbers[k];
	return parse_node_numbers(p, type, numbers);
}
