/* A GLSL shader as its parser understood it: types, symbols and nodes in flat arrays. parse.h fills it. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#define GLSL_NONE UINT32_MAX
#define GLSL_MESSAGE 120 /* bytes of a reason that names a line */

enum glsl_kind { GLSL_VOID, GLSL_FLOAT, GLSL_INT, GLSL_UINT, GLSL_BOOL, GLSL_SAMPLER, GLSL_ARRAY, GLSL_STRUCT };
enum glsl_texture {
	GLSL_TEXTURE_1D,
	GLSL_TEXTURE_2D,
	GLSL_TEXTURE_3D,
	GLSL_TEXTURE_CUBE,
	GLSL_TEXTURE_RECTANGLE,
	GLSL_TEXTURE_2D_ARRAY,
	GLSL_TEXTURE_OTHER
};

struct glsl_type {
	uint32_t kind;    /* enum glsl_kind */
	uint32_t rows;    /* of numbers: components of a vector or of a matrix' column; 1: a scalar */
	uint32_t columns; /* of a matrix; 0: it is none */
	uint32_t length;  /* of an array; members of a structure */
	uint32_t first;   /* type of an array's elements; first of a structure's members in glsl_tree.members */
	uint32_t texture; /* of a sampler: enum glsl_texture */
	uint32_t numbers; /* that a value of it has, samplers one each */
};

struct glsl_member {
	uint32_t name; /* in glsl_tree.names */
	uint32_t type;
};

enum glsl_storage {
	GLSL_LOCAL, GLSL_GLOBAL, GLSL_CONSTANT_VALUE, GLSL_UNIFORM, GLSL_INPUT, GLSL_OUTPUT,
	GLSL_IN, GLSL_OUT, GLSL_INOUT /* parameters of functions */
};

struct glsl_symbol {
	uint32_t name, type;
	uint32_t storage;  /* enum glsl_storage */
	uint32_t first;    /* of the numbers that it begins with, in glsl_tree.numbers; GLSL_NONE: none */
	uint32_t flat, straight; /* 1: an input that is not interpolated, or as straight lines in the window */
	uint32_t location;       /* of an input or a uniform, by its `layout`; GLSL_NONE: the text does not say */
	uint32_t binding;        /* of a sampler: the unit that it begins with; GLSL_NONE: the text does not say */
	uint32_t declared;       /* ascends in the order of the text */
};

/* X(enumerator): what a node does with its children, in their order. */
#define GLSL_OPERATORS(X) \
	X(SEQUENCE) X(SYMBOL) X(NUMBERS) \
	X(SELECTION) /* condition, then, else; a value where its type is not void */ \
	X(LOOP)      /* test, body, terminal; value: 1 where the test comes first */ \
	X(SWITCH)    /* value, sequence */ \
	X(CASE) X(DEFAULT) X(BREAK) X(CONTINUE) X(RETURN) X(DISCARD) \
	X(CALL)      /* value: the function */ \
	X(CONSTRUCT) X(CONVERT) \
	X(INDEX) X(MEMBER) /* value: its number */ X(SWIZZLE) /* value: 3 bits for each component, and 4 */ \
	X(ASSIGN)    /* value: the operator of what is assigned of both, ASSIGN: the second child itself */ \
	X(COMMA) X(NEGATE) X(NOT) X(POST_INCREMENT) X(POST_DECREMENT) X(PRE_INCREMENT) X(PRE_DECREMENT) \
	X(ADD) X(SUBTRACT) X(MULTIPLY) X(DIVIDE) X(MODULO) X(MATRIX_TIMES_VECTOR) X(VECTOR_TIMES_MATRIX) \
	X(MATRIX_TIMES_MATRIX) \
	X(EQUAL) X(NOT_EQUAL) X(VECTOR_EQUAL) X(VECTOR_NOT_EQUAL) X(LESS) X(GREATER) X(LESS_EQUAL) X(GREATER_EQUAL) X(OR) \
	X(XOR) X(AND) \
	X(RADIANS) X(DEGREES) X(SIN) X(COS) X(TAN) X(ASIN) X(ACOS) X(ATAN) X(SINH) X(COSH) X(TANH) X(ASINH) X(ACOSH) X(ATANH) \
	X(POW) X(EXP) X(LOG) X(EXP2) X(LOG2) X(SQRT) X(INVERSE_SQRT) X(ABS) X(SIGN) X(FLOOR) X(TRUNC) X(ROUND) \
	X(ROUND_EVEN) X(CEIL) X(FRACT) \
	X(MIN) X(MAX) X(CLAMP) X(MIX) X(STEP) X(SMOOTH_STEP) X(IS_NAN) X(IS_INF) \
	X(LENGTH) X(DISTANCE) X(DOT) X(CROSS) X(NORMALIZE) X(FACE_FORWARD) X(REFLECT) X(REFRACT) \
	X(DPDX) X(DPDY) X(FWIDTH) X(OUTER_PRODUCT) X(DETERMINANT) X(INVERSE) X(TRANSPOSE) X(FTRANSFORM) X(NOISE) X(ANY) \
	X(ALL) \
	X(TEXTURE) X(TEXTURE_PROJ) X(TEXTURE_LOD) X(TEXTURE_PROJ_LOD) \
	X(OTHER)     /* what is not done; value: its name */
enum glsl_operator {
#define GLSL_OPERATOR(name) GLSL_##name,
	GLSL_OPERATORS(GLSL_OPERATOR)
	N_GLSL_OPERATORS
};

struct glsl_node {
	uint32_t operation; /* enum glsl_operator */
	uint32_t type;
	uint32_t first, count; /* its children, in glsl_tree.children; GLSL_NONE where one is not there */
	uint32_t value;        /* of a symbol its number, of numbers the first one; else as above */
};

struct glsl_function {
	uint32_t name, type; /* what it returns */
	uint32_t first, count; /* nodes of its parameters, in glsl_tree.children */
	uint32_t body;         /* a node; GLSL_NONE: it has none */
};

/* Owned by whoever asked for it. */
struct glsl_tree {
	struct glsl_type *types;
	struct glsl_member *members;
	struct glsl_symbol *symbols;
	struct glsl_node *nodes;
	struct glsl_function *functions;
	uint32_t *children; /* numbers of nodes */
	float *numbers;
	char *names;        /* one after the other, each with its 0 */
	uint32_t n_types, n_members, n_symbols, n_nodes, n_functions, n_children, n_numbers, n_names;
	uint32_t root; /* a sequence: what runs before main, and functions' places */
	uint32_t main; /* a function */
};

enum glsl_stage { GLSL_VERTEX_STAGE, GLSL_FRAGMENT_STAGE };

void glsl_tree_free(struct glsl_tree *tree);
