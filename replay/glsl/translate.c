/*
 * Translates a program: finds the code that can run, allocates variables, and writes the instructions of both stages.
 */
#include "replay/glsl/translate.h"

#include <stdlib.h>
#include <string.h>

#include "base/err.h"
#include "replay/glsl/expression.h"
#include "replay/glsl/factors.h"
#include "replay/glsl/links.h"
#include "replay/glsl/parse/parse.h"
#include "replay/glsl/roots.h"
#include "replay/glsl/state.h"
#include "replay/glsl/statement.h"

#define MAX_SOURCE ((size_t)1 << 18)

static const char *name_of(const struct glsl_tree *tree, uint32_t symbol)
{
	return tree->names + tree->symbols[symbol].name;
}

/* --- Reachable code -------------------------------------------------------------------------------------------- */

/* The symbol that an assignment changes; GLSL_NONE: none */
static uint32_t root_of(const struct glsl_tree *tree, uint32_t node)
{
	const struct glsl_node *n = &tree->nodes[node];

	while ((n->operation == GLSL_INDEX || n->operation == GLSL_MEMBER || n->operation == GLSL_SWIZZLE) && n->count)
		n = &tree->nodes[tree->children[n->first]];
	return n->operation == GLSL_SYMBOL ? n->value : GLSL_NONE;
}

static void note_written(struct glsl_writer *w, uint32_t node)
{
	const uint32_t symbol = root_of(w->tree, node);

	if (symbol != GLSL_NONE)
		w->written[symbol] = 1;
}

/* Walk through all code that can run, each function once. reached: [n_functions]; used: [n_symbols] */
static void walk(struct glsl_writer *w, uint32_t node, uint8_t *reached, uint8_t *used)
{
	const struct glsl_tree *tree = w->tree;
	const struct glsl_node *n;

	if (node == GLSL_NONE)
		return;
	n = &tree->nodes[node];
	if (n->operation == GLSL_SYMBOL)
		used[n->value] = 1;
	if (n->operation == GLSL_ASSIGN || (n->operation >= GLSL_POST_INCREMENT && n->operation <= GLSL_PRE_DECREMENT))
		note_written(w, tree->children[n->first]);
	for (uint32_t i = 0; i < n->count; i++) {
		if (n->operation == GLSL_CALL && i < tree->functions[n->value].count) {
			const uint32_t parameter = tree->nodes[tree->children[tree->functions[n->value].first + i]].value;

			if (tree->symbols[parameter].storage == GLSL_OUT || tree->symbols[parameter].storage == GLSL_INOUT)
				note_written(w, tree->children[n->first + i]);
		}
		walk(w, tree->children[n->first + i], reached, used);
	}
	if (n->operation == GLSL_CALL && !reached[n->value]) {
		reached[n->value] = 1;
		walk(w, tree->functions[n->value].body, reached, used);
	}
}

/* Allocate the variables that main reaches, except those of functions. */
static void place_all(struct glsl_writer *w)
{
	uint8_t *reached = glsl_alloc(w, w->tree->n_functions), *used = glsl_alloc(w, w->tree->n_symbols);

	if (glsl_stopped(w))
		return;
	walk(w, w->tree->root, reached, used);
	walk(w, w->tree->functions[w->tree->main].body, reached, used);
	if (w->stage == GLSL_VERTEX_STAGE)
		glsl_links_locate(w, used);
	for (uint32_t i = 0; i < w->tree->n_symbols && !glsl_stopped(w); i++)
		if (used[i] && w->tree->symbols[i].storage != GLSL_LOCAL && w->tree->symbols[i].storage < GLSL_IN)
			glsl_variable(w, i);
}

/* --- Stages ------------------------------------------------------------------------------------------------------ */

/* 1 if a node is the product of a matrix of this name and gl_Vertex, as in fixed function. */
static int is_fixed_place(const struct glsl_tree *tree, const struct glsl_node *n, const char *matrix)
{
	const struct glsl_node *m, *v;

	if (n->operation == GLSL_FTRANSFORM)
		return strcmp(matrix, "gl_ModelViewProjectionMatrix") == 0;
	if (n->operation != GLSL_MATRIX_TIMES_VECTOR)
		return 0;
	m = &tree->nodes[tree->children[n->first]];
	v = &tree->nodes[tree->children[n->first + 1]];
	return m->operation == GLSL_SYMBOL && v->operation == GLSL_SYMBOL && strcmp(name_of(tree, m->value), matrix) == 0 &&
	       strcmp(name_of(tree, v->value), "gl_Vertex") == 0;
}

/* 1 if main always assigns this product to a result, and nothing else does. */
static int keeps_place(const struct glsl_tree *tree, const char *result, const char *matrix)
{
	const struct glsl_node *body = &tree->nodes[tree->functions[tree->main].body];
	uint32_t names = 0, kept = 0;

	for (uint32_t i = 0; i < tree->n_nodes; i++)
		names += tree->nodes[i].operation == GLSL_SYMBOL && strcmp(name_of(tree, tree->nodes[i].value), result) == 0;
	for (uint32_t i = 0; body->operation == GLSL_SEQUENCE && i < body->count; i++) {
		const struct glsl_node *n = &tree->nodes[tree->children[body->first + i]];

		if (n->operation == GLSL_RETURN || n->operation == GLSL_SELECTION || n->operation == GLSL_LOOP)
			break; /* it may leave main */
		kept += n->operation == GLSL_ASSIGN && n->value == GLSL_ASSIGN &&
		        tree->nodes[tree->children[n->first]].operation == GLSL_SYMBOL &&
		        strcmp(name_of(tree, tree->nodes[tree->children[n->first]].value), result) == 0 &&
		        is_fixed_place(tree, &tree->nodes[tree->children[n->first + 1]], matrix);
	}
	return names == 1 && kept == 1;
}

static int is_written(const struct glsl_writer *w, const char *name)
{
	for (uint32_t i = 0; i < w->tree->n_symbols; i++)
		if (w->written[i] && strcmp(name_of(w->tree, i), name) == 0)
			return 1;
	return 0;
}

/* Back faces use the front colours if the shader does not write back colours, as in llvmpipe. */
static void copy_front(struct glsl_writer *w, const char *back, uint32_t to, uint32_t from)
{
	if (!is_written(w, back))
		glsl_append(w, &(struct scene_instruction){ .operation = SCENE_OP_MOVE,
		                                            .n = 4,
		                                            .flags = SCENE_STEP_A,
		                                            .to = SCENE_VERTEX_RESULTS + 4 * to,
		                                            .a = SCENE_VERTEX_RESULTS + 4 * from });
}

/* Copy colours emitted by lights to registers, so that the tracer can omit them (struct scene_program_light). */
static void name_lights(struct glsl_writer *w)
{
	struct program_code *code = w->code;

	for (uint32_t i = 0; i < code->n_instructions; i++) {
		struct scene_instruction *in = &code->instructions[i];
		uint32_t *const operands[3] = { &in->a, &in->b, &in->c };

		for (unsigned k = 0; k < program_operands(in->operation); k++) {
			const uint32_t place = *operands[k] - SCENE_PROGRAM_CONSTANT, span = in->flags >> k & 1 ? in->n : 1;
			uint32_t to;

			if (*operands[k] < SCENE_PROGRAM_CONSTANT || in->operation == SCENE_OP_FETCH || place % 4 + span > 4)
				continue;
			to = program_constant_operand(code, &code->constants[place / 4]);
			if (to == UINT32_MAX)
				w->err = ERR_SYSTEM;
			else if (to < SCENE_PROGRAM_CONSTANT)
				*operands[k] = to + place % 4;
		}
	}
}

static void finish(struct glsl_writer *w)
{
	struct program_code *code = w->code;
	const int is_vertex = w->stage == GLSL_VERTEX_STAGE;

	if (is_vertex) {
		glsl_fix(w, w->links->fixed, GLSL_LINK_NUMBERS);
		copy_front(w, "gl_BackColor", SCENE_RESULT_BACK_COLOR, SCENE_RESULT_COLOR);
		copy_front(w, "gl_BackSecondaryColor", SCENE_RESULT_BACK_SECONDARY, SCENE_RESULT_SECONDARY);
	}
	if (!w->err)
		w->err = glsl_square_roots(code);
	if (!w->err)
		w->err = glsl_share_factors(code);
	glsl_prune(code, w->uniforms->n_values / 4, is_vertex ? N_SCENE_VERTEX_INPUTS : N_SCENE_INPUTS);
	name_lights(w);
	if (is_vertex) {
		code->outputs = (1u << N_SCENE_VERTEX_OUTPUTS) - 1;
		if (keeps_place(w->tree, "gl_Position", "gl_ModelViewProjectionMatrix"))
			code->outputs &= ~(1u << SCENE_RESULT_POSITION);
		if (!is_written(w, "gl_ClipVertex") ||
		    (!(code->outputs >> SCENE_RESULT_POSITION & 1) && keeps_place(w->tree, "gl_ClipVertex", "gl_ModelViewMatrix")))
			code->outputs &= ~(1u << SCENE_RESULT_CLIP_VERTEX);
		if (!is_written(w, "gl_PointSize"))
			code->outputs &= ~(1u << SCENE_RESULT_POINT_SIZE);
	} else {
		code->sets_depth = is_written(w, "gl_FragDepth");
	}
}

static int write_stage(struct glsl_writer *w, const char **why)
{
	const struct glsl_tree *tree = w->tree;

	w->code->n_registers = w->top = w->stage == GLSL_VERTEX_STAGE ? SCENE_VERTEX_FIRST : SCENE_PROGRAM_FIRST;
	w->variables = glsl_alloc(w, tree->n_symbols * sizeof(*w->variables));
	w->written = glsl_alloc(w, tree->n_symbols);
	w->running = glsl_alloc(w, tree->n_functions);
	for (uint32_t i = 0; i < w->uniforms->n_values / 4; i++)
		if (program_constant_append(w->code, &(struct program_constant){ .source = PROGRAM_LOCAL, .index = i }) == UINT32_MAX)
			w->err = ERR_SYSTEM;
	if (!glsl_stopped(w) && tree->functions[tree->main].body == GLSL_NONE)
		glsl_fail(w, "a shader has no main function");
	if (!glsl_stopped(w))
		place_all(w);
	if (!glsl_stopped(w))
		glsl_statement(w, tree->root);
	if (!glsl_stopped(w)) {
		w->running[tree->main] = 1;
		glsl_body(w, &tree->functions[tree->main]);
	}
	if (!glsl_stopped(w))
		finish(w);
	*why = w->why;
	for (uint32_t i = 0; i < w->n_blocks; i++)
		free(w->blocks[i]);
	free(w->blocks);
	return w->err;
}

int glsl_translate(const struct glsl_sources *sources, struct program_code code[2], struct glsl_uniforms *uniforms,
                   char *message, const char **why)
{
	struct glsl_links *links = calloc(1, sizeof(*links));
	struct glsl_writer *w = calloc(1, sizeof(*w));
	struct glsl_tree trees[2] = { 0 };
	int err = links && w ? 0 : err_report(ERR_SYSTEM, NULL, "out of memory for a shader");

	*why = NULL;
	for (uint32_t stage = 0; stage < 2 && !err && !*why; stage++) {
		size_t n = 0;

		for (uint32_t i = 0; i < sources->n_texts[stage]; i++)
			n += strlen(sources->texts[stage][i]);
		if (n > MAX_SOURCE)
			*why = "a shader is too long";
		else if (sources->n_texts[stage])
			err = glsl_parse(sources->texts[stage], sources->n_texts[stage], stage, sources->products_once,
			                 &trees[stage], message, why);
		if (!err && !*why && sources->n_texts[stage])
			err = glsl_uniforms_add(uniforms, &trees[stage], why);
		if (!err && !*why && sources->n_texts[stage])
			glsl_links_take(links, &trees[stage]);
	}
	if (!err && !*why && sources->n_texts[GLSL_FRAGMENT_STAGE])
		glsl_links_place(links, &trees[GLSL_FRAGMENT_STAGE], why);
	for (uint32_t stage = 0; stage < 2 && !err && !*why; stage++) {
		if (!sources->n_texts[stage])
			continue;
		links->attributes = sources->attributes;
		links->n_attributes = sources->n_attributes;
		*w = (struct glsl_writer){
			.tree = &trees[stage], .code = &code[stage], .stage = stage, .uniforms = uniforms, .links = links,
			.message = message, .call = glsl_call, .choose = glsl_choose
		};
		err = write_stage(w, why);
	}
	for (uint32_t stage = 0; stage < 2; stage++)
		glsl_tree_free(&trees[stage]);
	free(links);
	free(w);
	return err;
}
