/* A parsed GLSL shader: types, symbols and nodes in flat arrays. Filled in by parse.h. */
#pragma once

#include <stddef.h>
#include <stdint.h>

#define GLSL_NONE UINT32_MAX
#define GLSL_MESSAGE 120 /* size in bytes of a reason that names a line */

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
	uint32_t rows;    /* components of a vector or of a matrix' column; 1: a scalar */
	uint32_t columns; /* matrix columns; 0: not a matrix */
	uint32_t length;  /* array length; or number of members of a structure */
	uint32_t first;   /* type of an array's elements; or index of a structure's first member in glsl_tree.members */
	uint32_t texture; /* for a sampler: enum glsl_texture */
	uint32_t numbers; /* count of numbers in a value; a sampler counts as one */
};

struct glsl_member {
	uint32_t name; /* offset in glsl_tree.names */
	uint32_t type;
};

enum glsl_storage {
	GLSL_LOCAL, GLSL_GLOBAL, GLSL_CONSTANT_VALUE, GLSL_UNIFORM, GLSL_INPUT, GLSL_OUTPUT,
	GLSL_IN, GLSL_OUT, GLSL_INOUT /* function parameters */
};

struct glsl_symbol {
	uint32_t name, type;
	uint32_t storage;  /* enum glsl_storage */
	uint32_t first;    /* index of its initial value in glsl_tree.numbers; GLSL_NONE: none */
	uint32_t flat, straight; /* flat: an input that is not interpolated; straight: interpolated linearly in the window */
	uint32_t location;       /* `layout` location of an input or a uniform; GLSL_NONE: not given */
	uint32_t binding;        /* initial unit of a sampler; GLSL_NONE: not given */
	uint32_t declared;       /* ascending in source order */
};

/* X(enumerator): the operation of a node on its children, in their order. */
#define GLSL_OPERATORS(X) \
	X(SEQUENCE) X(SYMBOL) X(NUMBERS) \
	X(SELECTION) /* condition, then, else; has a value unless its type is void */ \
	X(LOOP)      /* test, body, terminal; value: 1 if the test comes first */ \
	X(SWITCH)    /* value, sequence */ \
	X(CASE) X(DEFAULT) X(BREAK) X(CONTINUE) X(RETURN) X(DISCARD) \
	X(CALL)      /* value: the function */ \
	X(CONSTRUCT) X(CONVERT) \
	X(INDEX) X(MEMBER) /* value: index of the member */ X(SWIZZLE) /* value: 3 bits for each component, and 4 */ \
	X(ASSIGN)    /* value: the operator of a compound assignment, else ASSIGN */ \
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
	X(OTHER)     /* not supported; value: its name */
enum glsl_operator {
#define GLSL_OPERATOR(name) GLSL_##name,
	GLSL_OPERATORS(GLSL_OPERATOR)
	N_GLSL_OPERATORS
};

struct glsl_node {
	uint32_t operation; /* enum glsl_operator */
	uint32_t type;
	uint32_t first, count; /* its children, in glsl_tree.children; GLSL_NONE for an omitted one */
	uint32_t value;        /* index of a symbol, or of the first number; otherwise as above */
};

struct glsl_function {
	uint32_t name, type; /* type: of the result */
	uint32_t first, count; /* nodes of its parameters, in glsl_tree.children */
	uint32_t body;         /* a node; GLSL_NONE: not defined */
};

/* Owned by the caller that asked for it. */
struct glsl_tree {
	struct glsl_type *types;
	struct glsl_member *members;
	struct glsl_symbol *symbols;
	struct glsl_node *nodes;
	struct glsl_function *functions;
	uint32_t *children; /* indices of nodes */
	float *numbers;
	char *names;        /* concatenated, each NUL-terminated */
	uint32_t n_types, n_members, n_symbols, n_nodes, n_functions, n_children, n_numbers, n_names;
	uint32_t root; /* a sequence that runs before main; contains the places of functions */
	uint32_t main; /* index of a function */
};

enum glsl_stage { GLSL_VERTEX_STAGE, GLSL_FRAGMENT_STAGE };

void glsl_tree_free(struct glsl_tree *tree);
